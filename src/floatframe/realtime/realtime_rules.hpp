#pragma once
// Rules for the numbers of RealTimeOptions, shared by the command line and C++ programs.
#include "floatframe/core/number_rule.hpp"

namespace floatframe {

/// Times are limited to the range of 64-bit nanoseconds.
namespace realtime_rules {
inline constexpr WholeNumberRule fixed_iterations{"a number of Newton iterations per step", 0,
                                                  1000};
inline constexpr NumberRule time_budget = non_negative_number("s");
inline constexpr NumberRule max_lag{"a number from 0 to 1e9", "s", 0.0, 1e9};
inline constexpr NumberRule input_timeout = non_negative_number("s");
/// For lock step (UdpPortOptions).
inline constexpr NumberRule timeout{"a positive number up to 1e9", "s", 0.0, 1e9, true};
inline constexpr WholeNumberRule priority{"a real-time priority, 0 for none", 0, 99};
inline constexpr const char* fallbacks[] = {"hold", "initial", "stop"};
/// Limits of a step paced by the wall clock [s].
inline constexpr double shortest_step = 1e-6, longest_step = 1e6;
inline constexpr double most_steps = 1e12;
}  // namespace realtime_rules

}  // namespace floatframe

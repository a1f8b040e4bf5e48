#pragma once
// The benchmarks behind `floatframe bench`, and what they share.
#include <string>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// `floatframe bench`.
Command bench_command();

Command bench_iltis_command();
Command bench_chain_command();
Command bench_scaling_command();
Command bench_start_command();
Command bench_step_command();

/// The Iltis example: in a build folder beside the examples, in the current folder, or where the
/// program is installed. Throws InputError if it is not there.
std::string find_iltis();

/// The number in an option's text; InputError unless it lies in (low, high].
double number_within(const std::string& option, const std::string& text, double low, double high);

}  // namespace floatframe

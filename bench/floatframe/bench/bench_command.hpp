#pragma once
// The benchmarks of `floatframe bench`, and their shared functions.
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

/// The Iltis example: in a build folder next to the examples, in the current folder, or in the
/// installation. Throws InputError if it is not found.
std::string find_iltis();

/// The number in an option's text; InputError unless it is in (low, high].
double number_within(const std::string& option, const std::string& text, double low, double high);

}  // namespace floatframe

#pragma once
// The benchmarks behind `floatframe bench`: each declares its options and sets the action when it
// is the one that was given.
#include <string>

#include "floatframe/apps/command.hpp"

namespace floatframe {

void add_bench_iltis(CLI::App& bench, Action& action);
void add_bench_chain(CLI::App& bench, Action& action);
void add_bench_scaling(CLI::App& bench, Action& action);
void add_bench_step(CLI::App& bench, Action& action);

/// The Iltis example: in a build folder beside the examples, in the current folder, or where the
/// program is installed. Throws InputError if it is not there.
std::string find_iltis();

/// The number in an option's text; InputError unless it lies in (low, high].
double number_within(const std::string& option, const std::string& text, double low, double high);

}  // namespace floatframe

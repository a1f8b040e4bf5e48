#pragma once
// The program `floatframe`: `run`, `check`, `statics` and other commands. Results go to files and
// standard output, errors to standard error, one per line.
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// Exit code 0: done; 1: the run, or the program itself, failed; 2: bad input (model file, options,
/// output folder). `more`: commands in addition to those of apps/commands.hpp.
int command_line_main(int argc, char** argv, const std::vector<Command>& more);

}  // namespace floatframe

#pragma once
// The program `floatframe`: `run`, `check`, `statics` and the others. Results go to files and
// standard output, errors to standard error, one per line.
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// Exit code 0: done; 1: the run, or the program itself, failed; 2: bad input (model file, options,
/// output folder). The program may have commands `more` than those of apps/commands.hpp.
int command_line_main(int argc, char** argv, const std::vector<Command>& more);

}  // namespace floatframe

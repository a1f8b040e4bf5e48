#pragma once
// Reads a command line by the tables of the commands and makes their help.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// What a command line asks for: an action, or the exit code if there is nothing more to do (the
/// help was printed, or a sentence that says what was wrong).
struct ParsedCommand {
  std::function<int()> run;  ///< empty: nothing to do
  int exit_code = 0;
};

/// The targets of the given command's options are filled.
ParsedCommand parse_command_line(const std::vector<Command>& commands, int argc, char** argv);

}  // namespace floatframe

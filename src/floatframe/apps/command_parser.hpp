#pragma once
// Parses a command line by the tables of the commands and generates their help.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// Result of parsing: an action, or the exit code if there is nothing more to do (help or an error
/// message was printed).
struct ParsedCommand {
  std::function<int()> run;  ///< empty: nothing to do
  int exit_code = 0;
};

/// The targets of the given command's options are filled.
ParsedCommand parse_command_line(const std::vector<Command>& commands, int argc, char** argv);

}  // namespace floatframe

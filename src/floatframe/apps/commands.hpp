#pragma once
// All commands of the program, in the order of the help. A new one is a file and an entry here.
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

Command run_command();
Command check_command();
Command statics_command();
Command realtime_command();
Command bench_command();
Command sweep_command();
Command advise_command();
Command reduce_command();
Command info_command();

inline std::vector<Command> all_commands() {
  return {run_command(),   check_command(),  statics_command(), realtime_command(), bench_command(),
          sweep_command(), advise_command(), reduce_command(),  info_command()};
}

}  // namespace floatframe

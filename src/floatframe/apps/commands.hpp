#pragma once
// All commands of the program, in the order of the help. A new one is a file and an entry here; an
// analysis becomes a command by its entry in analyses/analysis_list.hpp.
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// One for each analysis, in the order of analyses/analysis_list.hpp.
std::vector<Command> analysis_commands();
Command run_command();
Command realtime_command();
Command sweep_command();
Command reduce_command();
Command info_command();
Command convert_command();
Command compare_command();
Command validate_command();
Command outputs_command();
Command export_command();
Command stress_command();
Command rainflow_command();
Command vehicle_command();
Command pack_command();
Command fmu_command();

inline constexpr const char* group_of_checks = "Is the program right, and how fast";

/// Those of a group follow each other, as the help shows them.
inline std::vector<Command> all_commands() {
  std::vector<Command> commands;
  const auto add = [&commands](const char* group, std::vector<Command> more) {
    for (Command& command : more) {
      command.group = group;
      commands.push_back(std::move(command));
    }
  };
  add("Make runs", {run_command(), realtime_command(), sweep_command(), vehicle_command()});
  add("Ask a model", analysis_commands());
  add("Look at runs", {compare_command(), outputs_command(), stress_command(), rainflow_command(),
                       export_command()});
  add("Make flexible parts", {reduce_command(), info_command(), convert_command()});
  add("Hand models on", {pack_command(), fmu_command()});
  add(group_of_checks, {validate_command()});
  return commands;
}

}  // namespace floatframe

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

inline std::vector<Command> all_commands() {
  std::vector<Command> commands{run_command()};
  for (Command& analysis : analysis_commands()) commands.push_back(std::move(analysis));
  for (const auto make :
       {realtime_command, sweep_command, reduce_command, info_command, convert_command,
        compare_command, validate_command, outputs_command, export_command, stress_command,
        rainflow_command, vehicle_command, pack_command, fmu_command})
    commands.push_back(make());
  return commands;
}

}  // namespace floatframe

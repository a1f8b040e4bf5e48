#pragma once
// Which instants and bodies of a recorded run a command takes: --from, --to, --every, --body.
#include <string>
#include <vector>

#include "floatframe/core/options.hpp"
#include "floatframe/export/export_selection.hpp"

namespace floatframe {

struct SelectionArguments {
  std::string from{}, to{};
  ExportSelection taken{};  ///< what the options fill directly

  std::vector<Option> table();
  /// Throws InputError.
  ExportSelection selection() const;
};

}  // namespace floatframe

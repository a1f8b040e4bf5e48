#pragma once
// OpenCRG files (ASAM OpenCRG 1.2), text or binary. Modifiers of a header are never applied;
// `CrgRoad::notes` names them.
#include <filesystem>
#include <string>
#include <string_view>

#include "floatframe/roads/crg_road.hpp"

namespace floatframe {

/// Reads the file piece by piece. Throws InputError: one sentence with line and column.
CrgRoad read_crg(const std::filesystem::path& file);
/// The same from its content; `name` for messages.
CrgRoad read_crg(std::string_view content, const std::string& name);

}  // namespace floatframe

#pragma once
// Models of any size for the start benchmark: chains hanging from one end, ladders with one closed
// loop per field, vehicles side by side, each with four wheels on closed suspensions.
#include <string>

#include "floatframe/description/description.hpp"

namespace floatframe {

enum class StartKind { chain, ladder, vehicles };
inline constexpr StartKind all_start_kinds[] = {StartKind::chain, StartKind::ladder,
                                                StartKind::vehicles};
/// "chain", "ladder", "vehicles"
const char* word(StartKind kind) noexcept;

/// `count` links, fields or vehicles. Flexible: links, rungs and wishbones are beams with eight
/// modes, else rigid.
ModelDescription start_model(StartKind kind, bool flexible, int count);

}  // namespace floatframe

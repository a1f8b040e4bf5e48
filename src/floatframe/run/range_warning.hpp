#pragma once
// One way in which a run left the range of the method (docs/range.md).
#include <array>
#include <string>
#include <vector>

namespace floatframe {

/// The limit that was exceeded.
enum class RangeLimit {
  displacement,  ///< a body deforms too far
  rotation,      ///< it bends too far
  spin,          ///< it spins too fast for its stiffness
  turn,          ///< it rotates too far in one step
  phase,         ///< the step is too long for a motion or vibration
  sine,          ///< ... for the sine of a load or motion
  table,         ///< ... for a table
  damping,       ///< numerical damping takes too much energy
  balance,       ///< the energy balance does not close
  branch,        ///< the mechanism passed a singular configuration, where it may branch
  half_turn,     ///< the rotation measured by a force element exceeded half a turn
  contact,       ///< a contact lasts for too few steps
  formula,       ///< the formula of an output has no value
  edges          ///< too many edges of forces to be located
};
/// In this order.
inline constexpr std::array<const char*, 14> range_limit_names{
    "displacement", "rotation", "spin",   "turn",      "phase",   "sine",    "table",
    "damping",      "balance",  "branch", "half_turn", "contact", "formula", "edges"};

struct RangeWarning {
  RangeLimit limit = RangeLimit::displacement;
  std::string sentence;
  bool operator==(const RangeWarning&) const = default;
};

inline std::vector<std::string> sentences(const std::vector<RangeWarning>& warnings) {
  std::vector<std::string> out;
  for (const RangeWarning& w : warnings) out.push_back(w.sentence);
  return out;
}

}  // namespace floatframe

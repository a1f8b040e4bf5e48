#pragma once
// Hints at unusual features of a model, as they were found when it was built or packed.
#include <array>
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// The bending of bars of one body that have the same section and orientation.
struct BarBending {
  int body = -1;
  std::vector<std::string> bars;      ///< names
  std::array<double, 2> stiffness{};  ///< E I, the larger one first [N m2]
  std::array<Vec3, 2> direction{};    ///< they bend along, unit vectors, design configuration
  /// Both stiffnesses are equal, and therefore equal in every direction.
  bool alike() const noexcept { return stiffness[0] - stiffness[1] <= 1e-9 * stiffness[0]; }
};

/// Loops that cannot move because an axis or a point of a joint is misaligned.
struct LockedLoops {
  std::string sentence;
  bool driven = false;  ///< a prescribed motion moves a joint of theirs
};

struct ModelHints {
  std::vector<std::string> notes;   ///< a sentence each
  std::vector<LockedLoops> locked;  ///< also reported by runs and statics
  std::vector<BarBending> bending;
};

}  // namespace floatframe

#pragma once
// What became of the start values of the user, and what else he should know of the start of a run.
#include <string>
#include <vector>

namespace floatframe {

/// A start value that the user gave and that closing the loops has changed.
struct StartChange {
  std::string owner;     ///< "joint 'crank'", "body 'beam'"
  std::string quantity;  ///< "angle", "displacement", "coordinate 2", "amplitude 3"
  bool rate = false;
  std::string unit;  ///< "rad", "m/s"; empty: amplitudes
  double given = 0.0, used = 0.0;
};

/// A direction of a joint that the rest of the model prescribes already.
struct RedundantDirection {
  std::string owner;      ///< "joint 'hinge'", "rod 'tie'"
  std::string direction;  ///< "translation along x", "rotation about [0.6, 0, 0.8]", "length"
};

/// "joint 'hinge': translation along x, translation along y; rod 'tie': length"
std::string redundancy_text(const std::vector<RedundantDirection>& redundant);

/// What a user should know of the state a run starts from.
struct StartReport {
  std::vector<StartChange> changes;
  std::vector<RedundantDirection> redundant;
  std::vector<std::string> notes;  ///< all of it in sentences
};

}  // namespace floatframe

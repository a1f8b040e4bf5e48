#pragma once
// Changes to the start values of the user, and other messages about the start of a run.
#include <string>
#include <vector>

namespace floatframe {

/// A start value given by the user that was changed by closing the loops.
struct StartChange {
  std::string owner;     ///< "joint 'crank'", "body 'beam'"
  std::string quantity;  ///< "angle", "displacement", "coordinate 2", "amplitude 3"
  bool rate = false;
  std::string unit;  ///< "rad", "m/s"; empty: amplitudes
  double given = 0.0, used = 0.0;
};

/// A direction of a joint that is already constrained by the rest of the model.
struct RedundantDirection {
  std::string owner;      ///< "joint 'hinge'", "rod 'tie'"
  std::string direction;  ///< "translation along x", "rotation about [0.6, 0, 0.8]", "length"
};

/// "joint 'hinge': translation along x, translation along y; rod 'tie': length"
std::string redundancy_text(const std::vector<RedundantDirection>& redundant);

/// Information for the user about the start state of a run.
struct StartReport {
  std::vector<StartChange> changes;
  std::vector<RedundantDirection> redundant;
  std::vector<std::string> notes;  ///< all messages as sentences
};

}  // namespace floatframe

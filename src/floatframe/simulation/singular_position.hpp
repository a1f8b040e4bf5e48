#pragma once
// Positions of loops in which constraints depend on each other that do not so nearby: a toggle that
// is straight, a parallelogram that is flat. More motions are free there, for a moment, than the
// mechanism has anywhere near.
#include <string>

#include "floatframe/formulation/relative.hpp"

namespace floatframe {

struct SingularPosition {
  std::string sentence;  ///< empty: there is none
  int only_there = 0;    ///< constraints that depend on others in this position only
};

/// Loops of rigid bodies that are in a singular position at the present positions of `f`.
/// Prescribed motions do not count. `nearly`: how far from it, as a part of the size. Load time.
SingularPosition singular_position(const RelativeFormulation& f, double nearly = 1e-8);

/// True if constraints that depend on each other at `q` may not do so nearby: a quick look in
/// relative coordinates, along one motion that they leave free there. False above 100 coordinates.
/// Moves `f`.
bool may_be_singular(RelativeFormulation& f, double t, const VecX& q);

}  // namespace floatframe

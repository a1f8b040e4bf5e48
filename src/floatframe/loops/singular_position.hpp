#pragma once
// Positions of loops in which constraints are dependent that are independent nearby: a straight
// toggle, a flat parallelogram. More motions are instantaneously free there than in any
// neighbouring position.
#include <string>

#include "floatframe/formulation/relative.hpp"

namespace floatframe {

struct SingularPosition {
  std::string sentence;  ///< empty: there is none
  int only_there = 0;    ///< constraints that are dependent in this position only
};

/// Loops of rigid bodies in a singular position at the present positions of `f`. Prescribed motions
/// are not included. `nearly`: the distance from it, relative to the size. Load time.
SingularPosition singular_position(const RelativeFormulation& f, double nearly = 1e-8);

/// True if constraints that are dependent at `q` may be independent nearby: a fast test in relative
/// coordinates, along one motion that they leave free there. False above 100 coordinates. Moves
/// `f`.
bool may_be_singular(RelativeFormulation& f, double t, const VecX& q);

}  // namespace floatframe

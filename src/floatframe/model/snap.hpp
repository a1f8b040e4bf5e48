#pragma once
// Axes and points of joints as exported by CAD programs, with three to eight digits. Loops that
// move only because axes are parallel, intersect or coincide (planar and spherical linkages, doors
// with two hinges) are locked by truncated digits. Therefore a relation within tolerance is made
// exact if that gives a loop a finite degree of freedom: along a path of 0.1 rad, not only
// instantaneously as in a nearly straight toggle. Each axis and point moves to the common mean.
// Modes of flexible bodies that absorb the misalignment count as degrees of freedom: nothing is
// moved there. Loops that would move only with relations far outside of the tolerance are locked.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Moves frames of joints in loops of a model whose joints and rods are known. Returns a sentence
/// for each relation made exact, and adds the loops that remain locked to `locked`.
std::vector<std::string> snap_joints(Model& model, const SnapDescription& snap,
                                     std::vector<LockedLoops>& locked);

}  // namespace floatframe

#pragma once
// Axes and points of joints as CAD programs write them, with three to eight digits. Loops that move
// only because axes are parallel, meet or lie on one line (planar and spherical linkages, doors
// with two hinges) are locked by what digits leave out. So a relation that holds within tolerance
// is made exact where that gives a loop a freedom which lasts: along a way of 0.1 rad, not only
// for a moment as where a toggle is nearly straight. Each axis and point moves to the common mean.
// Modes of flexible bodies that take the misfit count as freedoms: there nothing is moved.
// Loops that would move if relations held which miss the tolerance by far are locked.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Moves frames of joints in loops of a model whose joints and rods are known. Returns a sentence
/// for each relation that is made exact, and adds to `locked` what stays locked.
std::vector<std::string> snap_joints(Model& model, const SnapDescription& snap,
                                     std::vector<LockedLoops>& locked);

}  // namespace floatframe

#pragma once
// Nodes of beams whose rotations CalculiX keeps. It makes solids of beams. Beams that meet at a
// node share what is made of it if they lie in one line; else it joins what is made of each by a
// rigid knot, and rotations of the node in equations are those of the knot. In one line are beams
// whose tangents and normals are within 20 degrees of those of the beam with the smallest number,
// with its section and offsets (gen3dnor.f of CalculiX 2.20).
#include <set>

#include "floatframe/decks/calculix/calculix_text.hpp"

namespace floatframe {

/// Numbers, in the deck, of the nodes with knots that nothing but beams has.
std::set<int> calculix_knots(const CalculixText& deck);

}  // namespace floatframe

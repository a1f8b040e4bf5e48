#pragma once
// Does a finite-element part hang together? Nodes are tied by elements, spiders, linear equations
// and entries of given matrices. Pieces that only touch (a hinge) count as tied; the factorisation
// of the stiffness finds those.
#include <string>
#include <vector>

#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// Throws InputError that names the nodes of the smaller pieces if there are several; of one piece
/// the nodes that nothing holds across flat sheets (fe/flat_nodes.hpp).
void check_connected(const FeModel& model);

/// "node 12, node 13, node 17 and 4 more".
std::string list_nodes(const FeModel& model, const std::vector<int>& nodes, std::size_t limit = 8);

/// "node 12 ux": a row of a system, for messages.
std::string row_label(const FeModel& model, const FeSystem& system, int row);

}  // namespace floatframe

#pragma once
// Is a finite-element part connected? Nodes are tied by elements, spiders, linear equations
// and entries of given matrices. Pieces that only touch (a hinge) count as tied; the factorisation
// of the stiffness detects those.
#include <string>
#include <vector>

#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// Throws InputError with the nodes of the smaller pieces if there are several; for one piece with
/// the nodes without support across flat sheets (fe/flat_nodes.hpp).
void check_connected(const FeModel& model);

/// "node 12, node 13, node 17 and 4 more".
std::string list_nodes(const FeModel& model, const std::vector<int>& nodes, std::size_t limit = 8);

/// "node 12 ux": a row of a system, for messages.
std::string row_label(const FeModel& model, const FeSystem& system, int row);

}  // namespace floatframe

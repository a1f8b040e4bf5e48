#pragma once
// Nodes that are fixed rigidly to another node: by rigid spiders, or by the equations that readers
// generate for rigid elements and for ends of bars offset from their nodes. To first order
//   u_k = u_r + theta_r x (x_k - x_r)
// and to second order node k has in addition to the displacement of its leader r
//   1/2 theta_r x (theta_r x (x_k - x_r)).
// Nodes that follow only in some directions, or several nodes at once (RBE3), are not fixed.
#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// The leader of each node; -1: it has none. Leaders may have leaders.
std::vector<int> rigid_leaders(const FeModel& model, const FeSystem& system);

/// Do both nodes have the same rotation?
bool turn_alike(const FeSystem& system, int a, int b);

}  // namespace floatframe

#pragma once
// Springs of a finite-element model in its stiffness. A spring of stiffness k adds k d d^T to the
// dofs d . q of its nodes.
//
// Nodes held only by springs have no mass: they follow without inertia and may have directions
// without stiffness, such as the rotations that only springs add to the nodes of solids. Such dofs
// L are condensed: with all springs that touch them and C the other dofs of these,
//   K = K_CC - K_CL K_LL^+ K_LC
// K_LL^+ the pseudo-inverse: directions without stiffness have no force. So a spring with a free
// end has no effect. A node with a name (an interface) is kept.
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/dependent_dofs.hpp"

namespace floatframe {

/// Adds the springs of a bushing between two nodes: three along the axes (columns of `axes`)
/// between the points of the two nodes at the place `at`, which move rigidly with them, and three
/// about the axes. Entries of k that are zero add none. b = -1: the ground.
void add_bushing(FeModel& model, int a, int b, const Vec3& at, const Mat3& axes, const Vec6& k,
                 const std::string& name, const FeSource& source);

/// Stiffness of springs between dofs, ordered by node.
struct SpringBlock {
  std::vector<Dof> dofs;
  MatX K;
};

struct SpringSystem {
  std::vector<SpringBlock> blocks;
  std::vector<Dof> condensed;  ///< dofs of the table that are condensed: they have no row
};

/// Throws InputError if condensed dofs tie too many others.
SpringSystem spring_system(const FeModel& model, const DofTable& table);

/// Dofs that springs need in addition to those of the nodes (dofs_without_springs): three of each
/// node, and rotations of nodes that have no other element.
void add_spring_dofs(const FeModel& model, std::vector<int>& count);

/// Errors in the springs of a model.
struct SpringError {
  ErrorCode code;
  const char* kind = "";
  FeSource at;
  std::string text;
};
std::vector<SpringError> spring_errors(const FeModel& model);

/// Nodes held only by springs, ascending: the mass of the part does not act on them.
std::vector<int> nodes_on_springs(const FeModel& model);

/// Removes the springs to the ground and returns their number.
int remove_grounded_springs(FeModel& model);

/// Energy of the springs in shapes (3 rows per node each): U^T K U.
MatX spring_energy(const FeModel& model, const MatX& U, const MatX& Theta);

}  // namespace floatframe

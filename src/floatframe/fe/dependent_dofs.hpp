#pragma once
// Degrees of freedom that depend on others: rigid and mean spiders, linear equations. Each
// dependent dof is a linear combination of independent ones; dependences may follow each other (a
// reference that belongs to another spider).
#include <utility>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// All dofs of a model before any is eliminated: node after node, 0, 3 or 6 per node. Nodes used
/// only by equations with other nodes have 3.
struct DofTable {
  std::vector<int> begin;  ///< nodes + 1
  int size() const noexcept { return begin.back(); }
  int count(int node) const noexcept { return begin[node + 1] - begin[node]; }
  /// -1 if the dof does not exist.
  int index(int node, int axis) const noexcept {
    return axis < count(node) ? begin[node] + axis : -1;
  }
};
DofTable dof_table(const FeModel& model);
/// Their number for each node, after a leading 0, without those needed by springs and equations.
std::vector<int> dofs_without_springs(const FeModel& model);

struct DependentDofs {
  using Terms = std::vector<std::pair<int, double>>;  ///< dof, factor; ascending
  std::vector<char> dependent;                        ///< of each dof
  std::vector<Terms> terms;                           ///< in independent dofs; empty if independent
  bool any = false;
};

/// Dofs that given matrices omit are zero. Throws InputError with every error: a dof that depends
/// twice or on itself, dofs that do not exist, mean spiders whose nodes are collinear.
DependentDofs resolve_dependences(const FeModel& model, const DofTable& table);

}  // namespace floatframe

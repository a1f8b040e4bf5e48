#include "floatframe/fe/fe_system.hpp"

#include "floatframe/fe/block_assembly.hpp"
#include "floatframe/fe/full_system.hpp"

namespace floatframe {
namespace {

/// u of every dof of the table from the independent ones.
SparseRows transformation(const DofTable& table, const DependentDofs& dependences,
                          const std::vector<int>& row_of, int n) {
  SparseRows T(table.size(), n);
  Eigen::Index entries = 0;
  for (int i = 0; i < table.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    entries +=
        dependences.dependent[k] != 0 ? static_cast<Eigen::Index>(dependences.terms[k].size()) : 1;
  }
  T.reserve(entries);
  for (int i = 0; i < table.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    T.startVec(i);
    if (dependences.dependent[k] == 0) {
      T.insertBack(i, row_of[k]) = 1.0;
      continue;
    }
    for (const auto& [dof, factor] : dependences.terms[k]) {
      T.insertBack(i, row_of[static_cast<std::size_t>(dof)]) = factor;
    }
  }
  T.finalize();
  return T;
}

/// Three rows a node: dofs `axis` .. `axis` + 2 of the table.
SparseRows rows_of_nodes(const SparseRows& T, const DofTable& table, int axis) {
  const int nodes = static_cast<int>(table.begin.size()) - 1;
  SparseRows out(3 * nodes, T.cols());
  out.reserve(T.nonZeros());
  for (int k = 0; k < nodes; ++k) {
    for (int i = 0; i < 3; ++i) {
      out.startVec(3 * k + i);
      const int dof = table.index(k, axis + i);
      if (dof < 0) continue;
      for (SparseRows::InnerIterator it(T, dof); it; ++it) {
        out.insertBack(3 * k + i, it.col()) = it.value();
      }
    }
  }
  out.finalize();
  return out;
}

/// T^T A T
SparseMatrix condense(const SparseMatrix& A, const SparseMatrix& T) {
  const SparseMatrix AT = A * T;
  return SparseMatrix(T.transpose()) * AT;
}

}  // namespace

int FeSystem::row(int node, int axis) const noexcept {
  const std::size_t k = static_cast<std::size_t>(node);
  for (int i = begin[k]; i < begin[k + 1]; ++i) {
    if (dofs[static_cast<std::size_t>(i)].axis == axis) return i;
  }
  return -1;
}

FeSystem assemble(const FeModel& model, Integration integration) {
  const DofTable table = dof_table(model);
  const DependentDofs dependences = resolve_dependences(model, table);
  FeSystem system;
  std::vector<int> row_of(static_cast<std::size_t>(table.size()), -1);
  system.begin.push_back(0);
  for (int node = 0; node < model.nodes(); ++node) {
    const int first = static_cast<int>(system.dofs.size());
    for (int axis = 0; axis < table.count(node); ++axis) {
      const std::size_t dof = static_cast<std::size_t>(table.index(node, axis));
      if (dependences.dependent[dof] != 0) continue;
      row_of[dof] = static_cast<int>(system.dofs.size());
      system.dofs.push_back({node, axis});
    }
    const int count = static_cast<int>(system.dofs.size()) - first;
    system.first.push_back(count > 0 && count == table.count(node) ? first : -1);
    system.begin.push_back(static_cast<int>(system.dofs.size()));
  }
  const SparseRows T = transformation(table, dependences, row_of, system.size());
  system.T = rows_of_nodes(T, table, 0);
  system.T_theta = rows_of_nodes(T, table, 3);
  system.K = full_stiffness(model, table, integration);
  system.M = full_mass(model, table, integration);
  if (dependences.any) {
    const SparseMatrix columns(T);
    system.K = condense(system.K, columns);
    system.M = condense(system.M, columns);
  }
  return system;
}

}  // namespace floatframe

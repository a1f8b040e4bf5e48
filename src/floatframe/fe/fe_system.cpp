#include "floatframe/fe/fe_system.hpp"

#include "floatframe/fe/full_system.hpp"

namespace floatframe {
namespace {

/// u of every dof of the table from the independent ones.
SparseRows transformation(const DofTable& table, const DependentDofs& dependences,
                          const std::vector<int>& row_of, int n) {
  SparseRows T(table.size(), n);
  Eigen::Index entries = 0;
  for (int i = 0; i < table.size(); ++i) {
    const std::size_t k = i;
    entries +=
        dependences.dependent[k] != 0 ? static_cast<Eigen::Index>(dependences.terms[k].size()) : 1;
  }
  T.reserve(entries);
  for (int i = 0; i < table.size(); ++i) {
    const std::size_t k = i;
    T.startVec(i);
    if (dependences.dependent[k] == 0) {
      T.insertBack(i, row_of[k]) = 1.0;
      continue;
    }
    for (const auto& [dof, factor] : dependences.terms[k]) {
      T.insertBack(i, row_of[dof]) = factor;
    }
  }
  T.finalize();
  return T;
}

/// Three rows per node: dofs `axis` .. `axis` + 2 of the table.
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

/// Separates independent and dependent dofs: u_f = q, u_d = T_d q.
struct Split {
  std::vector<int> free, slave;  ///< place of each dof among its kind, else -1
  int free_count = 0, slave_count = 0;
  SparseMatrix T_d;
};

Split split(const DependentDofs& dependences, const std::vector<int>& row_of, int n) {
  Split s;
  s.free = row_of;
  s.free_count = n;
  s.slave.assign(row_of.size(), -1);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < row_of.size(); ++i) {
    if (dependences.dependent[i] == 0) continue;
    for (const auto& [dof, factor] : dependences.terms[i]) {
      entries.emplace_back(s.slave_count, row_of[dof], factor);
    }
    s.slave[i] = s.slave_count++;
  }
  s.T_d.resize(s.slave_count, n);
  s.T_d.setFromTriplets(entries.begin(), entries.end());
  return s;
}

/// The rows and columns of A with a place, in that order. Places ascend.
SparseMatrix part(const SparseMatrix& A, const std::vector<int>& row, int rows,
                  const std::vector<int>& column, int columns) {
  SparseMatrix out(rows, columns);
  const auto each = [&](auto&& use) {
    for (int j = 0; j < A.outerSize(); ++j) {
      const int c = column[j];
      if (c < 0) continue;
      for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
        const int r = row[it.row()];
        if (r >= 0) use(r, c, it.value());
      }
    }
  };
  Eigen::Index entries = 0;
  each([&](int, int, double) { ++entries; });
  out.reserve(entries);
  int next = 0;
  each([&](int r, int c, double value) {
    while (next <= c) out.startVec(next++);
    out.insertBack(r, c) = value;
  });
  while (next < columns) out.startVec(next++);
  out.finalize();
  return out;
}

/// T^T A T = A_ff + A_fd T_d + (A_fd T_d)^T + T_d^T A_dd T_d
SparseMatrix condense(SparseMatrix A, const Split& s) {
  const SparseMatrix A_fd = part(A, s.free, s.free_count, s.slave, s.slave_count);
  const SparseMatrix A_dd = part(A, s.slave, s.slave_count, s.slave, s.slave_count);
  const SparseMatrix A_ff = part(A, s.free, s.free_count, s.free, s.free_count);
  A.resize(0, 0);
  const SparseMatrix mixed = A_fd * s.T_d;
  const SparseMatrix turned = mixed.transpose();
  const SparseMatrix right = A_dd * s.T_d;
  const SparseMatrix inner = SparseMatrix(s.T_d.transpose()) * right;
  const SparseMatrix added = SparseMatrix(mixed + turned) + inner;
  return A_ff + added;
}

}  // namespace

int FeSystem::row(int node, int axis) const noexcept {
  const std::size_t k = node;
  for (int i = begin[k]; i < begin[k + 1]; ++i) {
    if (dofs[i].axis == axis) return i;
  }
  return -1;
}

FeSystem assemble(const FeModel& model, Integration integration) {
  const DofTable table = dof_table(model);
  const DependentDofs dependences = resolve_dependences(model, table);
  FeSystem system;
  std::vector<int> row_of(table.size(), -1);
  system.begin.push_back(0);
  for (int node = 0; node < model.nodes(); ++node) {
    const int first = static_cast<int>(system.dofs.size());
    for (int axis = 0; axis < table.count(node); ++axis) {
      const std::size_t dof = table.index(node, axis);
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
    const Split parts = split(dependences, row_of, system.size());
    system.K = condense(std::move(system.K), parts);
    system.M = condense(std::move(system.M), parts);
  }
  return system;
}

}  // namespace floatframe

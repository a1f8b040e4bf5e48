#include "floatframe/reduction/matrix_integrals.hpp"

#include "floatframe/body/modal_mass.hpp"

namespace floatframe {
namespace {

/// Masses of direction i between nodes.
SparseMatrix masses_of_direction(const FeSystem& system, int axis, Eigen::Index nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < system.M.outerSize(); ++j) {
    if (system.dofs[j].axis != axis) continue;
    for (SparseMatrix::InnerIterator it(system.M, j); it; ++it)
      if (system.dofs[it.row()].axis == axis)
        entries.emplace_back(system.dofs[it.row()].node, system.dofs[j].node, it.value());
  }
  SparseMatrix out(nodes, nodes);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Displacements of the nodes along an axis; zero where a node has no degree of freedom.
MatX along(const FeSystem& system, const MatX& X, int axis, Eigen::Index nodes) {
  MatX out = MatX::Zero(nodes, X.cols());
  for (int i = 0; i < system.size(); ++i)
    if (system.dofs[i].axis == axis) out.row(system.dofs[i].node) = X.row(i);
  return out;
}

}  // namespace

void match_mass_matrix(const FeSystem& system, const MatX& R, const MatX& X, InertiaInvariants& v) {
  const MatX MR = system.M * R;
  const Mat6 M_rr = R.transpose() * MR;
  v.m = M_rr.topLeftCorner<3, 3>().trace() / 3.0;
  const Mat3 B = M_rr.block<3, 3>(3, 0);  // skew(m_u)
  v.m_u = 0.5 * Vec3(B(2, 1) - B(1, 2), B(0, 2) - B(2, 0), B(1, 0) - B(0, 1));
  const Mat3 J = 0.5 * (M_rr.block<3, 3>(3, 3) + M_rr.block<3, 3>(3, 3).transpose());
  v.P_u = 0.5 * J.trace() * Mat3::Identity() - J;  // (21)

  const MatX M_rf = MR.transpose() * X;
  const MatX rest = M_rf - momentum_of_modes(v);
  v.S = M_rf.topRows<3>();
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t i = (a + 1) % 3, j = (a + 2) % 3;
    const auto half = 0.5 * rest.row(3 + static_cast<Eigen::Index>(a));
    v.Si[i].row(static_cast<Eigen::Index>(j)) += half;
    v.Si[j].row(static_cast<Eigen::Index>(i)) -= half;
  }

  const auto nodes = static_cast<Eigen::Index>(system.first.size());
  std::array<SparseMatrix, 3> masses;
  for (int i = 0; i < 3; ++i)
    masses[static_cast<std::size_t>(i)] = masses_of_direction(system, i, nodes);
  const SparseMatrix mean = (masses[0] + masses[1] + masses[2]) / 3.0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const MatX X_i = along(system, X, i, nodes);
    const SparseMatrix beside = masses[k] - mean;
    v.Sij[k][k] += X_i.transpose() * (beside * X_i);
  }
  MatX left = X.transpose() * (system.M * X) - modal_mass(v);
  left = (left + left.transpose()).eval() / 6.0;
  for (std::size_t i = 0; i < 3; ++i) v.Sij[i][i] += left;
}

}  // namespace floatframe

// The dense linear algebra of start accelerations, and what it says when it cannot find them.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

namespace {

/// Index of the first entry that is not finite or too large, -1 if there is none.
int out_of_range(const VecX& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i]) < largest_magnitude)) return static_cast<int>(i);
  return -1;
}

std::string magnitude_text(double x) {
  return std::isfinite(x) ? fmt::format("{:.3g}", x) : "not a finite number";
}

/// All a with J a = gamma: a_p + N z.
struct Motions {
  VecX a_p;
  MatX N;
};

Motions motions(const MatX& J, const VecX& gamma, Eigen::Index nv) {
  if (J.rows() == 0 || nv == 0) return {VecX::Zero(nv), MatX::Identity(nv, nv)};
  // J^T P = Q R: the leading columns of Q span the rows of J, the others its null space.
  Eigen::ColPivHouseholderQR<MatX> qr;
  qr.setThreshold(1e-11);
  qr.compute(J.transpose());
  const Eigen::Index rank = qr.rank();
  const MatX Q = qr.householderQ();
  if (rank == 0) return {VecX::Zero(nv), Q};
  const MatX rows = Q.leftCols(rank);
  const MatX square = J * rows;
  return {rows * square.colPivHouseholderQr().solve(gamma), Q.rightCols(nv - rank)};
}

/// The z of the free accelerations N z: N^T M N z = N^T (force - M a_p).
VecX free_accelerations(const MatX& mass, const MatX& stiffness, const VecX& force,
                        const Motions& m, const std::function<std::string(const MatX&)>& movers) {
  const MatX Mr = m.N.transpose() * mass * m.N;
  const MatX Dr = m.N.transpose() * mass_scale(mass.diagonal()).asDiagonal() * m.N;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> eig(0.5 * (Mr + Mr.transpose()), Dr);
  const MatX& V = eig.eigenvectors();
  VecX z = V.transpose() * (m.N.transpose() * (force - mass * m.a_p));
  // Finite differences of the residual leave noise of its size times 1e-9.
  const double noise =
      1e-7 * (1.0 + force.lpNorm<Eigen::Infinity>()) + 1e-12 * stiffness.cwiseAbs().maxCoeff();
  std::vector<VecX> loose;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (eig.eigenvalues()[i] > no_mass) {
      z[i] /= eig.eigenvalues()[i];
      continue;
    }
    const VecX n = (m.N * V.col(i)).normalized();
    if (!(n.dot(stiffness * n) > noise)) loose.push_back(n);
    z[i] = 0.0;  // massless but stiff: the minimum-norm solution
  }
  if (!loose.empty()) {
    MatX directions(mass.rows(), static_cast<Eigen::Index>(loose.size()));
    for (std::size_t i = 0; i < loose.size(); ++i)
      directions.col(static_cast<Eigen::Index>(i)) = loose[i];
    throw RunError(
        fmt::format("the mass matrix is singular where nothing holds it: {} can move without mass, "
                    "stiffness or constraint; give mass or inertia (a straight bar has no inertia "
                    "about its own axis unless mass_model is hermite or six_dof with "
                    "section_inertia), or remove the freedom",
                    movers(directions)));
  }
  return V * z;
}

}  // namespace

void check_magnitudes(const VecX& force, const std::function<std::string(int)>& owner) {
  const int i = out_of_range(force);
  if (i < 0) return;
  throw RunError(fmt::format(
      "the numbers of the model overflow: the generalised force on {} at the start is {} [N, N m], "
      "expected less than {:g}; look at masses, inertias, gravity, forces and start velocities",
      owner(i), magnitude_text(force[i]), largest_magnitude));
}

void check_masses(const VecX& diagonal, const std::function<std::string(int)>& owner) {
  const int i = out_of_range(diagonal);
  if (i < 0) return;
  throw RunError(
      fmt::format("the numbers of the model overflow: the mass or inertia that {} moves is {} [kg, "
                  "kg m2], expected less than {:g}",
                  owner(i), magnitude_text(diagonal[i]), largest_magnitude));
}

VecX mass_scale(const VecX& diagonal) {
  const double top = diagonal.size() > 0 ? diagonal.cwiseAbs().maxCoeff() : 0.0;
  if (!(top > 0.0)) return VecX::Ones(diagonal.size());
  return diagonal.cwiseMax(1e-4 * top);
}

std::string bodies_text(const std::vector<std::string>& names) {
  std::string text = names.size() == 1 ? "body " : "bodies ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += "'" + names[i] + "'";
  }
  return text;
}

void dense_start(const MatX& mass, const MatX& stiffness, const MatX& J, const VecX& force,
                 const VecX& gamma, const std::function<std::string(const MatX&)>& movers, VecX& a,
                 VecX& lambda) {
  const Eigen::Index nv = mass.rows(), nc = J.rows();
  const Motions m = motions(J, gamma, nv);
  a = m.a_p;
  // Nothing is left where the constraints prescribe all motion, whatever the masses.
  if (m.N.cols() > 0) a += m.N * free_accelerations(mass, stiffness, force, m, movers);
  lambda = VecX::Zero(nc);
  if (nc == 0 || nv == 0) return;
  Eigen::CompleteOrthogonalDecomposition<MatX> cod;
  cod.setThreshold(1e-11);
  cod.compute(J.transpose());
  lambda = cod.solve(force - mass * a);
}

}  // namespace floatframe

#include "floatframe/simulation/initial_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

namespace {

double largest(const VecX& x) { return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>(); }

/// Index into parts of the constraint row with the largest magnitude.
const ConstraintPart& worst_part(const RelativeFormulation& f, const VecX& phi) {
  Eigen::Index row = 0;
  phi.cwiseAbs().maxCoeff(&row);
  std::size_t k = f.parts().size() - 1;
  while (k > 0 && f.part_offset(k) > row) --k;
  return f.parts()[k];
}

/// Which coordinates may move at a stage of closing loops: 0 rigid ones without a start value, 1
/// modal amplitudes too, 2 all.
VecX mobility(const RelativeFormulation& f, int stage) {
  VecX w = VecX::Ones(f.velocities());
  const std::vector<char> given = f.given_coordinates();
  for (int i = 0; i < f.velocities(); ++i) {
    if (f.is_elastic(i)) w[i] = stage >= 1 ? 1e-4 : 0.0;
    if (given[static_cast<std::size_t>(i)]) w[i] = stage >= 2 ? 1e-4 : 0.0;
  }
  return w;
}

/// Least weighted change x with J x = b.
VecX least_change(const MatX& J, const VecX& w, const VecX& b) {
  const MatX Jw = J * w.cwiseSqrt().asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<MatX> cod;
  cod.setThreshold(1e-11);
  cod.compute(Jw);
  return w.cwiseSqrt().cwiseProduct(cod.solve(b));
}

}  // namespace

void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool correct_positions, double t) {
  if (f.constraints() == 0) return;
  const VecX q_start = q, v_start = v;
  VecX q1 = q;
  if (correct_positions) {
    double violation = 0.0;
    for (int stage = 0; stage < 3; ++stage) {
      const VecX w = mobility(f, stage);
      q = q_start;
      for (int pass = 0; pass < 100; ++pass) {
        f.positions(t, q);
        f.velocities(v);
        violation = largest(f.constraint_values());
        if (violation < 1e-14) break;
        VecX x = least_change(f.constraint_jacobian(), w, -f.constraint_values());
        const double size = largest(x);
        if (!std::isfinite(size)) break;
        if (size > 0.2) x *= 0.2 / size;
        f.retract(q, x, q1);
        q = q1;
        if (size < 1e-15) break;
      }
      if (violation < 1e-11) break;
    }
    f.positions(t, q);
    f.velocities(v);
    violation = largest(f.constraint_values());
    if (!(violation < 1e-10)) {
      const ConstraintPart& part = worst_part(f, f.constraint_values());
      throw RunError(
          fmt::format("the model cannot be assembled: {} stays open by {:.3g} m at the start",
                      owner_name(f.model(), part.owner), violation));
    }
  }
  VecX rate(f.constraints());
  double violation = 0.0;
  const auto measure = [&] {
    f.positions(t, q);
    f.velocities(v);
    f.constraint_rates(rate);
    violation = largest(rate);
  };
  for (int stage = 0; stage < 3; ++stage) {
    const VecX w = mobility(f, stage);
    v = v_start;
    for (int pass = 0; pass < 5; ++pass) {
      measure();
      if (violation < 1e-13) break;
      v += least_change(f.constraint_jacobian(), w, -rate);
    }
    measure();
    if (violation < 1e-10 * (1.0 + largest(v))) break;
  }
  if (!(violation < 1e-8 * (1.0 + largest(v)))) {
    const ConstraintPart& part = worst_part(f, rate);
    throw RunError(fmt::format("the start velocities do not fit: {} opens at {:.3g} m/s",
                               owner_name(f.model(), part.owner), violation));
  }
}

void dense_start(const MatX& mass, const MatX& stiffness, const MatX& J, const VecX& force,
                 const VecX& gamma, const std::function<std::string(int)>& owner, VecX& a,
                 VecX& lambda) {
  const Eigen::Index nv = mass.rows(), nc = J.rows();
  // Particular solution of J a = gamma plus the null space N of J: N^T M N z = N^T (force - M a_p).
  MatX N = MatX::Identity(nv, nv);
  VecX a_p = VecX::Zero(nv);
  if (nc > 0) {
    Eigen::CompleteOrthogonalDecomposition<MatX> cod;
    cod.setThreshold(1e-11);
    cod.compute(J);
    a_p = cod.solve(gamma);
    const Eigen::Index rank = cod.rank();
    // The null space: the last nv - rank columns of an orthogonal factor of J^T.
    Eigen::ColPivHouseholderQR<MatX> qr;
    qr.setThreshold(1e-11);
    qr.compute(J.transpose());
    const MatX Q = qr.householderQ();
    N = Q.rightCols(nv - rank);
  }
  const MatX Mr = N.transpose() * mass * N;
  const MatX symmetric = 0.5 * (Mr + Mr.transpose());
  Eigen::SelfAdjointEigenSolver<MatX> eig(symmetric);
  const double top = std::max(mass.cwiseAbs().maxCoeff(), 1e-300);
  VecX z = eig.eigenvectors().transpose() * (N.transpose() * (force - mass * a_p));
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (eig.eigenvalues()[i] > 1e-12 * top) {
      z[i] /= eig.eigenvalues()[i];
      continue;
    }
    const VecX n = N * eig.eigenvectors().col(i);
    const double k = n.dot(stiffness * n);
    // Finite differences of the residual leave noise of its size times 1e-9.
    const double noise = 1e-7 * (1.0 + largest(force)) + 1e-12 * stiffness.cwiseAbs().maxCoeff();
    if (!(k > noise)) {
      Eigen::Index worst = 0;
      n.cwiseAbs().maxCoeff(&worst);
      throw RunError(
          "the mass matrix is singular where nothing holds it: " + owner(static_cast<int>(worst)) +
          " can move without mass, stiffness or constraint; give the body mass or inertia (a "
          "straight bar "
          "has none about its own axis unless mass_model is hermite or six_dof with "
          "section_inertia), or "
          "remove the freedom");
    }
    z[i] = 0.0;  // massless but stiff: the minimum-norm solution
  }
  a = a_p + N * (eig.eigenvectors() * z);
  lambda = VecX::Zero(nc);
  if (nc > 0) lambda = J.transpose().completeOrthogonalDecomposition().solve(force - mass * a);
}

}  // namespace floatframe

// Stability of an equilibrium. On the motions N z that satisfy the constraints,
//   N^T M N zddot + N^T K N z = 0,  K with the geometric stiffness of forces and multipliers,   (1)
// grows without oscillation, as e^(s t), if z^T K z = -s^2 z^T M z < 0 for some z; where K is not
// symmetric (following loads, slopes), if (1) has a negative eigenvalue. K is computed by finite
// differences, whose rounding is large compared with small stiffnesses if other parts are stiff: a
// result counts only if the forces along that motion alone confirm it.
//
// Most equilibria are clearly stable, which is cheaper to prove: the tangent T of steps, plus 1/s2
// times the mass, has no negative pivot, and K is positive definite on all soft motions of T
// (subspace iteration; finite differences along these only). T lacks the stiffness of gravity,
// which can make only soft motions unstable.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/light_motion.hpp"
#include "floatframe/tangents/linearization.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {
namespace {

/// Dense eigenvalues, also of general matrices: seconds at this size.
constexpr int most_unknowns = 1000, most_unsymmetric = 200;
/// Growth slower than by a factor e in a quarter of an hour is neglected [1/s2].
constexpr double least_growth = 1e-6;

/// The real negative eigenvalue of K x = lambda M x that is farthest from zero, with its vector.
struct Divergence {
  double value = 0.0;
  VecX z;
};

Divergence divergence_of(const MatX& K, const MatX& M) {
  Divergence d;
  const MatX symmetric = 0.5 * (K + K.transpose());
  const double uneven = (K - symmetric).cwiseAbs().maxCoeff();
  if (uneven <= 1e-6 * symmetric.cwiseAbs().maxCoeff()) {
    const SymmetricEigen e = generalised_eigen(symmetric, M);
    if (e.found && e.values[0] < 0.0) d = {e.values[0], e.vectors.col(0)};
    return d;
  }
  if (K.rows() > most_unsymmetric) return d;
  const GeneralEigen e = general_eigen(lu_solve(M, K));
  for (Eigen::Index k = 0; e.found && k < e.values.size(); ++k)
    if (std::abs(e.values[k].imag()) < 1e-9 * std::abs(e.values[k]) && e.values[k].real() < d.value)
      d = {e.values[k].real(), e.vectors.col(k).real()};
  return d;
}

/// K x by central differences of this step.
VecX stiffness_times(RelativeFormulation& f, const State& s, const VecX& x, double step) {
  VecX q = s.q, r[2];
  for (int k = 0; k < 2; ++k) {
    f.retract(s.q, VecX((k == 0 ? step : -step) * x), q);
    r[k] = residual_at(f, s.t, q, s.v, s.lambda);
  }
  return (r[0] - r[1]) / (2.0 * step);
}

/// Columns orthonormal with these masses.
void orthonormalise(MatX& X, const VecX& mass) {
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index j = 0; j < k; ++j)
        X.col(k) -= X.col(j).dot(mass.cwiseProduct(X.col(k))) * X.col(j);
    X.col(k) /= std::sqrt(X.col(k).dot(mass.cwiseProduct(X.col(k))));
  }
}

/// Subspace iteration for the softest motions of T, which is factorised in `slot` and contains
/// `scale` times mass and stiffness. Returns an estimate of the stiffness per mass of the stiffest
/// motion found [1/s2]: all softer ones are found.
double find_softest(RelativeFormulation& f, const VecX& mass, double scale, int slot, MatX& X) {
  constexpr int rounds = 3;
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const double golden = static_cast<double>(i * X.cols() + j + 1) * 0.6180339887498949;
      X(i, j) = (golden - std::floor(golden) - 0.5) / std::sqrt(mass[i]);
    }
  VecX x(X.rows());
  MatX flexibility;
  for (int round = 0; round < rounds; ++round) {
    orthonormalise(X, mass);
    const MatX before = mass.asDiagonal() * X;
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      x = before.col(j);
      f.solve(x, slot);
      X.col(j) = x;
    }
    flexibility = before.transpose() * X;
  }
  orthonormalise(X, mass);
  const SymmetricEigen e = symmetric_eigen(0.5 * (flexibility + flexibility.transpose()));
  return e.found && e.values[0] > 0.0 ? 1.0 / (scale * e.values[0]) : 0.0;
}

/// X^T K X of the symmetric part of K, by finite differences along the columns of X.
MatX stiffness_of(RelativeFormulation& f, const State& s, const MatX& X) {
  MatX KX(X.rows(), X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    KX.col(j) = stiffness_times(f, s, X.col(j), 1e-5 / largest(X.col(j)));
  const MatX K = X.transpose() * KX;
  return 0.5 * (K + K.transpose());
}

/// The fast check above: true if no motion can be unstable.
bool surely_stable(RelativeFormulation& f, const State& s, const VecX& possible) {
  constexpr double scale = 1e-4;  // [s2], of T
  // Well above the negative stiffness of gravity per mass, g over the radius of gyration of a body:
  // 1e3 for a centimetre [1/s2].
  constexpr double stiff = 1e4;
  constexpr int slot = 1, most = 64;
  residual_at(f, s.t, s.q, s.v, s.lambda);
  const double penalty_mass = default_penalty_mass(f.model(), Coordinates::relative);
  if (f.factorize(scale, 0.0, scale, penalty_mass / scale, slot) >= 0) return false;
  if (f.negative_pivots(slot) > 0) return false;
  const VecX mass = mass_scale(f.mass_diagonal(), possible);
  const Eigen::Index n = f.velocities();
  for (Eigen::Index k = std::min<Eigen::Index>(16, n); k <= most && (k <= 16 || 2 * k <= n);
       k *= 2) {
    MatX X(n, k);
    const double stiffest = find_softest(f, mass, scale, slot, X);
    if (!X.allFinite()) return false;
    if (k < n && stiffest < stiff) continue;
    const SymmetricEigen e = symmetric_eigen(stiffness_of(f, s, X));
    return e.found && e.values[0] > -least_growth;
  }
  return false;
}

}  // namespace

std::string unstable_equilibrium(RelativeFormulation& f, const VecX& q, const VecX& lambda) {
  const int nv = f.velocities();
  if (nv == 0 || nv > most_unknowns) return "";
  const RestingStates resting(f, false);
  State s;
  s.q = q;
  s.v = s.a = VecX::Zero(nv);
  s.lambda = lambda;
  const VecX possible = possible_masses(f, s);
  // T lacks the signals between elements.
  if (f.signal_rank() == 0 && surely_stable(f, s, possible)) return "";
  const VecX r = residual_at(f, s.t, s.q, s.v, s.lambda);
  const MatX mass = mass_matrix(f, test_accelerations(r, possible), r, s.lambda);
  const MatX J = f.constraint_jacobian();
  const MatX K = stiffness_matrix(f, s);
  if (!mass.allFinite() || !J.allFinite() || !K.allFinite()) return "";
  const MatX N = free_motions(J, possible);
  if (N.cols() == 0) return "";
  // A massless direction would be unstable at once: adds a small part of its possible mass.
  const MatX own = N.transpose() * mass * N;
  const MatX M =
      0.5 * (own + own.transpose()) +
      1e-9 * MatX(N.transpose() * mass_scale(mass.diagonal(), possible).asDiagonal() * N);
  const Divergence d = divergence_of(N.transpose() * K * N, M);
  if (!(d.value < -least_growth)) return "";
  VecX x = N * d.z;
  x /= largest(x);
  const double m =
      x.dot(mass * x) + 1e-9 * x.dot(mass_scale(mass.diagonal(), possible).cwiseProduct(x));
  double growth = 0.0;  // [1/s2], the smaller one of two steps
  for (const double step : {1e-3, 1e-4}) {
    const double found = -x.dot(stiffness_times(f, s, x, step)) / m;
    growth = growth == 0.0 ? found : std::min(growth, found);
  }
  if (!(growth > least_growth)) return "";
  const std::string who = moving_bodies(f, s, x);
  dynamics_at(f, s);
  return fmt::format(
      "the equilibrium is unstable: {} would leave it at the smallest push, by e in {:.3g} s; look "
      "for another one from start values on its other side",
      who, 1.0 / std::sqrt(growth));
}

}  // namespace floatframe

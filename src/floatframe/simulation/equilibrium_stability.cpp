// Whether an equilibrium is stable. On the motions N z that the constraints leave free,
//   N^T M N zddot + N^T K N z = 0,  K with the geometric stiffness of forces and multipliers,   (1)
// grows without swinging, as e^(s t), if z^T K z = -s^2 z^T M z < 0 for some z; where K is not
// symmetric (loads that follow, slopes), if (1) has a negative eigenvalue. K is of finite
// differences, whose rounding is large beside small stiffnesses where other parts are stiff: what
// is found counts only if the forces along that motion alone say the same.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/light_motion.hpp"
#include "floatframe/simulation/linearization.hpp"
#include "floatframe/simulation/small_motions.hpp"

namespace floatframe {
namespace {

/// Dense eigenvalues: seconds at this size, of general matrices at that.
constexpr int most_unknowns = 1000, most_unsymmetric = 200;
/// Slower growth than by e in a quarter of an hour is none [1/s2].
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

/// x^T K x by forces along x alone, in steps that hold the digits.
double stiffness_along(RelativeFormulation& f, const State& s, const VecX& x, double step) {
  VecX q = s.q;
  double g[2];
  for (int k = 0; k < 2; ++k) {
    f.retract(s.q, VecX((k == 0 ? step : -step) * x), q);
    g[k] = x.dot(residual_at(f, s.t, q, s.v, s.lambda));
  }
  return (g[0] - g[1]) / (2.0 * step);
}

}  // namespace

std::string unstable_equilibrium(RelativeFormulation& f, const VecX& q, const VecX& lambda) {
  const int nv = f.velocities();
  if (nv == 0 || nv > most_unknowns) return "";
  State s;
  s.q = q;
  s.v = s.a = VecX::Zero(nv);
  s.lambda = lambda;
  const VecX possible = possible_masses(f, s);
  const VecX r = residual_at(f, s.t, s.q, s.v, s.lambda);
  const MatX mass = mass_matrix(f, test_accelerations(r, possible), r, s.lambda);
  const MatX J = f.constraint_jacobian();
  const MatX K = stiffness_matrix(f, s);
  if (!mass.allFinite() || !J.allFinite() || !K.allFinite()) return "";
  const MatX N = free_motions(J, possible);
  if (N.cols() == 0) return "";
  // What has no mass falls over at once: a little of what it could have.
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
    const double found = -stiffness_along(f, s, x, step) / m;
    growth = growth == 0.0 ? found : std::min(growth, found);
  }
  if (!(growth > least_growth)) return "";
  const std::string who = moving_bodies(f, s, x);
  f.positions(s.t, s.q);
  f.velocities(s.v);
  f.dynamics();
  return fmt::format(
      "the equilibrium is unstable: {} would leave it at the smallest push, by e in {:.3g} s; look "
      "for another one from start values on its other side",
      who, 1.0 / std::sqrt(growth));
}

}  // namespace floatframe

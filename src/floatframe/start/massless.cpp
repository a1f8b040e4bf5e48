#include "floatframe/start/massless.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {
namespace {

/// Stiffness so small that it hardly affects modes with mass: s k = 1e-4 m for the stiffest.
double regularisation_scale(const Formulation& f) {
  double stiffest = 0.0;
  for (const double w2 : f.own_frequencies_squared())
    if (w2 < no_inertia) stiffest = std::max(stiffest, w2);
  return std::min(1e-10, 1e-4 / std::max(stiffest, 1.0));
}

/// True if some body is bent. A massless direction is then a bend that rotates with its body, which
/// seems to be held by stiffness, although the elastic energy does not change.
bool bent(const Formulation& f) {
  const std::vector<BodyKinematics>& bodies = f.motion().bodies;
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const BodyKinematics& b) { return !b.y.isZero(0.0); });
}

/// Penalty of the passes. They converge at a rate of 1 / (penalty mu), with the smallest eigenvalue
/// mu of Phi_q M^-1 Phi_q^T, which for chains of loops decreases with the square of their number.
double penalty_of_passes(const Formulation& f, double penalty_mass) {
  if (f.coordinates() == Coordinates::absolute) return penalty_mass;
  const double loops = std::max(1.0, f.constraints() / 100.0);
  return penalty_mass * loops * loops;
}

/// Values from 0.5 to 1.5, of either sign: a vector that is in general orthogonal to no direction.
double varied(Eigen::Index i) {
  const double golden = static_cast<double>(i + 1) * 0.6180339887498949;
  return (0.5 + golden - std::floor(golden)) * (i % 2 == 0 ? 1.0 : -1.0);
}

/// x without its massless part, by T of slot 0: T^-1 M x with the same Phi_q x.
VecX with_mass(Formulation& f, const VecX& x, const VecX& r0, const VecX& lambda,
               double penalty_mass) {
  VecX y = mass_times(f, x, 1.0, r0, lambda), rates(lambda.size()), mu(lambda.size());
  f.constraint_increments(x, rates);
  f.solve(y, VecX(-rates), penalty_mass, mu, 0);
  return y;
}

}  // namespace

VecX mass_diagonal(Formulation& f, const State& state) {
  VecX r0(f.velocities());
  f.residual(VecX::Zero(f.velocities()), state.lambda, 0.0, r0);
  check_magnitudes(r0, [&](int i) { return f.coordinate_owner(i); });
  VecX diagonal = f.mass_diagonal();
  check_masses(diagonal, [&](int i) { return f.coordinate_owner(i); });
  return diagonal;
}

double growth_of_motions(Formulation& f, const VecX& scale, double s, double penalty_mass) {
  constexpr int slot = 1;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // Round-off of the full penalty would look like mass.
  if (f.factorize(1.0, 0.0, s, 1e-5 * penalty_mass / s, slot) >= 0) return infinite;
  VecX x(scale.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = varied(i) / std::sqrt(scale[i]);
  double growth = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    x /= std::sqrt(x.dot(scale.cwiseProduct(x)));
    x = scale.cwiseProduct(x).eval();
    f.solve(x, slot);
    const double grown = std::sqrt(x.dot(scale.cwiseProduct(x)));
    if (!std::isfinite(grown)) return infinite;
    growth = std::max(growth, grown);
  }
  return growth;
}

double growth_by_mass(Formulation& f, const VecX& diagonal, const VecX& possible,
                      double penalty_mass) {
  if (diagonal.size() == 0) return 0.0;
  if (!(diagonal.maxCoeff() > 0.0)) return std::numeric_limits<double>::infinity();
  constexpr double s = 1e-30;
  return growth_of_motions(f, mass_scale(diagonal, possible), s, penalty_mass);
}

bool may_lack_mass(Formulation& f, const VecX& diagonal, const VecX& possible,
                   double penalty_mass) {
  return may_lack_mass(growth_by_mass(f, diagonal, possible, penalty_mass));
}

bool may_lack_mass(double growth) { return !(growth < 0.1 / no_mass); }

bool lacks_mass(double growth) { return !(growth < 1e12); }

bool start_by_passes(Formulation& f, State& state, double s, double least_penalty, bool lacks_mass,
                     bool must_settle) {
  const double penalty_mass = penalty_of_passes(f, least_penalty);
  if (f.factorize(1.0, 0.0, s, penalty_mass / s) >= 0) return false;
  const int nv = f.velocities(), nc = f.constraints();
  state.a = VecX::Zero(nv);
  state.lambda = VecX::Zero(nc);
  const VecX no_lambda = state.lambda;
  VecX r(nv), r0(nv), gamma(nc), mu(nc);
  f.residual(state.a, no_lambda, 0.0, r0);
  double violation = 0.0, before = std::numeric_limits<double>::infinity();
  bool settled = false;
  for (int pass = 0; pass < 60 && !settled; ++pass) {
    f.residual(state.a, state.lambda, 0.0, r);
    f.constraint_accelerations(state.a, gamma);
    VecX delta = -r;
    f.solve(delta, gamma, penalty_mass, mu, 0);
    if (lacks_mass)
      for (int k = 0; k < 2; ++k) delta = with_mass(f, delta, r0, no_lambda, penalty_mass);
    state.a += delta;
    f.constraint_accelerations(state.a, gamma);
    state.lambda += penalty_mass * mu;
    f.residual(state.a, state.lambda, 0.0, r);
    f.balance(state.lambda, r);
    violation = nc > 0 ? gamma.lpNorm<Eigen::Infinity>() : 0.0;
    if (!delta.allFinite()) return false;
    const double size = 1.0 + state.a.lpNorm<Eigen::Infinity>();
    const double change = delta.lpNorm<Eigen::Infinity>();
    // In long systems rounding exceeds the first limit: then changes no longer decrease.
    settled = pass > 0 && violation < 1e-9 * size &&
              (change < 1e-9 * size || (change > 0.3 * before && change < 1e-6 * size));
    before = change;
  }
  const double size = 1.0 + state.a.lpNorm<Eigen::Infinity>();
  return (settled || !must_settle) && state.a.allFinite() && violation < 1e-5 * size && size < 1e7;
}

bool start_held_by_stiffness(Formulation& f, State& state, const VecX& scale, double penalty_mass) {
  // Without mass and stiffness only rounding is left of a direction, whatever s.
  const double nothing = growth_of_motions(f, scale, 1e-30, penalty_mass);
  // Above the size for dense linear algebra the passes decide, as far as rounding permits.
  const bool large = scale.size() > most_dense;
  double s = regularisation_scale(f);
  const int attempts = large || !bent(f) ? 2 : 0;
  for (int attempt = 0; attempt < attempts; ++attempt, s *= 1e-3) {
    const double held = large ? 0.0 : growth_of_motions(f, scale, s, penalty_mass);
    if (!(held < 1e13 && held < 1e-2 * nothing)) break;
    if (start_by_passes(f, state, s, penalty_mass, true, !large || attempt == 0)) return true;
  }
  // Or the mass is small but above rounding: long chains fold with 1e-10 of their mass.
  return !lacks_mass(nothing) && start_by_passes(f, state, no_stiffness, penalty_mass, false, true);
}

std::vector<std::string> massless_notes(Formulation& f, const State& state, double penalty_mass) {
  const std::vector<Body>& all = f.model().bodies;
  const auto bends = [](const Body& b) { return b.modes() > 0; };
  if (std::none_of(all.begin(), all.end(), bends)) return {};
  const int nv = f.velocities();
  const double s = regularisation_scale(f), penalty = penalty_of_passes(f, penalty_mass);
  const VecX no_lambda = VecX::Zero(f.constraints());
  VecX r0(nv);
  f.residual(VecX::Zero(nv), no_lambda, 0.0, r0);
  if (nv == 0 || f.factorize(1.0, 0.0, s, penalty / s) >= 0) return {};
  VecX x(nv);
  for (Eigen::Index i = 0; i < nv; ++i) x[i] = varied(i);
  VecX with = x;
  for (int pass = 0; pass < 2; ++pass) with = with_mass(f, with, r0, no_lambda, penalty);
  constexpr double noticeable = 1e-3;
  const VecX without = x - with;
  if (!without.allFinite() || !(largest(without) > noticeable)) return {};
  std::vector<std::string> notes;
  for (const std::size_t i : bodies_moved(f, state, without)) {
    if (!(all[i].data->invariants.m > 0.0)) {
      notes.clear();
      break;
    }
    if (bends(all[i]))
      notes.push_back(
          fmt::format("body '{}' has a motion without mass that stiffness holds (the spin of a bar "
                      "about its axis): the trapezoidal rule gives way to a spectral radius of "
                      "{:g}; mass_model: hermite with section_inertia: true gives it inertia",
                      all[i].name, massless_spectral_radius));
  }
  dynamics_at(f, state);
  return notes;
}

}  // namespace floatframe

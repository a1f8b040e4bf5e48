#pragma once
// Why a run may end that was begun with good masses: on the way a freedom loses its mass (a bar
// without spin inertia whose joint comes to turn about the bar, a body held by forces alone). Its
// speed is then unbounded, or its place jumps, and no step is small enough.
#include <fmt/format.h>

#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/initial_state.hpp"

namespace floatframe {

/// Directions (columns) that the constraints J leave free and along which the mass is less than
/// `light` of what the coordinates have by themselves or could have (`possible_masses`).
MatX light_directions(const MatX& mass, const VecX& possible, const MatX& J, double light);

/// The combinations of `directions` that move body frames. What is left out are modes without mass
/// (torsion of a bar without spin inertia): their stiffness holds them.
template <class F>
MatX moving_frames(F& f, const State& state, const MatX& directions) {
  constexpr double moves = 1e-3;
  const auto bodies = static_cast<Eigen::Index>(f.model().bodies.size());
  MatX frames(6 * bodies, directions.cols());
  f.positions(state.t, state.q);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    f.velocities(directions.col(k).normalized());
    for (Eigen::Index i = 0; i < bodies; ++i) {
      frames.block<3, 1>(6 * i, k) = f.body_velocity(static_cast<int>(i));
      frames.block<3, 1>(6 * i + 3, k) = f.body_angular_velocity(static_cast<int>(i));
    }
  }
  const SymmetricEigen eig = symmetric_eigen(frames.transpose() * frames);
  Eigen::Index still = 0;  // ascending eigenvalues
  while (still < directions.cols() && !(eig.values[still] > moves * moves)) ++still;
  return directions.colwise().normalized() * eig.vectors.rightCols(directions.cols() - still);
}

/// What the failure of a run at this state should add, beginning with "; ", or nothing.
template <class F>
std::string light_motion_note(F& f, const State& state) {
  constexpr int most = 1000;  // dense linear algebra beyond would take minutes
  constexpr double light = 1e-4;
  const int nv = f.velocities(), nc = f.constraints();
  if (nv == 0 || nv > most || !state.q.allFinite() || !state.v.allFinite()) return {};
  const VecX possible = possible_masses(f, state);
  f.positions(state.t, state.q);
  f.velocities(state.v);
  f.dynamics();
  const VecX zero = VecX::Zero(nv), no_lambda = VecX::Zero(nc);
  VecX r0(nv), column(nv);
  f.residual(zero, no_lambda, 0.0, r0);
  const VecX test = test_accelerations(r0, possible);
  MatX mass(nv, nv);
  for (int j = 0; j < nv; ++j) {
    f.residual(test[j] * VecX::Unit(nv, j), no_lambda, 0.0, column);
    mass.col(j) = (column - r0) / test[j];
  }
  const MatX J = f.constraint_jacobian();
  if (!mass.allFinite() || !J.allFinite()) return {};
  MatX loose = light_directions(mass, possible, J, light);
  if (loose.cols() > 0) loose = moving_frames(f, state, loose);
  if (loose.cols() == 0) return {};
  return fmt::format(
      "; {} can move there almost without mass, so that nothing but forces limits where to and how "
      "fast: give mass or inertia, or remove the freedom",
      moving_bodies(f, state, loose));
}

}  // namespace floatframe

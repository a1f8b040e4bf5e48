#include "floatframe/start/light_motion.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {
namespace {

/// The mass that combinations of the `motions` (columns) could have: the quadratic form of the sum
/// of m (v^2 + w^2 l^2) over the bodies, with the velocity v of the body frame and the
/// characteristic length l, and m x^2 of modes. It depends on the bodies only, not on the
/// coordinates that describe a motion.
MatX possible_mass_of(Formulation& f, const State& state, const MatX& motions) {
  const Model& model = f.model();
  const std::size_t n = model.bodies.size();
  Eigen::Index rows = 0;
  for (std::size_t i = 0; i < n; ++i) rows += 6 + model.bodies[i].modes();
  MatX moved(rows, motions.cols());
  f.positions(state.t, state.q);
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const VecX v = motions.col(k);
    f.velocities(v);
    const SystemMotion& motion = f.motion();
    Eigen::Index at = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const BodyKinematics& b = motion.bodies[i];
      const double l = model.bodies[i].length, root = std::sqrt(possible_mass(model, i));
      moved.block<3, 1>(at, k) = root * b.v_WB;
      moved.block<3, 1>(at + 3, k) = root * l * b.w_WB;
      at += 6;
      for (int m = 0; m < model.bodies[i].modes(); ++m, ++at)
        moved(at, k) = std::sqrt(possible_modal_mass(model, i, m, l * l)) * b.yd[m];
    }
  }
  return moved.transpose() * moved;
}

/// The combinations of `motions` whose mass is less than `light` times the possible mass.
MatX light_directions(const MatX& mass, const MatX& possible_mass, const MatX& motions,
                      double light) {
  const MatX own = motions.transpose() * mass * motions;
  const SymmetricEigen eig = generalised_eigen(0.5 * (own + own.transpose()), possible_mass);
  if (!eig.found) return MatX(mass.rows(), 0);
  Eigen::Index count = 0;  // ascending eigenvalues
  while (count < motions.cols() && eig.values[count] <= light) ++count;
  return motions * eig.vectors.leftCols(count);
}

/// The combinations of `directions` that move body frames. The rest are massless modes (torsion of
/// a bar without spin inertia), which are held by their stiffness.
MatX moving_frames(Formulation& f, const State& state, const MatX& directions) {
  constexpr double moves = 1e-3;
  const auto bodies = static_cast<Eigen::Index>(f.model().bodies.size());
  MatX frames(6 * bodies, directions.cols());
  f.positions(state.t, state.q);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    f.velocities(directions.col(k).normalized());
    const SystemMotion& motion = f.motion();
    for (Eigen::Index i = 0; i < bodies; ++i) {
      const BodyKinematics& b = motion.body(static_cast<int>(i));
      frames.block<3, 1>(6 * i, k) = b.v_WB;
      frames.block<3, 1>(6 * i + 3, k) = b.w_WB;
    }
  }
  const SymmetricEigen eig = symmetric_eigen(frames.transpose() * frames);
  Eigen::Index still = 0;  // ascending eigenvalues
  while (still < directions.cols() && !(eig.values[still] > moves * moves)) ++still;
  return directions.colwise().normalized() * eig.vectors.rightCols(directions.cols() - still);
}

}  // namespace

std::string light_motion_note(Formulation& f, const State& state) {
  constexpr int most = 1000;      // dense linear algebra above this would take minutes
  constexpr double light = 1e-6;  // a radius of gyration of a thousandth of the length
  const int nv = f.velocities(), nc = f.constraints();
  if (nv == 0 || nv > most || !state.q.allFinite() || !state.v.allFinite()) return {};
  const VecX possible = possible_masses(f, state);
  const VecX no_lambda = VecX::Zero(nc);
  const VecX r0 = residual_at(f, state.t, state.q, state.v, no_lambda);
  const MatX mass = mass_matrix(f, test_accelerations(r0, possible), r0, no_lambda);
  const MatX J = f.constraint_jacobian();
  if (!mass.allFinite() || !J.allFinite()) return {};
  const MatX N = free_motions(J, possible);
  if (N.cols() == 0) return {};
  MatX loose = light_directions(mass, possible_mass_of(f, state, N), N, light);
  if (loose.cols() > 0) loose = moving_frames(f, state, loose);
  if (loose.cols() == 0) return {};
  return fmt::format(
      "; {} can move there almost without mass, so that nothing but forces limits where to and how "
      "fast: give mass or inertia, or remove the freedom",
      moving_bodies(f, state, loose));
}

}  // namespace floatframe

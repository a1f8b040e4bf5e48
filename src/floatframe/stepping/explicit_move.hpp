#pragma once
// A motion over a small fraction of a step by a single explicit formula. A regular step of that
// size would convert constraint residuals within the tolerances into accelerations. Each coordinate
// moves as an uncoupled oscillator of frequency omega by the trapezoidal rule,
//   v1 (1 + omega^2 dt^2/4) = v (1 - omega^2 dt^2/4) + dt a,   x = dt (v + v1)/2
// which is v + dt a for omega = 0; then velocities are projected onto the constraints. The error is
// of second order in the length of the move.
#include <cassert>

#include "floatframe/integrator/integrator.hpp"

namespace floatframe {

class ExplicitMove {
 public:
  ExplicitMove(Formulation& formulation, Integrator& integrator)
      : f_(formulation), integrator_(integrator) {
    x_ = VecX::Zero(f_.velocities());
    q_ = VecX::Zero(f_.configurations());
  }

  /// Moves by dt along velocities and accelerations; h: the step size.
  void operator()(State& state, double dt, double h) noexcept {
    assert(h > 0.0 && state.v.size() == x_.size() && state.a.size() == x_.size());
    assert(state.q.size() == q_.size());
    if (!(dt > 0.0)) return;
    const VecX& omega2 = f_.own_frequencies_squared();
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const double turn = 0.25 * dt * dt * omega2[i], before = state.v[i];
      state.v[i] = (before * (1.0 - turn) + dt * state.a[i]) / (1.0 + turn);
      x_[i] = 0.5 * dt * (before + state.v[i]);
    }
    f_.settle(state.q, x_);
    f_.retract(state.q, x_, q_);
    state.q.swap(q_);
    if (state.z.size() > 0) state.z += dt * state.zd;
    state.t += dt;
    integrator_.project_velocities(state, h);
  }

 private:
  Formulation& f_;
  Integrator& integrator_;
  VecX x_, q_;
};

}  // namespace floatframe

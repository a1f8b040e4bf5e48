#pragma once
// The steady state of a model whose rotor turns at a constant speed W. All joints are at rest
// except that of the rotor, v = W s(q); the deformed shape of the rotor is constant in the inertial
// frame, y = D(-theta) y_W, so that ydot = -W G y, yddot = W^2 G^2 y (rotor.hpp). Newton's method
// finds q, the multipliers and the torque tau that maintains the speed, from
//   M(q) a - Q(q, v) + Phi_q^T lambda + s tau = 0,  Phi = 0,  s^T x = 0                         (1)
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/rotors/rotor.hpp"

namespace floatframe {

struct SteadyTurning {
  State state;
  double speed = 0.0;   ///< [rad/s]
  double angle = 0.0;   ///< of the rotor relative to its start
  double torque = 0.0;  ///< on the rotor, 0 if it is driven [N m]
};

/// The direction of the velocities that turns the rotor, at the state of `f`.
VecX spin_of(const RelativeFormulation& f, const Rotor& rotor);

/// Velocities and accelerations of steady turning at q, where `f` must be.
void turn_steadily(const RelativeFormulation& f, const Rotor& rotor, const VecX& q, double speed,
                   VecX& v, VecX& a);

/// q with the rotor turned by an angle and its shape constant in the inertial frame. Moves `f`.
VecX turned(RelativeFormulation& f, const Rotor& rotor, const VecX& q, double angle);

/// Starts at q0. A driven rotor is driven at this speed to this angle by the model of `f`. Throws
/// RunError if there is no steady state.
SteadyTurning steady_turning(RelativeFormulation& f, const Rotor& rotor, const VecX& q0,
                             double speed, double angle);

}  // namespace floatframe

#include "floatframe/rotors/steady_turning.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/tangents/linearization.hpp"

namespace floatframe {
namespace {

/// The unknowns of (1): increments of q, of the multipliers, and the torque without a drive.
class TurningEquations {
 public:
  TurningEquations(RelativeFormulation& f, const Rotor& rotor, double speed)
      : f_(f), rotor_(rotor), speed_(speed) {}

  VecX residual(const VecX& q, const VecX& lambda) {
    VecX r(f_.velocities());
    f_.positions(0.0, q);
    turn_steadily(f_, rotor_, q, speed_, v, a);
    f_.velocities(v);
    f_.dynamics();
    f_.residual(a, lambda, 0.0, r);
    return r;
  }

  /// One Newton step from q, lambda, tau: increments of all of them.
  VecX step(const VecX& q, const VecX& lambda, double tau) {
    const int nv = f_.velocities(), nc = f_.constraints(), extra = rotor_.driven ? 0 : 1;
    const VecX r = residual(q, lambda), phi = f_.constraint_values();
    const VecX turn = spin_of(f_, rotor_);
    const MatX J = f_.constraint_jacobian();
    VecX at = q;
    MatX A = MatX::Zero(nv + nc + extra, nv + nc + extra);
    VecX b = VecX::Zero(A.rows());
    A.topLeftCorner(nv, nv) = central_differences(nv, 1e-6, [&](const VecX& d) {
      f_.retract(q, d, at);
      return residual(at, lambda);
    });
    A.block(0, nv, nv, nc) = J.transpose();
    A.block(nv, 0, nc, nv) = J;
    b.head(nv) = -r;
    b.segment(nv, nc) = -phi;
    if (extra == 1) {
      A.block(0, nv + nc, nv, 1) = turn;
      A.block(nv + nc, 0, 1, nv) = turn.transpose();
      b.head(nv) -= tau * turn;
    }
    const VecX unit = equilibration(A);
    const MatX scaled = unit.asDiagonal() * A * unit.asDiagonal();
    return unit.cwiseProduct(LeastNorm(scaled, 1e-13).solve(VecX(unit.cwiseProduct(b))));
  }

  VecX v, a;  ///< of the last residual

 private:
  RelativeFormulation& f_;
  const Rotor& rotor_;
  double speed_;
};

/// Checks that the constraints hold during the whole rotation, not only at this angle.
void require_motion(RelativeFormulation& f, const Rotor& rotor, const SteadyTurning& s) {
  VecX rate(f.constraints()), acceleration(f.constraints());
  f.constraint_rates(rate);
  f.constraint_accelerations(s.state.a, acceleration);
  if (largest(rate) > 1e-6 * std::abs(s.speed) || largest(acceleration) > 1e-6 * s.speed * s.speed)
    throw RunError(ErrorCode::not_steady,
                   fmt::format("'{}' at {:g} rad/s: other joints move when the rotor turns, so "
                               "that there is no steady state",
                               rotor.name, s.speed));
}

}  // namespace

VecX spin_of(const RelativeFormulation& f, const Rotor& rotor) {
  VecX s = VecX::Zero(f.velocities());
  if (rotor.free)
    s.segment<3>(rotor.coordinate) = f.tree().body(rotor.body).motion.R_FM * rotor.axis_F;
  else
    s[rotor.coordinate] = rotor.sign;
  return s;
}

void turn_steadily(const RelativeFormulation& f, const Rotor& rotor, const VecX& q, double speed,
                   VecX& v, VecX& a) {
  v = speed * spin_of(f, rotor);
  a = VecX::Zero(v.size());
  for (const RotorBody& r : rotor.bodies) {
    const TreeBody& b = f.tree().body(r.body);
    const VecX rate = -speed * (r.G * q.segment(b.iyq, b.nm));
    v.segment(b.iy, b.nm) = rate;
    a.segment(b.iy, b.nm) = -speed * (r.G * rate);
  }
}

VecX turned(RelativeFormulation& f, const Rotor& rotor, const VecX& q, double angle) {
  VecX there = q;
  if (angle == 0.0) return there;
  f.positions(0.0, q);
  f.retract(q, VecX(angle * spin_of(f, rotor)), there);
  for (const RotorBody& r : rotor.bodies) {
    const TreeBody& b = f.tree().body(r.body);
    there.segment(b.iyq, b.nm) = turned_modes(r.G, -angle) * q.segment(b.iyq, b.nm);
  }
  return there;
}

SteadyTurning steady_turning(RelativeFormulation& f, const Rotor& rotor, const VecX& q0,
                             double speed, double angle) {
  const int nv = f.velocities(), nc = f.constraints();
  SteadyTurning s;
  s.speed = speed;
  s.angle = angle;
  s.state.q = turned(f, rotor, q0, angle);
  s.state.lambda = VecX::Zero(nc);
  TurningEquations equations(f, rotor, speed);
  VecX at = s.state.q;
  double tau = 0.0, before = std::numeric_limits<double>::infinity();
  for (int k = 0;; ++k) {
    VecX step = equations.step(s.state.q, s.state.lambda, tau);
    const double length = largest(step.head(nv));
    if (!std::isfinite(length) || k > 60)
      throw RunError(ErrorCode::not_steady,
                     fmt::format("'{}' at {:g} rad/s: no steady state was found{}", rotor.name,
                                 speed, rotor.other_axis));
    s.state.lambda += step.segment(nv, nc);  // linear in these: exact after the first step
    if (!rotor.driven) tau += step[nv + nc];
    if (length < 1e-13 || (length < 1e-9 && length >= 0.5 * before)) break;
    before = length;
    if (length > 0.2) step.head(nv) *= 0.2 / length;
    f.retract(s.state.q, VecX(step.head(nv)), at);
    s.state.q = at;
  }
  equations.residual(s.state.q, s.state.lambda);
  s.state.v = equations.v;
  s.state.a = equations.a;
  s.torque = -tau;
  require_motion(f, rotor, s);
  return s;
}

}  // namespace floatframe

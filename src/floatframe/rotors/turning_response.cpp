// Outputs of a rotating model under forces that rotate with its rotor.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/resolvent.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/rotors/turning_state.hpp"

namespace floatframe {
namespace {

using Complex = std::complex<double>;
constexpr Complex imaginary(0.0, 1.0);

/// Generalised force of a unit of size at each point, together.
Eigen::VectorXcd generalised(RelativeFormulation& f, const Model& model, const State& s,
                             const std::vector<AxisForce>& forces, const Mat3& directions) {
  const int nv = f.velocities();
  Eigen::VectorXcd Q = Eigen::VectorXcd::Zero(nv);
  f.positions(s.t, s.q);
  for (int j = 0; j < nv; ++j) {
    const VecX unit = VecX::Unit(nv, j);
    f.velocities(unit);
    const SystemMotion& motion = f.motion();
    for (const AxisForce& force : forces) {
      const Body& body = model.bodies[force.body];
      const BodyKinematics& b = motion.body(force.body);
      Vec3 p = force.p_BP, rate = Vec3::Zero();
      if (force.node >= 0) {
        const ModalNode& n = body.data->nodes[force.node];
        p = n.p + n.X * b.y;
        rate = n.X * b.yd;
      }
      const Vec3 v = b.v_WB + b.w_WB.cross(b.R_WB * p) + b.R_WB * rate;
      Q[j] += force.size * Complex(directions.col(0).dot(v), -directions.col(1).dot(v));
    }
  }
  return Q;
}

/// Increments, velocities and accelerations, as amplitudes of e^(i W t).
struct Phasors {
  Eigen::VectorXcd x, v, a;
};

class OutputSlopes {
 public:
  OutputSlopes(RelativeFormulation& f, const State& s, const std::vector<int>& outputs)
      : f_(f), s_(s), outputs_(outputs), followed_(followed_outputs(f.model().outputs)) {
    steps_ = motion_steps(f.model(), possible_masses(f, s));
    const VecX still = VecX::Zero(f.velocities());
    means_ = values(still, still, still);
  }

  TurningResponse of(const Phasors& p) {
    TurningResponse r;
    r.means = means_;
    r.smooth.assign(outputs_.size(), 1);
    r.amplitudes = slope(p.x.real(), p.v.real(), p.a.real(), r.smooth) +
                   imaginary * slope(p.x.imag(), p.v.imag(), p.a.imag(), r.smooth);
    return r;
  }

 private:
  VecX values(const VecX& x, const VecX& dv, const VecX& da) {
    State s = s_;
    f_.retract(s_.q, x, s.q);
    s.v = s_.v + dv;
    s.a = s_.a + da;
    dynamics_at(f_, s);
    f_.set_accelerations(s.a);
    const SystemMotion& motion = f_.motion({.accelerations = true, .energies = true});
    VecX y(static_cast<Eigen::Index>(outputs_.size()));
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const Output& output = f_.model().outputs[outputs_[k]];
      if (!followed_[outputs_[k]].started) output_value(motion, output, followed_[outputs_[k]]);
      FollowedOutput last = followed_[outputs_[k]];
      y[k] = output_value(motion, output, last);
    }
    return y;
  }

  Eigen::VectorXcd slope(const VecX& x, const VecX& v, const VecX& a, std::vector<char>& smooth) {
    double h = 1e300;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      if (x[j] != 0.0) h = std::min(h, steps_[j] / std::abs(x[j]));
      if (v[j] != 0.0) h = std::min(h, 10.0 * steps_[j] / std::abs(v[j]));
    }
    if (h > 1e290) return Eigen::VectorXcd::Zero(means_.size());
    const auto at = [&](double s) { return VecX(values(s * x, s * v, s * a)); };
    const VecX ahead = at(h), behind = at(-h), near = at(0.5 * h), back = at(-0.5 * h);
    for (Eigen::Index k = 0; k < means_.size(); ++k) {
      const double bend = std::abs(near[k] + back[k] - 2.0 * means_[k]),
                   size = std::abs(near[k] - means_[k]) + std::abs(back[k] - means_[k]);
      if (bend > 0.5 * size && bend > 1e-12 * (1.0 + std::abs(means_[k]))) smooth[k] = 0;
    }
    return ((4.0 * (near - back) / h - (ahead - behind) / (2.0 * h)) / 3.0).cast<Complex>();
  }

  RelativeFormulation& f_;
  const State& s_;
  const std::vector<int>& outputs_;
  std::vector<FollowedOutput> followed_;
  VecX steps_, means_;
};

/// Columns of real and imaginary part, joined.
Eigen::VectorXcd both(const MatX& columns) {
  return columns.col(0).cast<Complex>() + imaginary * columns.col(1).cast<Complex>();
}

}  // namespace

Mat3 TurningModel::directions() const {
  const Rotor& rotor = impl_->rotor;
  const RotorBody& first = rotor.bodies.front();
  const Vec3 e = impl_->model.bodies[first.body].X_WB.R * first.axis;
  Mat3 d;
  d << rotor.e_1, e.cross(rotor.e_1), e;
  return d;
}

TurningResponse TurningModel::response(double speed, const std::vector<AxisForce>& forces,
                                       const std::vector<int>& outputs, double angle) {
  const Mat3 frame = directions();
  // For the system at an angle z and loads; at angle 0 in the inertial frame.
  const auto linear_at = [&](const SteadyTurning& s, LinearInputs& moved) {
    RelativeFormulation& f = *impl_->f;
    const Eigen::VectorXcd Q = generalised(f, impl_->model, s.state, forces, frame);
    const Eigen::Index nv = f.velocities(), nc = f.constraints();
    InputMotions inputs;
    inputs.value = MatX::Zero(nc, 2);
    for (int k = 0; k < 3; ++k) {
      inputs.residual[k] = MatX::Zero(nv, 2);
      inputs.rate[k] = inputs.acceleration[k] = MatX::Zero(nc, 2);
    }
    inputs.residual[0].col(0) = -Q.real();
    inputs.residual[0].col(1) = -Q.imag();
    return linear_system_at(f, s.state, &inputs, &moved);
  };
  SteadyTurning s;
  impl_->in_world(speed, 0.0, s);  // also decides whether the weight is included
  LinearInputs moved;
  LinearSystem system = linear_at(s, moved);
  const Impl::InWorld here = impl_->in_world(s, system);
  const Complex iW(0.0, speed);
  Eigen::VectorXcd b = both(moved.B[0]) + iW * both(moved.B[1]) + iW * iW * both(moved.B[2]);
  Eigen::MatrixXcd z;
  if (!Resolvent(least_squares(here.T, here.rate)).solve(iW, b, z))
    throw RunError(
        ErrorCode::resonance,
        fmt::format(
            "'{}' at {:g} rad/s: a critical speed without damping, the response has no bound",
            impl_->rotor.name, speed));
  if (angle != 0.0) {
    s = impl_->steady(speed, angle);
    system = linear_at(s, moved);
    const Impl::InWorld there = impl_->in_world(s, system);
    const MatX re = least_squares(there.T, here.T * z.real()),
               im = least_squares(there.T, here.T * z.imag());
    z = re.cast<Complex>() + imaginary * im.cast<Complex>();
  }
  Phasors p;
  p.x = system.x_of * z + both(moved.x);
  p.v = system.v_of * z + both(moved.v[0]) + iW * both(moved.v[1]);
  p.a = system.a_of * z + both(moved.a[0]) + iW * both(moved.a[1]) + iW * iW * both(moved.a[2]);
  return OutputSlopes(*impl_->f, s.state, outputs).of(p);
}

}  // namespace floatframe

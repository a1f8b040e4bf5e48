#include "floatframe/rotors/turning_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/rotors/turning_state.hpp"
#include "floatframe/rotors/whirl.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {

SteadyTurning TurningModel::Impl::steady(double speed, double angle) {
  if (rotor.driven) {
    const Joint& joint = model.joints[rotor.joint];
    const double begin = joint.position.empty() ? 0.0 : joint.position.back();
    model.elements[joint.motion].signals[0].function =
        TimeFunction{PiecewisePolynomial::polynomial({begin + angle, speed})};
    f = std::make_unique<RelativeFormulation>(model, model.simulation.inertia);
  }
  SteadyTurning s = steady_turning(*f, rotor, q, speed, angle);
  if (angle == 0.0) q = s.state.q;
  return s;
}

/// W: maps velocities to the inertial frame, for each body the velocity of a point (of the axis,
/// else the origin), its angular velocity times a length, and amplitude rates, those of the rotor
/// rotated by `angle` into the inertial frame. At the present positions of `f`.
MatX TurningModel::Impl::motion_map(const SteadyTurning& s, double angle) const {
  const int nv = f->velocities();
  Eigen::Index rows = 0;
  for (const Body& b : model.bodies) rows += 6 + b.modes();
  MatX W = MatX::Zero(rows, nv);
  std::vector<const RotorBody*> turning(model.bodies.size(), nullptr);
  for (const RotorBody& r : rotor.bodies) turning[r.body] = &r;
  std::vector<MatX> D(model.bodies.size());
  for (std::size_t i = 0; i < D.size(); ++i)
    if (turning[i]) D[i] = turned_modes(turning[i]->G, s.angle + angle);
  for (int j = 0; j < nv; ++j) {
    const VecX unit = VecX::Unit(nv, j);
    f->velocities(unit);
    const SystemMotion& motion = f->motion();
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const BodyKinematics& b = motion.bodies[i];
      const Eigen::Index nm = b.y.size();
      Vec3 v = b.v_WB;
      const Vec3& w = b.w_WB;
      if (turning[i]) v += w.cross(b.R_WB * turning[i]->p_BP);
      W.block<3, 1>(row, j) = v;
      W.block<3, 1>(row + 3, j) = rotor.length * w;
      W.block(row + 6, j, nm, 1) = turning[i] ? VecX(D[i] * b.yd) : VecX(b.yd);
      row += 6 + nm;
    }
  }
  return W;
}

/// (W 0; d(W v)/dq W), at `angle` later along the steady motion.
MatX TurningModel::Impl::world_map(const SteadyTurning& s, double angle) const {
  const VecX q1 = turned(*f, rotor, s.state.q, angle);
  VecX v, a, q2 = q1;
  f->positions(0.0, q1);
  turn_steadily(*f, rotor, q1, s.speed, v, a);
  const MatX W = motion_map(s, angle);
  const Eigen::Index nv = W.cols(), n = W.rows();
  MatX map = MatX::Zero(2 * n, 2 * nv);
  map.topLeftCorner(n, nv) = W;
  map.bottomRightCorner(n, nv) = W;
  if (s.speed != 0.0)
    map.bottomLeftCorner(n, nv) =
        precise_differences(VecX::Constant(nv, 1e-3), 0, [&](const VecX& x) {
          f->retract(q1, x, q2);
          f->positions(0.0, q2);
          return VecX(motion_map(s, angle) * v);
        }).columns;
  return map;
}

TurningModel::Impl::InWorld TurningModel::Impl::in_world(const SteadyTurning& s) {
  return in_world(s, linear_system_at(*f, s.state));
}

TurningModel::Impl::InWorld TurningModel::Impl::in_world(const SteadyTurning& s,
                                                         const LinearSystem& system) {
  massless = system.massless;
  const Eigen::Index nv = system.x_of.rows(), nz = system.A.rows();
  MatX z(2 * nv, nz), rates(2 * nv, nz);
  z << system.x_of, system.v_of;
  rates << system.xdot_of, system.a_of;
  InWorld w;
  const MatX here = world_map(s, 0.0);
  w.T = here * z;
  w.rate = here * rates;
  if (s.speed != 0.0) {
    constexpr double h = 0.02;
    const auto slope = [&](double step) {
      return MatX((world_map(s, step) - world_map(s, -step)) / (2.0 * step));
    };
    w.rate += s.speed * ((4.0 * slope(0.5 * h) - slope(h)) / 3.0) * z;
  }
  return w;
}

/// The shape of the rotor rotates in the axes of the rotor.
bool TurningModel::Impl::bent(const SteadyTurning& s) const {
  for (const RotorBody& r : rotor.bodies) {
    const TreeBody& b = f->tree().body(r.body);
    const Body& body = model.bodies[r.body];
    const VecX change = r.G * s.state.q.segment(b.iyq, b.nm);
    for (const ModalNode& n : body.data->nodes)
      if ((n.X * change).norm() > 1e-9 * body.length) return true;
  }
  return false;
}

/// Massless directions follow the others statically: a bend that rotates through them would require
/// the rates of the directions they follow.
TurningModel::Impl::InWorld TurningModel::Impl::in_world(double speed, double angle,
                                                         SteadyTurning& s) {
  s = steady(speed, angle);
  InWorld w = in_world(s);
  if (massless == 0 || speed == 0.0 || !bent(s)) return w;
  if (!(model.gravity.norm() > 0.0))
    throw RunError(ErrorCode::singular,
                   fmt::format("'{}' at {:g} rad/s: the rotor turns bent by loads, and {} of its "
                               "motions have no mass; give all of its bodies inertia (bars: "
                               "mass_model: hermite, section_inertia: true)",
                               rotor.name, speed, massless));
  model.gravity.setZero();
  f = std::make_unique<RelativeFormulation>(model, model.simulation.inertia);
  notes.push_back(
      fmt::format("without weight: {} motions have no mass, and would meet a shape that sags "
                  "(bars: mass_model: hermite, section_inertia: true)",
                  massless));
  return in_world(speed, angle, s);
}

MatX least_squares(const MatX& T, const MatX& B) {
  const VecX unit = T.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  return unit.asDiagonal() * qr_solve(T * unit.asDiagonal(), B);
}

TurningModel::TurningModel(const Model& model, const std::string& joint,
                           const std::optional<Vec3>& axis)
    : impl_(std::make_unique<Impl>()) {
  impl_->model = built(model);
  impl_->f = std::make_unique<RelativeFormulation>(impl_->model, model.simulation.inertia);
  impl_->rotor = find_rotor(*impl_->f, joint, axis);
  VecX v;
  impl_->f->start(impl_->q, v);
  close_loops(*impl_->f, impl_->q, v, true);
}

TurningModel::~TurningModel() = default;

std::vector<TurningMode> TurningModel::modes(double speed) {
  SteadyTurning s;
  const Impl::InWorld w = impl_->in_world(speed, 0.0, s);
  const GeneralEigen e = general_eigen(least_squares(w.T, w.rate));
  if (!e.found)
    throw RunError(ErrorCode::no_convergence,
                   fmt::format("'{}' at {:g} rad/s: the eigenvalues do not converge",
                               impl_->rotor.name, speed));
  std::vector<TurningMode> modes;
  for (Eigen::Index k = 0; k < e.values.size(); ++k) {
    if (e.values[k].imag() < 0.0) continue;
    TurningMode mode;
    mode.lambda = e.values[k];
    mode.m = w.T * e.vectors.col(k);
    const double size = mode.m.norm();
    if (size > 0.0) mode.m /= size;
    modes.push_back(std::move(mode));
  }
  std::stable_sort(modes.begin(), modes.end(), [](const TurningMode& a, const TurningMode& b) {
    return std::abs(a.lambda) < std::abs(b.lambda);
  });
  describe_whirl(axis_motion(*impl_->f, impl_->rotor, s), modes);
  return modes;
}

double TurningModel::dependence_on_angle(double speed) {
  SteadyTurning s;
  const Impl::InWorld here = impl_->in_world(speed, 0.0, s);
  const MatX B = least_squares(here.T, here.rate);
  const GeneralEigen alone = general_eigen(B);
  const double stiffest = alone.values.cwiseAbs().maxCoeff();
  double worst = 0.0;
  for (const double angle : {0.7, 1.6}) {
    const Impl::InWorld there = impl_->in_world(speed, angle, s);
    const MatX rate = there.rate * least_squares(there.T, here.T);
    const GeneralEigen mixed = general_eigen(least_squares(here.T, 0.5 * (here.rate + rate)));
    if (!mixed.found) return std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < alone.values.size(); ++k) {
      const double size = std::abs(alone.values[k]);
      if (size < 1e-6 * stiffest) continue;  // rigid motions, to round-off
      worst = std::max(worst, (mixed.values.array() - alone.values[k]).abs().minCoeff() / size);
    }
  }
  return worst;
}

const Model& TurningModel::model() const { return impl_->model; }
const Rotor& TurningModel::rotor() const { return impl_->rotor; }
const std::vector<std::string>& TurningModel::notes() const { return impl_->notes; }

double TurningModel::eccentricity() const {
  Vec3 moment = Vec3::Zero();
  double mass = 0.0;
  for (const RotorBody& r : impl_->rotor.bodies) {
    const InertiaInvariants& I = impl_->model.bodies[r.body].data->invariants;
    const Vec3 c = I.centre_of_mass() - r.p_BP;
    const Mat3 R = impl_->model.bodies[r.body].X_WB.R;
    moment += I.m * (R * (c - r.axis * r.axis.dot(c)));
    mass += I.m;
  }
  return mass > 0.0 ? moment.norm() / mass : 0.0;
}

}  // namespace floatframe

// Residual and constraints of the absolute formulation.
#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

void AbsoluteFormulation::dynamics() noexcept {
  assert(calls_.has(CallOrder::velocities));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::dynamics));
  for (BodyData& b : bodies_) b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
  forces();
}

void AbsoluteFormulation::forces() noexcept {
  assert(calls_.has(CallOrder::velocities));
  force_set_.evaluate(Vec3::Zero(), time_,
                      [&](int marker) -> const MarkerState& { return markers_[marker].s; });
}

ForceSide AbsoluteFormulation::force_side(std::size_t force) const noexcept {
  assert(calls_.has(CallOrder::velocities) && force < model_.forces.size());
  return force_set_.side(force, Vec3::Zero(), time_,
                         [&](int marker) -> const MarkerState& { return markers_[marker].s; });
}

void AbsoluteFormulation::add_wrench(int marker, bool through_point, const Vec3& force,
                                     const Vec3& torque, VecX& out) const noexcept {
  assert(is_index(marker, markers_) && out.size() == nq_);
  const MarkerData& m = markers_[marker];
  if (m.body < 0) return;
  const BodyData& b = bodies_[m.body];
  if (through_point && m.point >= 0) {
    out.segment<3>(m.point) += force;
  } else {
    out.segment<3>(b.offset) += force;
    for (int c = 0; c < 3; ++c) out.segment<3>(b.offset + 3 + 3 * c) += m.p_B[c] * force;
    if (m.local) out.segment(b.offset + 12, b.nm).noalias() += m.Jr.transpose() * force;
  }
  if (torque.isZero(0.0)) return;
  for (int c = 0; c < 3; ++c)
    out.segment<3>(b.offset + 3 + 3 * c) += 0.5 * torque.cross(b.A.col(c));
  if (m.rotates) out.segment(b.offset + 12, b.nm).noalias() += m.Jw.transpose() * torque;
}

void AbsoluteFormulation::add_own_constraint_forces(const BodyData& b, const VecX& w,
                                                    VecX& out) const noexcept {
  for (int k = 0; k < 6; ++k) {
    const double x = b.length * w[b.row + k];
    out.segment<3>(b.offset + 3 + 3 * pair_a[k]) += x * b.A.col(pair_b[k]);
    if (k >= 3) out.segment<3>(b.offset + 3 + 3 * pair_b[k]) += x * b.A.col(pair_a[k]);
  }
  for (int p = 0; p < b.points; ++p) {
    const int marker = b.point_marker[p];
    const Vec3 x = w.segment<3>(b.row + 6 + 3 * p);
    add_wrench(marker, false, -x, Vec3::Zero(), out);
    out.segment<3>(b.offset + 12 + b.nm + 3 * p) += x;
  }
}

void AbsoluteFormulation::add_all_constraint_forces(const VecX& w, VecX& out) const noexcept {
  for (const BodyData& b : bodies_) add_own_constraint_forces(b, w, out);
  constraint_set_.add_wrenches(w, [&](int marker, const Vec3& force, const Vec3& torque) {
    add_wrench(marker, true, force, torque, out);
  });
}

void AbsoluteFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(w.size() == constraints() && out.size() == nq_);
  out.setZero();
  add_all_constraint_forces(w, out);
}

void AbsoluteFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  assert(calls_.has(CallOrder::dynamics) && alpha >= 0.0);
  assert(a.size() == nq_ && lambda.size() == constraints() && out.size() == nq_);
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::residual));
  FLOATFRAME_DEBUG(calls_.accelerate());
  a_ = a;
  constraint_set_.set_multipliers(lambda, alpha);
  out.setZero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    b.work = a.segment(b.offset, 12 + b.nm);
    b.work.head<3>() -= model_.gravity;
    auto f = out.segment(b.offset, 12 + b.nm);
    f.noalias() += b.M * b.work;
    f -= b.Qv;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[i].data;
      out.segment(b.offset + 12, b.nm).noalias() += data.K * b.y;
      out.segment(b.offset + 12, b.nm).noalias() += data.D * b.yd;
    }
  }
  force_set_.add_wrenches([&](int marker, const Vec3& force, const Vec3& torque) {
    add_wrench(marker, false, force, torque, out);
  });
  add_all_constraint_forces(constraint_set_.weights(), out);
}

void AbsoluteFormulation::constraint_rates(VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  for (const BodyData& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
      const Vec3 u_dot = b.Adot.col(pair_a[k]), v_dot = b.Adot.col(pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? u.dot(u_dot) : u.dot(v_dot) + v.dot(u_dot));
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = point(b, p);
      out.segment<3>(b.row + 6 + 3 * p) = m.v_P - m.s.v;
    }
  }
  constraint_set_.rates([&](int marker) { return constraint_state(marker); }, out);
}

/// Of the material point of a marker on its body.
Vec3 AbsoluteFormulation::point_increment(const MarkerData& m, const VecX& delta) const noexcept {
  const BodyData& b = bodies_[m.body];
  Vec3 x = delta.segment<3>(b.offset);
  for (int c = 0; c < 3; ++c) x += m.p_B[c] * delta.segment<3>(b.offset + 3 + 3 * c);
  if (m.local) x.noalias() += m.Jr * delta.segment(b.offset + 12, b.nm);
  return x;
}

/// A marker as used by constraints: at its outer point.
PointMotion AbsoluteFormulation::increment_of(int marker, const VecX& delta) const noexcept {
  const MarkerData& m = markers_[marker];
  PointMotion x{Vec3::Zero(), Vec3::Zero()};
  if (m.body < 0) return x;
  const BodyData& b = bodies_[m.body];
  x.linear = m.point >= 0 ? Vec3(delta.segment<3>(m.point)) : point_increment(m, delta);
  for (int c = 0; c < 3; ++c)
    x.angular += 0.5 * b.A.col(c).cross(delta.segment<3>(b.offset + 3 + 3 * c));
  if (m.rotates) x.angular.noalias() += m.Jw * delta.segment(b.offset + 12, b.nm);
  return x;
}

void AbsoluteFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(delta.size() == nq_ && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  for (const BodyData& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 du = delta.segment<3>(b.offset + 3 + 3 * pair_a[k]);
      const Vec3 dv = delta.segment<3>(b.offset + 3 + 3 * pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? b.A.col(pair_a[k]).dot(du)
                                         : b.A.col(pair_a[k]).dot(dv) + b.A.col(pair_b[k]).dot(du));
    }
    for (int p = 0; p < b.points; ++p) {
      out.segment<3>(b.row + 6 + 3 * p) =
          delta.segment<3>(b.offset + 12 + b.nm + 3 * p) - point_increment(point(b, p), delta);
    }
  }
  constraint_set_.increments([&](int marker) { return increment_of(marker, delta); }, out);
}

Vec3 AbsoluteFormulation::marker_acceleration(int index) const noexcept {
  assert(is_index(index, markers_));
  const MarkerData& m = markers_[index];
  if (m.body < 0) return Vec3::Zero();
  const BodyData& b = bodies_[m.body];
  Vec3 x = m.s.a_bias + a_.segment<3>(b.offset);
  for (int c = 0; c < 3; ++c) x += m.p_B[c] * a_.segment<3>(b.offset + 3 + 3 * c);
  if (m.local) x.noalias() += m.Jr * a_.segment(b.offset + 12, b.nm);
  return x;
}

/// A marker as used by constraints: at its outer point.
PointMotion AbsoluteFormulation::acceleration_of(int marker, const VecX& a) const noexcept {
  const MarkerData& m = markers_[marker];
  PointMotion x;
  x.angular = m.s.alpha_bias;
  x.linear = m.point >= 0 ? Vec3(a.segment<3>(m.point)) : marker_acceleration(marker);
  if (m.body < 0) return x;
  const BodyData& b = bodies_[m.body];
  for (int c = 0; c < 3; ++c)
    x.angular += 0.5 * b.A.col(c).cross(a.segment<3>(b.offset + 3 + 3 * c));
  if (m.rotates) x.angular.noalias() += m.Jw * a.segment(b.offset + 12, b.nm);
  return x;
}

void AbsoluteFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(a.size() == nq_ && out.size() == constraints());
  FLOATFRAME_DEBUG(calls_.accelerate());
  FLOATFRAME_DEBUG(poison(out));
  a_ = a;
  for (const BodyData& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
      const Vec3 u_dot = b.Adot.col(pair_a[k]), v_dot = b.Adot.col(pair_b[k]);
      const Vec3 u_ddot = a.segment<3>(b.offset + 3 + 3 * pair_a[k]);
      const Vec3 v_ddot = a.segment<3>(b.offset + 3 + 3 * pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? u.dot(u_ddot) + u_dot.squaredNorm()
                                         : u.dot(v_ddot) + v.dot(u_ddot) + 2.0 * u_dot.dot(v_dot));
    }
    for (int p = 0; p < b.points; ++p) {
      const int marker = b.point_marker[p];
      out.segment<3>(b.row + 6 + 3 * p) =
          a.segment<3>(b.offset + 12 + b.nm + 3 * p) - marker_acceleration(marker);
    }
  }
  constraint_set_.accelerations([&](int marker) { return acceleration_of(marker, a); }, out);
}

}  // namespace floatframe

// Residual and constraints of the absolute formulation.
#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

void AbsoluteFormulation::dynamics() noexcept {
  for (BodyData& b : bodies_) b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
  forces();
}

void AbsoluteFormulation::forces() noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const MarkerState& b = markers_[f.b].s;
    const MarkerState& a = f.a >= 0 ? markers_[f.a].s : b;
    evaluate_force(model_, f, a, b, Vec3::Zero(), time_, force_reference_[k], force_states_[k],
                   inputs_);
    if (f.type == ForceType::joint_spring) force_reference_[k] = force_states_[k].length;
  }
}

void AbsoluteFormulation::add_wrench(int marker, bool through_point, const Vec3& force,
                                     const Vec3& torque, VecX& out) const noexcept {
  const MarkerData& m = markers_[marker];
  if (m.body < 0) return;
  const BodyData& b = body(m.body);
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

void AbsoluteFormulation::add_part_forces(const VecX& w, VecX& out) const noexcept {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 fa = Vec3::Zero(), ta = fa, fb = fa, tb = fa;
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const WrenchRow& g = rows_[i - part_rows_].gradient;
      fa += w[i] * g.Fa;
      ta += w[i] * g.Ta;
      fb += w[i] * g.Fb;
      tb += w[i] * g.Tb;
    }
    add_wrench(p.a, true, fa, ta, out);
    add_wrench(p.b, true, fb, tb, out);
  }
}

void AbsoluteFormulation::add_body_constraint_forces(const VecX& w, VecX& out) const noexcept {
  for (const BodyData& b : bodies_) {
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
}

void AbsoluteFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  out.setZero();
  add_body_constraint_forces(w, out);
  add_part_forces(w, out);
}

void AbsoluteFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  a_ = a;
  lambda_ = lambda;
  weights_ = lambda;
  weights_ += alpha * phi_;
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
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const WrenchRow& w = force_states_[k].wrench;
    if (f.a >= 0) add_wrench(f.a, false, -w.Fa, -w.Ta, out);
    add_wrench(f.b, false, -w.Fb, -w.Tb, out);
  }
  add_body_constraint_forces(weights_, out);
  add_part_forces(weights_, out);
}

void AbsoluteFormulation::constraint_rates(VecX& out) noexcept {
  for (const BodyData& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
      const Vec3 u_dot = b.Adot.col(pair_a[k]), v_dot = b.Adot.col(pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? u.dot(u_dot) : u.dot(v_dot) + v.dot(u_dot));
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = markers_[b.point_marker[p]];
      out.segment<3>(b.row + 6 + 3 * p) = m.v_P - m.s.v;
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    const MarkerState a = constraint_state(markers_[p.a]);
    const MarkerState b = constraint_state(markers_[p.b]);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const ConstraintRow& row = rows_[i - part_rows_];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(a.v) + g.Ta.dot(a.w) + g.Fb.dot(b.v) + g.Tb.dot(b.w) + row.phi_t;
    }
  }
}

void AbsoluteFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  const auto point = [&](const MarkerData& m) -> Vec3 {  // on the body
    const BodyData& b = body(m.body);
    Vec3 x = delta.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) x += m.p_B[c] * delta.segment<3>(b.offset + 3 + 3 * c);
    if (m.local) x.noalias() += m.Jr * delta.segment(b.offset + 12, b.nm);
    return x;
  };
  for (const BodyData& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 du = delta.segment<3>(b.offset + 3 + 3 * pair_a[k]);
      const Vec3 dv = delta.segment<3>(b.offset + 3 + 3 * pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? b.A.col(pair_a[k]).dot(du)
                                         : b.A.col(pair_a[k]).dot(dv) + b.A.col(pair_b[k]).dot(du));
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = markers_[b.point_marker[p]];
      out.segment<3>(b.row + 6 + 3 * p) = delta.segment<3>(b.offset + 12 + b.nm + 3 * p) - point(m);
    }
  }
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = markers_[marker];
    linear.setZero();
    angular.setZero();
    if (m.body < 0) return;
    const BodyData& b = body(m.body);
    linear = m.point >= 0 ? Vec3(delta.segment<3>(m.point)) : point(m);
    for (int c = 0; c < 3; ++c)
      angular += 0.5 * b.A.col(c).cross(delta.segment<3>(b.offset + 3 + 3 * c));
    if (m.rotates) angular.noalias() += m.Jw * delta.segment(b.offset + 12, b.nm);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 ra, wa, rb, wb;
    motion(p.a, ra, wa);
    motion(p.b, rb, wb);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const WrenchRow& g = rows_[i - part_rows_].gradient;
      out[i] = g.Fa.dot(ra) + g.Ta.dot(wa) + g.Fb.dot(rb) + g.Tb.dot(wb);
    }
  }
}

Vec3 AbsoluteFormulation::marker_acceleration(int index) const noexcept {
  const MarkerData& m = markers_[index];
  if (m.body < 0) return Vec3::Zero();
  const BodyData& b = body(m.body);
  Vec3 x = m.s.a_bias + a_.segment<3>(b.offset);
  for (int c = 0; c < 3; ++c) x += m.p_B[c] * a_.segment<3>(b.offset + 3 + 3 * c);
  if (m.local) x.noalias() += m.Jr * a_.segment(b.offset + 12, b.nm);
  return x;
}

void AbsoluteFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
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
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = markers_[marker];
    angular = m.s.alpha_bias;
    linear = m.point >= 0 ? Vec3(a.segment<3>(m.point)) : marker_acceleration(marker);
    if (m.body < 0) return;
    const BodyData& b = body(m.body);
    for (int c = 0; c < 3; ++c)
      angular += 0.5 * b.A.col(c).cross(a.segment<3>(b.offset + 3 + 3 * c));
    if (m.rotates) angular.noalias() += m.Jw * a.segment(b.offset + 12, b.nm);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 aa, wa, ab, wb;
    motion(p.a, aa, wa);
    motion(p.b, ab, wb);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const ConstraintRow& row = rows_[i - part_rows_];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(aa) + g.Ta.dot(wa) + g.Fb.dot(ab) + g.Tb.dot(wb) + row.quad + row.phi_tt;
    }
  }
}

}  // namespace floatframe

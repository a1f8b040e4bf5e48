// Residual and constraints: accelerations root to leaves, body terms, wrenches leaves to root.
#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

// dynamics

void RelativeFormulation::dynamics() noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.inertia.relative(b.r0, b.A, b.w, b.y.data(), b.yd.data(), b.M, b.Qv);
  }
  forces();
}

void RelativeFormulation::forces() noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const MarkerState& b = mark(f.b).s;
    const MarkerState& a = f.a >= 0 ? mark(f.a).s : b;
    if (force_tree_body_[k] >= 0) force_reference_[k] = body(force_tree_body_[k]).angle;
    evaluate_force(model_, f, a, b, origin_, time_, force_reference_[k], force_states_[k], inputs_);
    if (f.type == ForceType::joint_spring) force_reference_[k] = force_states_[k].length;
  }
}

void RelativeFormulation::add_wrench(int marker, const Vec3& force, const Vec3& torque) noexcept {
  const MarkerData& m = mark(marker);
  if (m.body < 0) return;
  BodyData& b = body(m.body);
  b.h.head<3>() += force;
  b.h.segment<3>(3) += m.s.r.cross(force) + torque;
  if (m.local) {
    b.h.tail(b.nm).noalias() += m.Jr.transpose() * force;
    if (m.rotates) b.h.tail(b.nm).noalias() += m.Jw.transpose() * torque;
  }
}

void RelativeFormulation::project(VecX& out) noexcept {
  for (std::size_t k = order_.size(); k-- > 0;) {
    BodyData& b = body(order_[k]);
    const Vec6 hz = b.h.head<6>();
    double* o = out.data() + b.iv;
    transposed_times(b.S.data(), b.psi ? b.nj + b.nm : b.nj, hz.data(), o);
    if (b.psi)
      for (int j = 0; j < b.nm; ++j) o[b.nj + j] += b.h[6 + j];
    else
      for (int j = 0; j < b.nm; ++j) o[b.nj + j] = b.h[6 + j];
    b.wrench = hz;
    if (b.parent >= 0) {
      BodyData& p = body(b.parent);
      p.h.head<6>() += hz;
      if (b.phi) add_transposed_times(b.Phi.data(), p.nm, hz.data(), p.h.data() + 6);
    }
  }
}

void RelativeFormulation::accelerations(const VecX& a) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.ydd = a.segment(b.iy, b.nm);
    Vec6 z = Vec6::Zero();
    if (b.parent >= 0) {
      const BodyData& p = body(b.parent);
      z = p.Zdot;
      if (b.phi) add_times(b.Phi.data(), p.nm, p.ydd.data(), z.data());
    }
    add_times(b.S.data(), b.psi ? b.nj + b.nm : b.nj, a.data() + b.iv, z.data());
    b.Zdot = z;  // without the bias D
  }
}

void RelativeFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  accelerations(a);
  for (const int i : order_) {
    BodyData& b = body(i);
    const Vec6 zdot = b.Zdot + b.D;
    const int n = 6 + b.nm;
    b.h = -b.Qv;
    add_product(b.M.data(), n, 6, zdot.data(), b.h.data());
    if (b.nm == 0) continue;
    add_product(b.M.data() + 6 * n, n, b.nm, b.ydd.data(), b.h.data());
    const FlexibleBody& data = *model_.bodies[i].data;
    add_product(data.K.data(), b.nm, b.nm, b.y.data(), b.h.data() + 6);
    if (b.damped) add_product(data.D.data(), b.nm, b.nm, b.yd.data(), b.h.data() + 6);
  }
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const WrenchRow& w = force_states_[k].wrench;
    if (f.a >= 0) add_wrench(f.a, -w.Fa, -w.Ta);
    add_wrench(f.b, -w.Fb, -w.Tb);
  }
  lambda_ = lambda;
  weights_ = lambda;
  weights_ += alpha * phi_;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    WrenchRow sum;
    sum_rows(k, weights_, sum);
    add_wrench(p.a, sum.Fa, sum.Ta);
    add_wrench(p.b, sum.Fb, sum.Tb);
  }
  project(out);
}

void RelativeFormulation::sum_rows(std::size_t part, const VecX& w, WrenchRow& sum) const noexcept {
  sum.Fa.setZero();
  sum.Ta.setZero();
  sum.Fb.setZero();
  sum.Tb.setZero();
  if (constraint_kind(parts_[part].type).gradients == PartGradients::unit) {
    sum.Fb = w.segment<3>(part_offset_[part]);
    sum.Fa = -sum.Fb;
    return;
  }
  for (int r = 0; r < parts_[part].rows(); ++r) {
    const int i = part_offset_[part] + r;
    const WrenchRow& g = rows_[i].gradient;
    sum.Fa += w[i] * g.Fa;
    sum.Ta += w[i] * g.Ta;
    sum.Fb += w[i] * g.Fb;
    sum.Tb += w[i] * g.Tb;
  }
}

void RelativeFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  for (BodyData& b : bodies_) b.h.setZero();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    WrenchRow sum;
    sum_rows(k, w, sum);
    add_wrench(p.a, sum.Fa, sum.Ta);
    add_wrench(p.b, sum.Fb, sum.Tb);
  }
  project(out);
}

void RelativeFormulation::constraint_rates(VecX& out) noexcept {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    const MarkerState& a = mark(p.a).s;
    const MarkerState& b = mark(p.b).s;
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const ConstraintRow& row = rows_[i];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(a.v) + g.Ta.dot(a.w) + g.Fb.dot(b.v) + g.Tb.dot(b.w) + row.phi_t;
    }
  }
}

void RelativeFormulation::spread(const VecX& x) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    Vec6 z = Vec6::Zero();
    if (b.parent >= 0) {
      const BodyData& p = body(b.parent);
      z = p.h.head<6>();
      if (b.phi) add_times(b.Phi.data(), p.nm, p.h.data() + 6, z.data());
    }
    add_times(b.S.data(), b.psi ? b.nj + b.nm : b.nj, x.data() + b.iv, z.data());
    b.h.head<6>() = z;
    b.h.tail(b.nm) = x.segment(b.iy, b.nm);
  }
}

void RelativeFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  spread(delta);
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = mark(marker);
    linear.setZero();
    angular.setZero();
    if (m.body < 0) return;
    const BodyData& b = body(m.body);
    angular = b.h.segment<3>(3);
    linear = b.h.head<3>() + angular.cross(m.s.r);
    if (m.local) {
      linear.noalias() += m.Jr * b.h.tail(b.nm);
      if (m.rotates) angular.noalias() += m.Jw * b.h.tail(b.nm);
    }
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 ra, wa, rb, wb;
    motion(p.a, ra, wa);
    motion(p.b, rb, wb);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const WrenchRow& g = rows_[i].gradient;
      out[i] = g.Fa.dot(ra) + g.Ta.dot(wa) + g.Fb.dot(rb) + g.Tb.dot(wb);
    }
  }
}

void RelativeFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
  accelerations(a);
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = mark(marker);
    linear = m.s.a_bias;
    angular = m.s.alpha_bias;
    if (m.body < 0) return;
    const BodyData& b = body(m.body);
    linear += b.Zdot.head<3>() + b.Zdot.tail<3>().cross(m.s.r);
    angular += b.Zdot.tail<3>();
    if (m.local) {
      linear.noalias() += m.Jr * b.ydd;
      if (m.rotates) angular.noalias() += m.Jw * b.ydd;
    }
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 aa, wa, ab, wb;
    motion(p.a, aa, wa);
    motion(p.b, ab, wb);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const ConstraintRow& row = rows_[i];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(aa) + g.Ta.dot(wa) + g.Fb.dot(ab) + g.Tb.dot(wb) + row.quad + row.phi_tt;
    }
  }
}

}  // namespace floatframe

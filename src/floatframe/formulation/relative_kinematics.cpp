// Positions, velocities and bias accelerations, root to leaves (theory section "Relative
// formulation").
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

// kinematics

void RelativeFormulation::marker_world_position(MarkerData& m) noexcept {
  const BodyData& b = body(m.body);
  m.s.r.noalias() = b.r0 + b.A * m.p_B;
  m.s.R.noalias() = b.A * m.R_B;
  if (m.local) m.world_gradients(b.A);
}

void RelativeFormulation::marker_world_velocity(MarkerData& m) noexcept {
  const BodyData& b = body(m.body);
  MarkerState& s = m.s;
  s.v = b.Z.head<3>() + b.w.cross(s.r);
  s.w = b.w;
  s.a_bias = b.D.head<3>() + b.D.tail<3>().cross(s.r) + b.w.cross(b.w.cross(s.r));
  s.alpha_bias = b.D.tail<3>();
  if (m.local) {
    const Vec3 chi = b.A * m.pdot_B;
    s.v += chi;
    s.a_bias += 2.0 * b.w.cross(chi) + b.A * m.pddot_B;
    if (m.rotates) {
      const Vec3 zeta = b.A * m.zeta_B;
      s.w += zeta;
      s.alpha_bias += b.w.cross(zeta) + b.A * m.zetadot_B;
    }
  }
}

void RelativeFormulation::positions(double t, const VecX& q) noexcept {
  time_ = t;
  for (const int i : order_) {
    BodyData& b = body(i);
    b.y = q.segment(b.iyq, b.nm);
  }
  {  // the origin of this evaluation: the first body's joint frame M
    BodyData& b = body(order_[0]);
    joint_motion(b.type, b.axes, q.data() + b.iq, b.motion);
    const Pose& X_WF = model_.markers[b.frame_F].X_NM;
    origin_ = X_WF.p + X_WF.R * b.motion.p_FM;
  }
  for (MarkerData& m : markers_)
    if (m.body < 0) {
      const Pose& X = model_.markers[&m - markers_.data()].X_NM;
      m.s.r = X.p - origin_;
      m.s.R = X.R;
      m.s.v.setZero();
      m.s.w.setZero();
      m.s.a_bias = -model_.gravity;
      m.s.alpha_bias.setZero();
    }
  for (const int i : order_) {
    BodyData& b = body(i);
    MarkerData& M = mark(b.frame_M);
    const MarkerData& F = mark(b.frame_F);
    joint_motion(b.type, b.axes, q.data() + b.iq, b.motion);
    if (b.nj == 1) b.angle = b.reversed ? -q[b.iq] : q[b.iq];
    if (M.local) M.deform(b.y);
    const Mat3 R_WM = F.s.R * b.motion.R_FM;
    const Vec3 r_M = F.s.r + F.s.R * b.motion.p_FM;
    b.A.noalias() = R_WM * M.R_B.transpose();
    b.r0.noalias() = r_M - b.A * M.p_B;
    marker_world_position(M);
    for (int k = 0; k < b.nj; ++k) {
      const Vec3 omega = F.s.R * b.motion.H.block<3, 1>(3, k);
      b.S.block<3, 1>(0, k) = F.s.R * b.motion.H.block<3, 1>(0, k) + r_M.cross(omega);
      b.S.block<3, 1>(3, k) = omega;
    }
    if (b.phi)
      for (int k = 0; k < b.nm_parent; ++k) {
        b.Phi.block<3, 1>(3, k) = F.Jw.col(k);
        b.Phi.block<3, 1>(0, k) = F.Jr.col(k) + F.s.r.cross(F.Jw.col(k));
      }
    if (b.psi)
      for (int k = 0; k < b.nm; ++k) {
        b.S.block<3, 1>(3, b.nj + k) = -M.Jw.col(k);
        b.S.block<3, 1>(0, b.nj + k) = M.Jw.col(k).cross(r_M) - M.Jr.col(k);
      }
    const UsedMarkers& used = used_markers_[i];
    for (const int u : stepping_ ? used.dynamic : used.all) {
      MarkerData& m = mark(u);
      if (m.local) m.deform(b.y);
      marker_world_position(m);
    }
  }
  // The joint's bias needs velocities: `velocities` evaluates it from the H kept in b.motion.
}

void RelativeFormulation::velocities(const VecX& v) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.yd = v.segment(b.iy, b.nm);
    MarkerData& M = mark(b.frame_M);
    const MarkerData& F = mark(b.frame_F);
    joint_bias(b.type, v.data() + b.iv, b.motion);
    // Marker M of the child through the joint.
    const Vec3 rho = F.s.R * b.motion.p_FM;
    Vec3 nu = Vec3::Zero(), eta = Vec3::Zero();
    for (int k = 0; k < b.nj; ++k) {
      nu += b.motion.H.block<3, 1>(0, k) * v[b.iv + k];
      eta += b.motion.H.block<3, 1>(3, k) * v[b.iv + k];
    }
    nu = F.s.R * nu;
    eta = F.s.R * eta;
    const Vec3 r_M = F.s.r + rho;
    const Vec3 w_M = F.s.w + eta;
    const Vec3 v_M = F.s.v + F.s.w.cross(rho) + nu;
    const Vec3 alpha_M = F.s.alpha_bias + F.s.w.cross(eta) + F.s.R * b.motion.bias.tail<3>();
    const Vec3 a_M = F.s.a_bias + F.s.alpha_bias.cross(rho) + F.s.w.cross(F.s.w.cross(rho)) +
                     2.0 * F.s.w.cross(nu) + F.s.R * b.motion.bias.head<3>();
    // The body frame seen from M, which may move with the body's own modes.
    Vec3 chi = Vec3::Zero(), chi_dot = Vec3::Zero(), zeta = Vec3::Zero(), zeta_dot = Vec3::Zero();
    if (M.local) {
      M.deform_rate(b.yd);
      chi = b.A * M.pdot_B;
      chi_dot = b.A * M.pddot_B;
      zeta = b.A * M.zeta_B;
      zeta_dot = b.A * M.zetadot_B;
    }
    b.w = w_M - zeta;
    const Vec3 alpha = alpha_M - b.w.cross(zeta) - zeta_dot;
    b.Z.head<3>() = v_M - b.w.cross(r_M) - chi;
    b.Z.tail<3>() = b.w;
    b.D.head<3>() =
        a_M - alpha.cross(r_M) - b.w.cross(b.w.cross(r_M)) - 2.0 * b.w.cross(chi) - chi_dot;
    b.D.tail<3>() = alpha;
    marker_world_velocity(M);
    const UsedMarkers& used = used_markers_[i];
    for (const int u : stepping_ ? used.dynamic : used.all) {
      MarkerData& m = mark(u);
      if (m.local) m.deform_rate(b.yd);
      marker_world_velocity(m);
    }
  }
  evaluate_constraints();
}

void RelativeFormulation::evaluate_constraints() noexcept {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    const int offset = part_offset_[k];
    evaluate_constraint(p, mark(p.a).s, mark(p.b).s, time_, rows_.data() + offset);
    for (int r = 0; r < p.rows(); ++r) phi_[offset + r] = rows_[offset + r].phi;
  }
}

void RelativeFormulation::retract(const VecX& q0, const VecX& x, VecX& q) const noexcept {
  for (const BodyData& b : bodies_) {
    joint_retract(b.type, q0.data() + b.iq, x.data() + b.iv, q.data() + b.iq);
    q.segment(b.iyq, b.nm) = q0.segment(b.iyq, b.nm) + x.segment(b.iy, b.nm);
  }
}

void RelativeFormulation::advance(VecX& x, const VecX& delta) const noexcept {
  for (const BodyData& b : bodies_) {
    joint_advance(b.type, x.data() + b.iv, delta.data() + b.iv);
    x.segment(b.iy, b.nm) += delta.segment(b.iy, b.nm);
  }
}

}  // namespace floatframe

// Positions, velocities and accelerations outwards, wrenches inwards. The formulas are in the
// header.
#include "floatframe/formulation/tree_kinematics.hpp"

#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/small_products.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

void TreeKinematics::marker_position(TreeMarker& m) const noexcept {
  const TreeBody& b = bodies_[m.body];
  m.s.r.noalias() = b.p_OB + b.R_WB * m.p_B;
  m.s.R.noalias() = b.R_WB * m.R_B;
  if (m.local) m.world_gradients(b.R_WB);
}

void TreeKinematics::marker_velocity(TreeMarker& m) const noexcept {
  const TreeBody& b = bodies_[m.body];
  MarkerState& s = m.s;
  s.v = b.Z.head<3>() + b.w_WB.cross(s.r);
  s.w = b.w_WB;
  s.a_bias = b.Zdot_0.head<3>() + b.Zdot_0.tail<3>().cross(s.r) + b.w_WB.cross(b.w_WB.cross(s.r));
  s.alpha_bias = b.Zdot_0.tail<3>();
  if (m.local) {
    const Vec3 chi = b.R_WB * m.pdot_B;
    s.v += chi;
    s.a_bias += 2.0 * b.w_WB.cross(chi) + b.R_WB * m.pddot_B;
    if (m.rotates) {
      const Vec3 zeta = b.R_WB * m.zeta_B;
      s.w += zeta;
      s.alpha_bias += b.w_WB.cross(zeta) + b.R_WB * m.zetadot_B;
    }
  }
}

/// The origin of this evaluation: the first body's joint frame M.
void TreeKinematics::choose_origin(const VecX& q) noexcept {
  assert(!order_.empty());
  TreeBody& b = bodies_[order_[0]];
  joint_motion(b.type, b.axes, q.data() + b.iq, b.motion);
  const Pose& X_WF = model_.markers[b.frame_F].X_NM;
  p_WO_ = X_WF.p + X_WF.R * b.motion.p_FM;
}

void TreeKinematics::place_ground_markers() noexcept {
  for (TreeMarker& m : markers_)
    if (m.body < 0) {
      const Pose& X_WM = model_.markers[&m - markers_.data()].X_NM;
      m.s.r = X_WM.p - p_WO_;
      m.s.R = X_WM.R;
      m.s.v.setZero();
      m.s.w.setZero();
      m.s.a_bias = -model_.gravity;
      m.s.alpha_bias.setZero();
    }
}

template <bool stiffens>
void TreeKinematics::place_body(TreeBody& b) noexcept {
  const TreeMarker& F = markers_[b.frame_F];
  TreeMarker& child = markers_[b.frame_M];
  if (child.local) child.deform<stiffens>(b.y);
  const Mat3 R_WM = F.s.R * b.motion.R_FM;
  const Vec3 p_OM = F.s.r + F.s.R * b.motion.p_FM;
  b.R_WB.noalias() = R_WM * child.R_B.transpose();
  b.p_OB.noalias() = p_OM - b.R_WB * child.p_B;
  assert(is_rotation(b.R_WB));
  marker_position(child);
  for (int k = 0; k < b.nj; ++k) {
    const Vec3 eta = F.s.R * b.motion.H.block<3, 1>(3, k);
    b.own.block<3, 1>(0, k) = F.s.R * b.motion.H.block<3, 1>(0, k) + p_OM.cross(eta);
    b.own.block<3, 1>(3, k) = eta;
  }
  if (b.parent_moves_F)
    for (int k = 0; k < b.nm_parent; ++k) {
      b.of_parent.block<3, 1>(3, k) = F.Jw.col(k);
      b.of_parent.block<3, 1>(0, k) = F.Jr.col(k) + F.s.r.cross(F.Jw.col(k));
    }
  if (b.moves_M)
    for (int k = 0; k < b.nm; ++k) {
      b.own.block<3, 1>(3, b.nj + k) = -child.Jw.col(k);
      b.own.block<3, 1>(0, b.nj + k) = child.Jw.col(k).cross(p_OM) - child.Jr.col(k);
    }
}

template <bool stiffens>
void TreeKinematics::positions_of(const VecX& q) noexcept {
  FLOATFRAME_DEBUG(for (TreeMarker& m : markers_) poison_state(m.s);)
  for (const int i : order_) {
    TreeBody& b = bodies_[i];
    b.y = q.segment(b.iyq, b.nm);
    FLOATFRAME_DEBUG(poison(b.w_WB));
    FLOATFRAME_DEBUG(poison(b.Z));
    FLOATFRAME_DEBUG(poison(b.Zdot_0));
    FLOATFRAME_DEBUG(poison(b.Zdot));
    FLOATFRAME_DEBUG(poison(b.yd));
    FLOATFRAME_DEBUG(poison(b.ydd));
  }
  choose_origin(q);
  place_ground_markers();
  for (const int i : order_) {
    TreeBody& b = bodies_[i];
    joint_motion(b.type, b.axes, q.data() + b.iq, b.motion);
    place_body<stiffens>(b);
    const UsedMarkers& used = used_markers_[i];
    for (const int u : stepping_ ? used.dynamic : used.all) {
      TreeMarker& m = markers_[u];
      if (m.local) m.deform<stiffens>(b.y);
      marker_position(m);
    }
  }
  for (const int k : sliding_) {
    TreeMarker& m = markers_[k];
    const TreeBody& b = bodies_[m.body];
    m.slide(b.R_WB.transpose() * (markers_[m.guide].s.r - b.p_OB), b.y);
    marker_position(m);
  }
  // The joint's bias needs velocities: `velocities` evaluates it from the H stored in b.motion.
}

template <bool stiffens>
void TreeKinematics::find_twist(TreeBody& b, const VecX& v) noexcept {
  TreeMarker& child = markers_[b.frame_M];
  const TreeMarker& F = markers_[b.frame_F];
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
  const Vec3 p_OM = F.s.r + rho;
  const Vec3 w_WM = F.s.w + eta;
  const Vec3 v_M = F.s.v + F.s.w.cross(rho) + nu;
  const Vec3 alpha_M = F.s.alpha_bias + F.s.w.cross(eta) + F.s.R * b.motion.bias.tail<3>();
  const Vec3 a_M = F.s.a_bias + F.s.alpha_bias.cross(rho) + F.s.w.cross(F.s.w.cross(rho)) +
                   2.0 * F.s.w.cross(nu) + F.s.R * b.motion.bias.head<3>();
  // The body frame relative to M, which may move with the body's modes.
  Vec3 chi = Vec3::Zero(), chi_dot = Vec3::Zero(), zeta = Vec3::Zero(), zeta_dot = Vec3::Zero();
  if (child.local) {
    child.deform_rate<stiffens>(b.yd);
    chi = b.R_WB * child.pdot_B;
    chi_dot = b.R_WB * child.pddot_B;
    zeta = b.R_WB * child.zeta_B;
    zeta_dot = b.R_WB * child.zetadot_B;
  }
  b.w_WB = w_WM - zeta;
  const Vec3 alpha = alpha_M - b.w_WB.cross(zeta) - zeta_dot;
  b.Z.head<3>() = v_M - b.w_WB.cross(p_OM) - chi;
  b.Z.tail<3>() = b.w_WB;
  b.Zdot_0.head<3>() = a_M - alpha.cross(p_OM) - b.w_WB.cross(b.w_WB.cross(p_OM)) -
                       2.0 * b.w_WB.cross(chi) - chi_dot;
  b.Zdot_0.tail<3>() = alpha;
  marker_velocity(child);
}

template <bool stiffens>
void TreeKinematics::velocities_of(const VecX& v) noexcept {
  for (const int i : order_) {
    TreeBody& b = bodies_[i];
    b.yd = v.segment(b.iy, b.nm);
    find_twist<stiffens>(b, v);
    const UsedMarkers& used = used_markers_[i];
    for (const int u : stepping_ ? used.dynamic : used.all) {
      TreeMarker& m = markers_[u];
      if (m.local) m.deform_rate<stiffens>(b.yd);
      marker_velocity(m);
    }
  }
}

template void TreeKinematics::positions_of<false>(const VecX& q) noexcept;
template void TreeKinematics::positions_of<true>(const VecX& q) noexcept;
template void TreeKinematics::velocities_of<false>(const VecX& v) noexcept;
template void TreeKinematics::velocities_of<true>(const VecX& v) noexcept;

void TreeKinematics::accelerations(const VecX& a) noexcept {
  assert(a.size() == nv_);
  for (const int i : order_) {
    TreeBody& b = bodies_[i];
    b.ydd = a.segment(b.iy, b.nm);
    Vec6 z = Vec6::Zero();
    if (b.parent >= 0) {
      const TreeBody& p = bodies_[b.parent];
      z = p.Zdot;
      if (b.parent_moves_F) add_times(b.of_parent.data(), p.nm, p.ydd.data(), z.data());
    }
    add_times(b.own.data(), b.moving(), a.data() + b.iv, z.data());
    b.Zdot = z;
  }
}

void TreeKinematics::retract(const VecX& q0, const VecX& x, VecX& q) const noexcept {
  assert(q0.size() == nq_ && x.size() == nv_ && q.size() == nq_);
  assert(&q != &q0);
  FLOATFRAME_DEBUG(poison(q));
  for (const TreeBody& b : bodies_) {
    joint_retract(b.type, q0.data() + b.iq, x.data() + b.iv, q.data() + b.iq);
    q.segment(b.iyq, b.nm) = q0.segment(b.iyq, b.nm) + x.segment(b.iy, b.nm);
  }
}

bool TreeKinematics::has_rotations(const VecX& q) const noexcept {
  assert(q.size() == nq_);
  for (const TreeBody& b : bodies_) {
    const int rotation = joint_kind(b.type).rotation_vector;
    if (rotation >= 0 && !is_unit(Eigen::Vector4d(q.segment<4>(b.iq + rotation)))) return false;
  }
  return true;
}

void TreeKinematics::advance(VecX& x, const VecX& delta) const noexcept {
  assert(x.size() == nv_ && delta.size() == nv_);
  for (const TreeBody& b : bodies_) {
    joint_advance(b.type, x.data() + b.iv, delta.data() + b.iv);
    x.segment(b.iy, b.nm) += delta.segment(b.iy, b.nm);
  }
}

void TreeKinematics::spread(const VecX& x, BodyVectors& increments) const noexcept {
  assert(x.size() == nv_ && increments.size() == bodies_.size());
  for (const int i : order_) {
    const TreeBody& b = bodies_[i];
    VecX& own = increments[i];
    Vec6 z = Vec6::Zero();
    if (b.parent >= 0) {
      const VecX& up = increments[b.parent];
      z = up.head<6>();
      if (b.parent_moves_F) add_times(b.of_parent.data(), b.nm_parent, up.data() + 6, z.data());
    }
    add_times(b.own.data(), b.moving(), x.data() + b.iv, z.data());
    own.head<6>() = z;
    own.tail(b.nm) = x.segment(b.iy, b.nm);
  }
}

void TreeKinematics::project(BodyVectors& wrenches, VecX& out) const noexcept {
  assert(wrenches.size() == bodies_.size() && out.size() == nv_);
  FLOATFRAME_DEBUG(poison(out));
  for (std::size_t k = order_.size(); k-- > 0;) {
    const TreeBody& b = bodies_[order_[k]];
    const VecX& h = wrenches[order_[k]];
    const Vec6 hz = h.head<6>();
    double* o = out.data() + b.iv;
    transposed_times(b.own.data(), b.moving(), hz.data(), o);
    if (b.moves_M)
      for (int j = 0; j < b.nm; ++j) o[b.nj + j] += h[6 + j];
    else
      for (int j = 0; j < b.nm; ++j) o[b.nj + j] = h[6 + j];
    if (b.parent >= 0) {
      VecX& up = wrenches[b.parent];
      up.head<6>() += hz;
      if (b.parent_moves_F)
        add_transposed_times(b.of_parent.data(), b.nm_parent, hz.data(), up.data() + 6);
    }
  }
}

void TreeKinematics::add_wrench(int marker, const Vec3& force, const Vec3& torque,
                                BodyVectors& wrenches) const noexcept {
  assert(marker >= 0 && wrenches.size() == bodies_.size());
  const TreeMarker& m = markers_[marker];
  if (m.body < 0) return;
  VecX& h = wrenches[m.body];
  h.head<3>() += force;
  h.segment<3>(3) += m.s.r.cross(force) + torque;
  if (m.local) {
    const int nm = bodies_[m.body].nm;
    h.tail(nm).noalias() += m.Jr.transpose() * force;
    if (m.rotates) h.tail(nm).noalias() += m.Jw.transpose() * torque;
  }
}

PointMotion TreeKinematics::increment_of(int marker, const BodyVectors& increments) const noexcept {
  assert(marker >= 0 && increments.size() == bodies_.size());
  const TreeMarker& m = markers_[marker];
  PointMotion x{Vec3::Zero(), Vec3::Zero()};
  if (m.body < 0) return x;
  const VecX& z = increments[m.body];
  x.angular = z.segment<3>(3);
  x.linear = z.head<3>() + x.angular.cross(m.s.r);
  if (m.local) {
    const int nm = bodies_[m.body].nm;
    x.linear.noalias() += m.Jr * z.tail(nm);
    if (m.rotates) x.angular.noalias() += m.Jw * z.tail(nm);
  }
  return x;
}

PointMotion TreeKinematics::acceleration_of(int marker) const noexcept {
  PointMotion x{markers_[marker].s.a_bias, markers_[marker].s.alpha_bias};
  add_acceleration(marker, x);
  return x;
}

PointMotion TreeKinematics::acceleration_in_world(int marker) const noexcept {
  PointMotion x{markers_[marker].s.a_bias + model_.gravity, markers_[marker].s.alpha_bias};
  add_acceleration(marker, x);
  return x;
}

/// Contribution of coordinate accelerations, added to the bias of a marker.
void TreeKinematics::add_acceleration(int marker, PointMotion& x) const noexcept {
  assert(is_index(marker, markers_));
  const TreeMarker& m = markers_[marker];
  if (m.body < 0) return;
  const TreeBody& b = bodies_[m.body];
  x.linear += b.Zdot.head<3>() + b.Zdot.tail<3>().cross(m.s.r);
  x.angular += b.Zdot.tail<3>();
  if (m.local) {
    x.linear.noalias() += m.Jr * b.ydd;
    if (m.rotates) x.angular.noalias() += m.Jw * b.ydd;
  }
}

}  // namespace floatframe

#include "floatframe/formulation/absolute_kinematics.hpp"

#include "floatframe/core/debug_only.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

namespace {

/// The rotation nearest to A (Newton-Schulz), or `otherwise` if there is none.
Mat3 orthonormal(Mat3 A, const Mat3& otherwise) noexcept {
  // Singular values below sqrt(3) converge; none exceeds sqrt(3) times their quadratic mean.
  const double mean = A.norm() / std::sqrt(3.0);
  if (std::abs(mean - 1.0) > 0.1) A /= 1.001 * mean;
  constexpr int most = 30;
  for (int pass = 0; pass < most; ++pass) {
    const Mat3 error = A.transpose() * A - Mat3::Identity();
    A -= (0.5 * A * error).eval();
    if (error.cwiseAbs().maxCoeff() < 1e-8)  // squared by this pass
      return A.determinant() > 0.0 ? A : otherwise;
  }
  return otherwise;
}

}  // namespace

AbsoluteKinematics::AbsoluteKinematics(const Model& model, ConstraintSet& constraints)
    : model_(model), bodies_(model.bodies.size()) {
  for (const Marker& m : model_.markers) {
    AbsoluteMarker d;
    static_cast<LocalMarker&>(d) = LocalMarker(model_, m);
    d.outer.a_bias.setZero();
    if (d.slides) {
      d.s.foot = &d.slides->foot;
      sliding_.push_back(std::ssize(markers_));
    }
    markers_.push_back(std::move(d));
  }
  place_outer_points(constraints);
  int rows = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    AbsoluteBody& b = bodies_[i];
    const Body& m = model_.bodies[i];
    b.nm = m.modes();
    b.points = static_cast<int>(b.point_marker.size());
    b.length = m.length;
    b.offset = size_;
    size_ += b.size();
    b.row = rows;
    rows += b.rows();
    b.y = b.yd = VecX::Zero(b.nm);
    stiffens_ = stiffens_ || m.stiffens();
  }
  for (AbsoluteMarker& m : markers_)
    if (m.point >= 0) m.point = bodies_[m.body].point(m.point);
  constraints.number_rows(rows);
  a_ = VecX::Zero(size_);
}

/// Outer points: where a constraint uses the position of a deforming node. Joints at one node share
/// the point. `AbsoluteMarker::point` is its number on the body.
void AbsoluteKinematics::place_outer_points(const ConstraintSet& constraints) {
  for (const ConstraintPart& p : constraints.parts()) {
    if (!constraint_kind(p.type).points) continue;
    for (const int marker : {p.a, p.b}) {
      AbsoluteMarker& m = markers_[marker];
      if (m.body < 0 || !m.local || m.slides || m.point >= 0) continue;
      AbsoluteBody& b = bodies_[m.body];
      int local = -1;
      for (std::size_t k = 0; k < b.point_marker.size(); ++k) {
        const AbsoluteMarker& other = markers_[b.point_marker[k]];
        if ((other.node_p - m.node_p).isZero(0.0) && (other.X - m.X).isZero(0.0) &&
            other.X_NM.p.isZero(0.0) && m.X_NM.p.isZero(0.0))
          local = static_cast<int>(k);
      }
      if (local < 0) {
        local = static_cast<int>(b.point_marker.size());
        b.point_marker.push_back(marker);
      }
      m.point = local;
    }
  }
}

std::string AbsoluteKinematics::coordinate_owner(int i) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const AbsoluteBody& b = bodies_[k];
    if (i < b.offset || i >= b.offset + b.size()) continue;
    const int j = i - b.offset;
    const std::string name = "body '" + model_.bodies[k].name + "'";
    if (j < 12) return name;
    if (j < 12 + b.nm) return "mode " + std::to_string(j - 11) + " of " + name;
    return "outer point " + std::to_string((j - 12 - b.nm) / 3 + 1) + " of " + name;
  }
  return "coordinate " + std::to_string(i);
}

void AbsoluteKinematics::positions(const VecX& q) noexcept {
  assert(q.size() == size_);
  FLOATFRAME_DEBUG(poison(a_));
  stiffens_ ? positions_of<true>(q) : positions_of<false>(q);
}

template <bool stiffens>
void AbsoluteKinematics::positions_of(const VecX& q) noexcept {
  for (AbsoluteBody& b : bodies_) {
    b.p_WB = q.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.A.col(c) = q.segment<3>(b.axis(c));
    b.y = q.segment(b.offset + 12, b.nm);
    FLOATFRAME_DEBUG(poison(b.v_WB));
    FLOATFRAME_DEBUG(poison(b.Adot));
    FLOATFRAME_DEBUG(poison(b.w_WB));
    FLOATFRAME_DEBUG(poison(b.yd));
  }
  for (AbsoluteMarker& m : markers_) {
    FLOATFRAME_DEBUG(poison_rates(m.s));
    FLOATFRAME_DEBUG(poison(m.outer.v));
    if (m.body < 0) {
      m.s.r = m.X_NM.p;
      m.s.R = m.X_NM.R;
      continue;
    }
    const AbsoluteBody& b = bodies_[m.body];
    if (m.local) {
      m.deform<stiffens>(b.y);
      m.world_gradients(b.A);
    }
    m.s.r.noalias() = b.p_WB + b.A * m.p_B;
    m.s.R.noalias() = b.A * m.R_B;
    if (m.point < 0) continue;
    m.outer.r = q.segment<3>(m.point);
    m.outer.R = m.s.R;
  }
  for (const int k : sliding_) {
    AbsoluteMarker& m = markers_[k];
    const AbsoluteBody& b = bodies_[m.body];
    m.slide(b.A.transpose() * (constraint_state(m.guide).r - b.p_WB), b.y);
    m.world_gradients(b.A);
    m.s.r.noalias() = b.p_WB + b.A * m.p_B;
  }
}

void AbsoluteKinematics::velocities(const VecX& v, VecX& phi) noexcept {
  assert(v.size() == size_);
  stiffens_ ? velocities_of<true>(v, phi) : velocities_of<false>(v, phi);
}

template <bool stiffens>
void AbsoluteKinematics::velocities_of(const VecX& v, VecX& phi) noexcept {
  for (AbsoluteBody& b : bodies_) {
    b.v_WB = v.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.Adot.col(c) = v.segment<3>(b.axis(c));
    b.yd = v.segment(b.offset + 12, b.nm);
    b.w_WB.setZero();
    for (int c = 0; c < 3; ++c) b.w_WB += 0.5 * b.A.col(c).cross(b.Adot.col(c));
    for (int k = 0; k < 6; ++k) {
      const double dot = b.A.col(b.pair_a[k]).dot(b.A.col(b.pair_b[k]));
      phi[b.row + k] = b.length * (k < 3 ? 0.5 * (dot - 1.0) : dot);
    }
    for (int p = 0; p < b.points; ++p) {
      const AbsoluteMarker& m = point(b, p);
      phi.segment<3>(b.point_row(p)) = m.outer.r - m.s.r;
    }
  }
  for (AbsoluteMarker& m : markers_) {
    MarkerState& s = m.s;
    s.v.setZero();
    s.w.setZero();
    s.a_bias.setZero();
    s.alpha_bias.setZero();
    if (m.body < 0) continue;
    const AbsoluteBody& b = bodies_[m.body];
    s.v.noalias() = b.v_WB + b.Adot * m.p_B;
    s.w = b.w_WB;
    if (m.local) {
      m.deform_rate<stiffens>(b.yd);
      s.v.noalias() += b.A * m.pdot_B;
      s.a_bias.noalias() = 2.0 * (b.Adot * m.pdot_B);
      s.a_bias.noalias() += b.A * m.pddot_B;
      if (m.rotates) {
        s.w.noalias() += b.A * m.zeta_B;
        s.alpha_bias.noalias() = b.Adot * m.zeta_B;
        s.alpha_bias.noalias() += b.A * m.zetadot_B;
      }
    }
    if (m.point < 0) continue;
    m.outer.v = v.segment<3>(m.point);
    m.outer.w = s.w;
    m.outer.alpha_bias = s.alpha_bias;
  }
}

void AbsoluteKinematics::settle(const VecX& q0, VecX& x) const noexcept {
  assert(q0.size() == size_ && x.size() == size_);
  stiffens_ ? settle_of<true>(q0, x) : settle_of<false>(q0, x);
}

template <bool stiffens>
void AbsoluteKinematics::settle_of(const VecX& q0, VecX& x) const noexcept {
  for (const AbsoluteBody& b : bodies_) {
    Mat3 A, A0;
    for (int c = 0; c < 3; ++c) {
      A0.col(c) = q0.segment<3>(b.axis(c));
      A.col(c) = A0.col(c) + x.segment<3>(b.axis(c));
    }
    A = orthonormal(A, A0);
    assert(is_rotation(A));  // of a state: A0 is one
    for (int c = 0; c < 3; ++c) x.segment<3>(b.axis(c)) = A.col(c) - q0.segment<3>(b.axis(c));
    const Vec3 origin = q0.segment<3>(b.offset) + x.segment<3>(b.offset);
    const double *y = q0.data() + b.offset + 12, *dy = x.data() + b.offset + 12;
    for (int p = 0; p < b.points; ++p)
      x.segment<3>(b.point(p)) =
          origin + A * point(b, p).position<stiffens>(y, dy) - q0.segment<3>(b.point(p));
  }
}

bool AbsoluteKinematics::has_rotations(const VecX& q) const noexcept {
  assert(q.size() == size_);
  for (const AbsoluteBody& b : bodies_) {
    Mat3 A;
    for (int c = 0; c < 3; ++c) A.col(c) = q.segment<3>(b.axis(c));
    if (!is_rotation(A)) return false;
  }
  return true;
}

void AbsoluteKinematics::advance(VecX& x, const VecX& delta) const noexcept {
  assert(x.size() == size_ && delta.size() == size_);
  stiffens_ ? advance_of<true>(x, delta) : advance_of<false>(x, delta);
}

template <bool stiffens>
void AbsoluteKinematics::advance_of(VecX& x, const VecX& delta) const noexcept {
  for (const AbsoluteBody& b : bodies_) {
    Vec3 theta = Vec3::Zero();  // of the rotation: a stretch has none
    for (int c = 0; c < 3; ++c) theta += 0.5 * b.A.col(c).cross(delta.segment<3>(b.axis(c)));
    const Mat3 turned = rotation_exp(theta) * b.A;
    const Mat3 A = orthonormal(turned, turned);
    x.segment<3>(b.offset) += delta.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) x.segment<3>(b.axis(c)) += A.col(c) - b.A.col(c);
    x.segment(b.offset + 12, b.nm) += delta.segment(b.offset + 12, b.nm);
    const Vec3 origin = b.p_WB + delta.segment<3>(b.offset);
    const double* dy = delta.data() + b.offset + 12;
    for (int p = 0; p < b.points; ++p) {
      const AbsoluteMarker& m = point(b, p);
      x.segment<3>(b.point(p)) += origin + A * m.position<stiffens>(b.y.data(), dy) - m.outer.r;
    }
  }
}

void AbsoluteKinematics::own_rates(VecX& out) const noexcept {
  for (const AbsoluteBody& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 u = b.A.col(b.pair_a[k]), v = b.A.col(b.pair_b[k]);
      const Vec3 u_dot = b.Adot.col(b.pair_a[k]), v_dot = b.Adot.col(b.pair_b[k]);
      out[b.row + k] = b.length * (k < 3 ? u.dot(u_dot) : u.dot(v_dot) + v.dot(u_dot));
    }
    for (int p = 0; p < b.points; ++p) {
      const AbsoluteMarker& m = point(b, p);
      out.segment<3>(b.point_row(p)) = m.outer.v - m.s.v;
    }
  }
}

void AbsoluteKinematics::own_increments(const VecX& delta, VecX& out) const noexcept {
  for (const AbsoluteBody& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 du = delta.segment<3>(b.axis(b.pair_a[k]));
      const Vec3 dv = delta.segment<3>(b.axis(b.pair_b[k]));
      out[b.row + k] =
          b.length * (k < 3 ? b.A.col(b.pair_a[k]).dot(du)
                            : b.A.col(b.pair_a[k]).dot(dv) + b.A.col(b.pair_b[k]).dot(du));
    }
    for (int p = 0; p < b.points; ++p)
      out.segment<3>(b.point_row(p)) =
          delta.segment<3>(b.point(p)) - point_increment(point(b, p), delta);
  }
}

void AbsoluteKinematics::own_accelerations(VecX& out) const noexcept {
  for (const AbsoluteBody& b : bodies_) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 u = b.A.col(b.pair_a[k]), v = b.A.col(b.pair_b[k]);
      const Vec3 u_dot = b.Adot.col(b.pair_a[k]), v_dot = b.Adot.col(b.pair_b[k]);
      const Vec3 u_ddot = a_.segment<3>(b.axis(b.pair_a[k]));
      const Vec3 v_ddot = a_.segment<3>(b.axis(b.pair_b[k]));
      out[b.row + k] = b.length * (k < 3 ? u.dot(u_ddot) + u_dot.squaredNorm()
                                         : u.dot(v_ddot) + v.dot(u_ddot) + 2.0 * u_dot.dot(v_dot));
    }
    for (int p = 0; p < b.points; ++p)
      out.segment<3>(b.point_row(p)) =
          a_.segment<3>(b.point(p)) - point_acceleration(b.point_marker[p]);
  }
}

void AbsoluteKinematics::add_own_forces(const AbsoluteBody& b, const VecX& w,
                                        VecX& out) const noexcept {
  for (int k = 0; k < 6; ++k) {
    const double x = b.length * w[b.row + k];
    out.segment<3>(b.axis(b.pair_a[k])) += x * b.A.col(b.pair_b[k]);
    if (k >= 3) out.segment<3>(b.axis(b.pair_b[k])) += x * b.A.col(b.pair_a[k]);
  }
  for (int p = 0; p < b.points; ++p) {
    const Vec3 x = w.segment<3>(b.point_row(p));
    add_wrench(b.point_marker[p], false, -x, Vec3::Zero(), out);
    out.segment<3>(b.point(p)) += x;
  }
}

/// Of the material point of a marker on its body.
Vec3 AbsoluteKinematics::point_increment(const AbsoluteMarker& m,
                                         const VecX& delta) const noexcept {
  const AbsoluteBody& b = bodies_[m.body];
  Vec3 x = delta.segment<3>(b.offset);
  for (int c = 0; c < 3; ++c) x += m.p_B[c] * delta.segment<3>(b.axis(c));
  if (m.local) x.noalias() += m.Jr * delta.segment(b.offset + 12, b.nm);
  return x;
}

PointMotion AbsoluteKinematics::increment_of(int marker, const VecX& delta) const noexcept {
  const AbsoluteMarker& m = markers_[marker];
  PointMotion x{Vec3::Zero(), Vec3::Zero()};
  if (m.body < 0) return x;
  const AbsoluteBody& b = bodies_[m.body];
  x.linear = m.point >= 0 ? Vec3(delta.segment<3>(m.point)) : point_increment(m, delta);
  for (int c = 0; c < 3; ++c) x.angular += 0.5 * b.A.col(c).cross(delta.segment<3>(b.axis(c)));
  if (m.rotates) x.angular.noalias() += m.Jw * delta.segment(b.offset + 12, b.nm);
  return x;
}

Vec3 AbsoluteKinematics::point_acceleration(int marker) const noexcept {
  assert(is_index(marker, markers_));
  const AbsoluteMarker& m = markers_[marker];
  if (m.body < 0) return Vec3::Zero();
  const AbsoluteBody& b = bodies_[m.body];
  Vec3 x = m.s.a_bias + a_.segment<3>(b.offset);
  for (int c = 0; c < 3; ++c) x += m.p_B[c] * a_.segment<3>(b.axis(c));
  if (m.local) x.noalias() += m.Jr * a_.segment(b.offset + 12, b.nm);
  return x;
}

PointMotion AbsoluteKinematics::acceleration_of(int marker) const noexcept {
  const AbsoluteMarker& m = markers_[marker];
  PointMotion x;
  x.angular = m.s.alpha_bias;
  x.linear = m.point >= 0 ? Vec3(a_.segment<3>(m.point)) : point_acceleration(marker);
  if (m.body < 0) return x;
  const AbsoluteBody& b = bodies_[m.body];
  for (int c = 0; c < 3; ++c) x.angular += 0.5 * b.A.col(c).cross(a_.segment<3>(b.axis(c)));
  if (m.rotates) x.angular.noalias() += m.Jw * a_.segment(b.offset + 12, b.nm);
  return x;
}

void AbsoluteKinematics::add_wrench(int marker, bool through_point, const Vec3& force,
                                    const Vec3& torque, VecX& out) const noexcept {
  assert(is_index(marker, markers_) && out.size() == size_);
  const AbsoluteMarker& m = markers_[marker];
  if (m.body < 0) return;
  const AbsoluteBody& b = bodies_[m.body];
  if (through_point && m.point >= 0) {
    out.segment<3>(m.point) += force;
  } else {
    out.segment<3>(b.offset) += force;
    for (int c = 0; c < 3; ++c) out.segment<3>(b.axis(c)) += m.p_B[c] * force;
    if (m.local) out.segment(b.offset + 12, b.nm).noalias() += m.Jr.transpose() * force;
  }
  if (torque.isZero(0.0)) return;
  for (int c = 0; c < 3; ++c) out.segment<3>(b.axis(c)) += 0.5 * torque.cross(b.A.col(c));
  if (m.rotates) out.segment(b.offset + 12, b.nm).noalias() += m.Jw.transpose() * torque;
}

}  // namespace floatframe

#include "floatframe/formulation/absolute.hpp"

#include <algorithm>

namespace floatframe {

namespace {

// Pairs of axes of the orthonormality rows: u.u, v.v, w.w, u.v, u.w, v.w.
constexpr int pair_a[6] = {0, 1, 2, 0, 0, 1};
constexpr int pair_b[6] = {0, 1, 2, 1, 2, 2};

}  // namespace

AbsoluteFormulation::AbsoluteFormulation(const Model& model, InertiaMethod method) : model_(model) {
  for (std::size_t j = 0; j < model_.joints.size(); ++j)
    append_joint_parts(model_, static_cast<int>(j), parts_);
  for (std::size_t j = 0; j < model_.rods.size(); ++j)
    append_rod_parts(model_, static_cast<int>(j), parts_);
  for (std::size_t j = 0; j < model_.joints.size(); ++j)
    append_motion_parts(model_, static_cast<int>(j), parts_);

  for (const Marker& m : model_.markers) {
    MarkerData d;
    static_cast<LocalMarker&>(d) = LocalMarker(model_, m);
    markers_.push_back(std::move(d));
  }
  bodies_.resize(model_.bodies.size());
  // Outer points: where a constraint holds the position of a deforming node. Joints at one node
  // share the point.
  const auto needs_position = [](ConstraintPart::Kind k) {
    return k != ConstraintPart::Kind::perpendicular && k != ConstraintPart::Kind::drive_angle;
  };
  std::vector<std::pair<int, int>> point_of_marker;  // marker -> (body, local point)
  for (const ConstraintPart& p : parts_) {
    if (!needs_position(p.kind)) continue;
    for (const int marker : {p.a, p.b}) {
      MarkerData& m = markers_[static_cast<std::size_t>(marker)];
      if (m.body < 0 || !m.local || m.point >= 0) continue;
      BodyData& b = body(m.body);
      int local = -1;
      for (std::size_t k = 0; k < b.point_marker.size(); ++k) {
        const MarkerData& other = markers_[static_cast<std::size_t>(b.point_marker[k])];
        if ((other.node_p - m.node_p).isZero(0.0) && (other.X - m.X).isZero(0.0) &&
            other.X_NM.p.isZero(0.0) && m.X_NM.p.isZero(0.0))
          local = static_cast<int>(k);
      }
      if (local < 0) {
        local = static_cast<int>(b.point_marker.size());
        b.point_marker.push_back(marker);
      }
      m.point = local;  // made global below
    }
  }
  std::vector<int> sizes;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    const Body& m = model_.bodies[i];
    b.nm = m.modes();
    b.points = static_cast<int>(b.point_marker.size());
    b.length = m.length;
    b.offset = nq_;
    nq_ += b.size();
    b.row = nc_;
    nc_ += 6 + 3 * b.points;
    b.y = b.yd = VecX::Zero(b.nm);
    b.inertia = BodyInertia(*m.data, m.name, method);
    b.M = MatX::Zero(12 + b.nm, 12 + b.nm);
    b.Qv = b.work = VecX::Zero(12 + b.nm);
    b.J = MatX::Zero(3, b.size());
    sizes.push_back(b.size());
  }
  for (MarkerData& m : markers_)
    if (m.point >= 0) m.point = body(m.body).offset + 12 + body(m.body).nm + 3 * m.point;
  part_rows_ = nc_;
  std::vector<std::pair<int, int>> edges;
  const auto couple = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    const int ba = markers_[static_cast<std::size_t>(a)].body,
              bb = markers_[static_cast<std::size_t>(b)].body;
    if (ba >= 0 && bb >= 0) edges.emplace_back(ba, bb);
  };
  for (const ConstraintPart& p : parts_) {
    part_offset_.push_back(nc_);
    nc_ += p.rows();
    couple(p.a, p.b);
  }
  for (const Force& f : model_.forces) couple(f.a, f.b);
  matrix_ = BlockLdlt(sizes, edges);
  rows_.resize(static_cast<std::size_t>(nc_ - part_rows_));
  force_states_.resize(model_.forces.size());
  force_reference_.assign(model_.forces.size(), 0.0);
  phi_ = weights_ = lambda_ = VecX::Zero(nc_);
  a_ = omega2_ = VecX::Zero(nq_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    omega2_.segment(bodies_[i].offset + 12, bodies_[i].nm) =
        bodies_[i].inertia.own_frequencies_squared(model_.bodies[i].data->K);
  int widest = 12;
  for (int s : sizes) widest = std::max(widest, s);
  for (Gradient* g : {&ga_, &gb_}) {
    g->index.resize(static_cast<std::size_t>(widest));
    g->value.resize(static_cast<std::size_t>(widest));
  }
}

void AbsoluteFormulation::start_from(RelativeFormulation& tree, const VecX& tree_q,
                                     const VecX& tree_v, VecX& q, VecX& v) const {
  q = v = VecX::Zero(nq_);
  tree.positions(0.0, tree_q);
  tree.velocities(tree_v);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const int k = static_cast<int>(i);
    const Mat3& A = tree.body_rotation(k);
    const Mat3 Adot = skew(tree.body_angular_velocity(k)) * A;
    q.segment<3>(b.offset) = tree.body_position(k);
    v.segment<3>(b.offset) = tree.body_velocity(k);
    for (int c = 0; c < 3; ++c) {
      q.segment<3>(b.offset + 3 + 3 * c) = A.col(c);
      v.segment<3>(b.offset + 3 + 3 * c) = Adot.col(c);
    }
    for (int m = 0; m < b.nm; ++m) {
      q[b.offset + 12 + m] = tree.amplitude(tree_q, k, m);
      v[b.offset + 12 + m] = tree.amplitude_rate(tree_v, k, m);
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerState& s = tree.marker(b.point_marker[static_cast<std::size_t>(p)]);
      q.segment<3>(b.offset + 12 + b.nm + 3 * p) = s.r + tree.origin();
      v.segment<3>(b.offset + 12 + b.nm + 3 * p) = s.v;
    }
  }
}

void AbsoluteFormulation::positions(double t, const VecX& q) noexcept {
  time_ = t;
  for (BodyData& b : bodies_) {
    b.r0 = q.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.A.col(c) = q.segment<3>(b.offset + 3 + 3 * c);
    b.y = q.segment(b.offset + 12, b.nm);
  }
  for (MarkerData& m : markers_) {
    if (m.body < 0) {
      m.s.r = m.X_NM.p;
      m.s.R = m.X_NM.R;
      continue;
    }
    const BodyData& b = body(m.body);
    if (m.local) {
      m.deform(b.y);
      m.world_gradients(b.A);
    }
    m.s.r.noalias() = b.r0 + b.A * m.p_B;
    m.s.R.noalias() = b.A * m.R_B;
    if (m.point >= 0) m.r_P = q.segment<3>(m.point);
  }
}

void AbsoluteFormulation::velocities(const VecX& v) noexcept {
  for (BodyData& b : bodies_) {
    b.r0_dot = v.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.Adot.col(c) = v.segment<3>(b.offset + 3 + 3 * c);
    b.yd = v.segment(b.offset + 12, b.nm);
    b.w.setZero();
    for (int c = 0; c < 3; ++c) b.w += 0.5 * b.A.col(c).cross(b.Adot.col(c));
    for (int k = 0; k < 6; ++k) {
      const double dot = b.A.col(pair_a[k]).dot(b.A.col(pair_b[k]));
      phi_[b.row + k] = b.length * (k < 3 ? 0.5 * (dot - 1.0) : dot);
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m =
          markers_[static_cast<std::size_t>(b.point_marker[static_cast<std::size_t>(p)])];
      phi_.segment<3>(b.row + 6 + 3 * p) = m.r_P - m.s.r;
    }
  }
  for (MarkerData& m : markers_) {
    MarkerState& s = m.s;
    s.v.setZero();
    s.w.setZero();
    s.a_bias.setZero();
    s.alpha_bias.setZero();
    if (m.body < 0) continue;
    const BodyData& b = body(m.body);
    s.v.noalias() = b.r0_dot + b.Adot * m.p_B;
    s.w = b.w;
    if (m.local) {
      m.deform_rate(b.yd);
      s.v.noalias() += b.A * m.pdot_B;
      s.a_bias.noalias() = 2.0 * (b.Adot * m.pdot_B);
      s.a_bias.noalias() += b.A * m.pddot_B;
      if (m.rotates) {
        s.w.noalias() += b.A * m.zeta_B;
        s.alpha_bias.noalias() = b.Adot * m.zeta_B;
        s.alpha_bias.noalias() += b.A * m.zetadot_B;
      }
    }
    if (m.point >= 0) m.v_P = v.segment<3>(m.point);
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    const MarkerState a = constraint_state(markers_[static_cast<std::size_t>(p.a)]);
    const MarkerState b = constraint_state(markers_[static_cast<std::size_t>(p.b)]);
    ConstraintRow* rows = rows_.data() + (part_offset_[k] - part_rows_);
    evaluate_constraint(p, a, b, time_, rows);
    for (int r = 0; r < p.rows(); ++r) phi_[part_offset_[k] + r] = rows[r].phi;
  }
}

MarkerState AbsoluteFormulation::constraint_state(const MarkerData& m) const noexcept {
  MarkerState s = m.s;
  if (m.point >= 0) {
    s.r = m.r_P;
    s.v = m.v_P;
    s.a_bias.setZero();
  }
  return s;
}

void AbsoluteFormulation::dynamics() noexcept {
  for (BodyData& b : bodies_) b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
  forces();
}

void AbsoluteFormulation::forces() noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const MarkerState& b = markers_[static_cast<std::size_t>(f.b)].s;
    const MarkerState& a = f.a >= 0 ? markers_[static_cast<std::size_t>(f.a)].s : b;
    evaluate_force(model_, f, a, b, Vec3::Zero(), time_, force_reference_[k], force_states_[k]);
    if (f.type == ForceType::joint_spring) force_reference_[k] = force_states_[k].length;
  }
}

void AbsoluteFormulation::add_wrench(int marker, bool through_point, const Vec3& force,
                                     const Vec3& torque, VecX& out) const noexcept {
  const MarkerData& m = markers_[static_cast<std::size_t>(marker)];
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

void AbsoluteFormulation::gradient(int marker, bool through_point, const Vec3& force,
                                   const Vec3& torque, Gradient& g) const noexcept {
  g.body = -1;
  g.count = 0;
  if (marker < 0) return;
  const MarkerData& m = markers_[static_cast<std::size_t>(marker)];
  if (m.body < 0) return;
  g.body = m.body;
  const BodyData& b = body(m.body);
  const auto put = [&](int index, double value) {
    if (value == 0.0) return;
    g.index[static_cast<std::size_t>(g.count)] = index;
    g.value[static_cast<std::size_t>(g.count++)] = value;
  };
  const bool on_body = !(through_point && m.point >= 0);
  if (on_body)
    for (int i = 0; i < 3; ++i) put(i, force[i]);
  for (int c = 0; c < 3; ++c) {
    Vec3 x = 0.5 * torque.cross(b.A.col(c));
    if (on_body) x += m.p_B[c] * force;
    for (int i = 0; i < 3; ++i) put(3 + 3 * c + i, x[i]);
  }
  if (m.local)
    for (int k = 0; k < b.nm; ++k) {
      double x = on_body ? m.Jr.col(k).dot(force) : 0.0;
      if (m.rotates) x += m.Jw.col(k).dot(torque);
      put(12 + k, x);
    }
  if (!on_body)
    for (int i = 0; i < 3; ++i) put(m.point - b.offset + i, force[i]);
}

void AbsoluteFormulation::add_rank_one(const Gradient& a, const Gradient& b,
                                       double weight) noexcept {
  const auto own = [&](const Gradient& g) {
    if (g.body < 0) return;
    MatX& f = matrix_.front(g.body);
    for (int j = 0; j < g.count; ++j) {
      const double w = weight * g.value[static_cast<std::size_t>(j)];
      double* column =
          f.data() + static_cast<Eigen::Index>(g.index[static_cast<std::size_t>(j)]) * f.rows();
      for (int i = j; i < g.count; ++i)
        column[g.index[static_cast<std::size_t>(i)]] += w * g.value[static_cast<std::size_t>(i)];
    }
  };
  own(a);
  own(b);
  if (a.body < 0 || b.body < 0) return;
  int oa = 0, ob = 0;
  MatX& f = matrix_.front(a.body, b.body, oa, ob);
  const bool a_first = oa < ob;
  const Gradient& first = a_first ? a : b;
  const Gradient& second = a_first ? b : a;
  const int of = std::min(oa, ob), os = std::max(oa, ob);
  for (int j = 0; j < first.count; ++j) {
    const double w = weight * first.value[static_cast<std::size_t>(j)];
    double* column =
        f.data() +
        static_cast<Eigen::Index>(of + first.index[static_cast<std::size_t>(j)]) * f.rows() + os;
    for (int i = 0; i < second.count; ++i)
      column[second.index[static_cast<std::size_t>(i)]] +=
          w * second.value[static_cast<std::size_t>(i)];
  }
}

void AbsoluteFormulation::add_part_forces(const VecX& w, VecX& out) const noexcept {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    Vec3 fa = Vec3::Zero(), ta = fa, fb = fa, tb = fa;
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const WrenchRow& g = rows_[static_cast<std::size_t>(i - part_rows_)].gradient;
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
      const int marker = b.point_marker[static_cast<std::size_t>(p)];
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
      const MarkerData& m =
          markers_[static_cast<std::size_t>(b.point_marker[static_cast<std::size_t>(p)])];
      out.segment<3>(b.row + 6 + 3 * p) = m.v_P - m.s.v;
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    const MarkerState a = constraint_state(markers_[static_cast<std::size_t>(p.a)]);
    const MarkerState b = constraint_state(markers_[static_cast<std::size_t>(p.b)]);
    for (int r = 0; r < p.rows(); ++r) {
      const int i = part_offset_[k] + r;
      const ConstraintRow& row = rows_[static_cast<std::size_t>(i - part_rows_)];
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
      const MarkerData& m =
          markers_[static_cast<std::size_t>(b.point_marker[static_cast<std::size_t>(p)])];
      out.segment<3>(b.row + 6 + 3 * p) = delta.segment<3>(b.offset + 12 + b.nm + 3 * p) - point(m);
    }
  }
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = markers_[static_cast<std::size_t>(marker)];
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
      const WrenchRow& g = rows_[static_cast<std::size_t>(i - part_rows_)].gradient;
      out[i] = g.Fa.dot(ra) + g.Ta.dot(wa) + g.Fb.dot(rb) + g.Tb.dot(wb);
    }
  }
}

Vec3 AbsoluteFormulation::marker_acceleration(int index) const noexcept {
  const MarkerData& m = markers_[static_cast<std::size_t>(index)];
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
      const int marker = b.point_marker[static_cast<std::size_t>(p)];
      out.segment<3>(b.row + 6 + 3 * p) =
          a.segment<3>(b.offset + 12 + b.nm + 3 * p) - marker_acceleration(marker);
    }
  }
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = markers_[static_cast<std::size_t>(marker)];
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
      const ConstraintRow& row = rows_[static_cast<std::size_t>(i - part_rows_)];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(aa) + g.Ta.dot(wa) + g.Fb.dot(ab) + g.Tb.dot(wb) + row.quad + row.phi_tt;
    }
  }
}

int AbsoluteFormulation::factorize(double mass, double damping, double s, double alpha) noexcept {
  matrix_.set_zero();
  const double penalty = s * alpha;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    MatX& f = matrix_.front(static_cast<int>(i));
    f.topLeftCorner(12 + b.nm, 12 + b.nm) += mass * b.M;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[i].data;
      f.block(12, 12, b.nm, b.nm) += s * data.K + damping * data.D;
    }
    // Orthonormality: penalty, and the geometric stiffness of its multipliers.
    const double l2 = penalty * b.length * b.length;
    for (int k = 0; k < 6; ++k) {
      const int ia = 3 + 3 * pair_a[k], ib = 3 + 3 * pair_b[k];
      const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
      const double g = s * b.length * lambda_[b.row + k];
      if (k < 3) {
        f.block<3, 3>(ia, ia) += l2 * u * u.transpose();
        for (int c = 0; c < 3; ++c) f(ia + c, ia + c) += g;
      } else {
        f.block<3, 3>(ia, ia) += l2 * v * v.transpose();
        f.block<3, 3>(ib, ib) += l2 * u * u.transpose();
        f.block<3, 3>(ib, ia) += l2 * u * v.transpose();
        for (int c = 0; c < 3; ++c) f(ib + c, ia + c) += g;
      }
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m =
          markers_[static_cast<std::size_t>(b.point_marker[static_cast<std::size_t>(p)])];
      const int at = 12 + b.nm + 3 * p;
      // The tip definition is bilinear in A and y: geometric stiffness of its multipliers.
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < b.nm; ++k)
          for (int i2 = 0; i2 < 3; ++i2)
            f(12 + k, 3 + 3 * c + i2) -= s * lambda_[b.row + 6 + 3 * p + i2] * m.X(c, k);
      for (int c = 0; c < 3; ++c) {
        gradient(b.point_marker[static_cast<std::size_t>(p)], false, -Vec3::Unit(c), Vec3::Zero(),
                 ga_);
        ga_.index[static_cast<std::size_t>(ga_.count)] = at + c;
        ga_.value[static_cast<std::size_t>(ga_.count++)] = 1.0;
        gb_.body = -1;
        add_rank_one(ga_, gb_, penalty);
      }
    }
  }
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& force = model_.forces[k];
    const ForceState& state = force_states_[k];
    for (int r = 0; r < state.row_count; ++r) {
      const TangentRow& row = state.rows[r];
      const double weight = s * row.k + damping * row.c;
      if (weight == 0.0) continue;
      gradient(force.a, false, row.g.Fa, row.g.Ta, ga_);
      gradient(force.b, false, row.g.Fb, row.g.Tb, gb_);
      if (ga_.body >= 0 && ga_.body == gb_.body)
        continue;  // within one body only its modes feel it: left to Newton
      add_rank_one(ga_, gb_, weight);
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    for (int r = 0; r < p.rows(); ++r) {
      const WrenchRow& g =
          rows_[static_cast<std::size_t>(part_offset_[k] + r - part_rows_)].gradient;
      gradient(p.a, true, g.Fa, g.Ta, ga_);
      gradient(p.b, true, g.Fb, g.Tb, gb_);
      add_rank_one(ga_, gb_, penalty);
    }
    if (p.kind == ConstraintPart::Kind::distance) {  // its gradient d/L turns with the rod
      const double w = s * lambda_[part_offset_[k]] / p.scale;
      for (int c = 0; c < 3; ++c) {
        gradient(p.a, true, -Vec3::Unit(c), Vec3::Zero(), ga_);
        gradient(p.b, true, Vec3::Unit(c), Vec3::Zero(), gb_);
        add_rank_one(ga_, gb_, w);
      }
    }
  }
  return matrix_.factorize();
}

double AbsoluteFormulation::kinetic_energy(const VecX& v) noexcept {
  double sum = 0.0;
  for (BodyData& b : bodies_) {
    b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
    const VecX x = v.segment(b.offset, 12 + b.nm);
    sum += 0.5 * x.dot(b.M * x);
  }
  return sum;
}

double AbsoluteFormulation::gravity_energy(const VecX&) const noexcept {
  double sum = 0.0;
  for (const BodyData& b : bodies_) {
    const PreprocessingData& d = b.inertia.data();
    const Vec3 m_bar = d.m_u + d.S * b.y;
    sum -= model_.gravity.dot(d.m * b.r0 + b.A * m_bar);
  }
  return sum;
}

double AbsoluteFormulation::elastic_energy(const VecX& q) const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const VecX y = q.segment(bodies_[i].offset + 12, bodies_[i].nm);
    if (y.size() > 0) sum += 0.5 * y.dot(model_.bodies[i].data->K * y);
  }
  return sum;
}

std::string AbsoluteFormulation::coordinate_owner(int i) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const BodyData& b = bodies_[k];
    if (i < b.offset || i >= b.offset + b.size()) continue;
    const int j = i - b.offset;
    const std::string name = "body '" + model_.bodies[k].name + "'";
    if (j < 12) return name;
    if (j < 12 + b.nm) return "mode " + std::to_string(j - 11) + " of " + name;
    return "outer point " + std::to_string((j - 12 - b.nm) / 3 + 1) + " of " + name;
  }
  return "coordinate " + std::to_string(i);
}

MatX AbsoluteFormulation::constraint_jacobian() {
  MatX J = MatX::Zero(nc_, nq_);
  VecX w = VecX::Zero(nc_), row(nq_);
  for (int i = 0; i < nc_; ++i) {
    w.setZero();
    w[i] = 1.0;
    constraint_forces(w, row);
    J.row(i) = row.transpose();
  }
  return J;
}

CoordinateCounts AbsoluteFormulation::counts() const {
  CoordinateCounts c;
  for (const BodyData& b : bodies_) {
    c.rigid += 12 + 3 * b.points;
    c.elastic += b.nm;
  }
  c.total = c.rigid + c.elastic;
  c.constraints = nc_;
  return c;
}

MatX AbsoluteFormulation::mass_matrix() const {
  MatX M = MatX::Zero(nq_, nq_);
  for (const BodyData& b : bodies_) M.block(b.offset, b.offset, 12 + b.nm, 12 + b.nm) = b.M;
  return M;
}

}  // namespace floatframe

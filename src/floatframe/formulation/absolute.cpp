// Load time of the absolute formulation; positions and velocities.
#include "floatframe/formulation/absolute.hpp"

#include <algorithm>

#include "floatframe/formulation/equations_of_motion.hpp"

namespace floatframe {

static_assert(EquationsOfMotion<AbsoluteFormulation>);

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
  std::vector<std::pair<int, int>> point_of_marker;  // marker -> (body, local point)
  for (const ConstraintPart& p : parts_) {
    if (!constraint_kind(p.type).points) continue;
    for (const int marker : {p.a, p.b}) {
      MarkerData& m = markers_[marker];
      if (m.body < 0 || !m.local || m.point >= 0) continue;
      BodyData& b = body(m.body);
      int local = -1;
      for (std::size_t k = 0; k < b.point_marker.size(); ++k) {
        const MarkerData& other = markers_[b.point_marker[k]];
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
    const int ba = markers_[a].body, bb = markers_[b].body;
    if (ba >= 0 && bb >= 0) edges.emplace_back(ba, bb);
  };
  for (const ConstraintPart& p : parts_) {
    part_offset_.push_back(nc_);
    nc_ += p.rows();
    couple(p.a, p.b);
  }
  for (const Force& f : model_.forces) couple(f.a, f.b);
  for (Linearization& l : linearizations_) {
    l.matrix = BlockLdlt(sizes, edges);
    l.row_start.assign(static_cast<std::size_t>(nc_) + 1, 0);
    std::size_t most = 0;
    for (const BodyData& b : bodies_)
      most += static_cast<std::size_t>(6 * 6 + 3 * b.points * (13 + b.nm));
    for (const ConstraintPart& p : parts_)
      for (const int marker : {p.a, p.b})
        if (const int i = markers_[marker].body; i >= 0)
          most += static_cast<std::size_t>(p.rows() * body(i).size());
    l.column.assign(most, 0);
    l.value.assign(most, 0.0);
  }
  rows_.resize(nc_ - part_rows_);
  force_states_.resize(model_.forces.size());
  force_reference_.assign(model_.forces.size(), 0.0);
  kept_reference_ = force_reference_;
  for (const Input& input : model_.inputs) inputs_.push_back(input.initial);
  phi_ = weights_ = lambda_ = VecX::Zero(nc_);
  a_ = omega2_ = VecX::Zero(nq_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    omega2_.segment(bodies_[i].offset + 12, bodies_[i].nm) =
        bodies_[i].inertia.own_frequencies_squared(model_.bodies[i].data->K);
  int widest = 12;
  for (int s : sizes) widest = std::max(widest, s);
  for (Gradient* g : {&ga_, &gb_}) {
    g->index.resize(widest);
    g->value.resize(widest);
  }
}

void AbsoluteFormulation::start_from(RelativeFormulation& tree, const VecX& tree_q,
                                     const VecX& tree_v, VecX& q, VecX& v) {
  q = v = VecX::Zero(nq_);
  tree.positions(0.0, tree_q);
  tree.velocities(tree_v);
  tree.forces();
  for (std::size_t k = 0; k < model_.forces.size(); ++k)
    if (model_.forces[k].rotational) force_reference_[k] = tree.force(static_cast<int>(k)).length;
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
      const MarkerState& s = tree.marker(b.point_marker[p]);
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
      const MarkerData& m = markers_[b.point_marker[p]];
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
    const MarkerState a = constraint_state(markers_[p.a]);
    const MarkerState b = constraint_state(markers_[p.b]);
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

}  // namespace floatframe

#include "floatframe/formulation/relative.hpp"

#include <algorithm>
#include <numeric>

#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

RelativeFormulation::RelativeFormulation(const Model& model, InertiaMethod method)
    : model_(model), topology_(find_topology(model)) {
  build_bodies(method);
  build_clusters();
  build_elements();
}

// ------------------------------------------------------------------------------------------------------
// load time

void RelativeFormulation::build_bodies(InertiaMethod method) {
  bodies_.resize(model_.bodies.size());
  for (const Topology::Link& link : topology_.links) {
    BodyData& b = body(link.body);
    const Joint& joint = model_.joints[static_cast<std::size_t>(link.joint)];
    const Body& m = model_.bodies[static_cast<std::size_t>(link.body)];
    b.parent = link.parent;
    b.joint = link.joint;
    b.type = joint.type;
    b.reversed = link.reversed;
    b.frame_F = link.reversed ? joint.frame_M : joint.frame_F;
    b.frame_M = link.reversed ? joint.frame_F : joint.frame_M;
    b.axis_1 = link.reversed ? joint.axis_2 : Vec3::UnitZ();
    b.axis_2 = link.reversed ? Vec3::UnitZ() : joint.axis_2;
    b.nj = joint_velocities(joint.type);
    b.nm = m.modes();
    b.nm_parent =
        link.parent < 0 ? 0 : model_.bodies[static_cast<std::size_t>(link.parent)].modes();
    const auto moves = [&](int marker) {
      const Marker& k = model_.markers[static_cast<std::size_t>(marker)];
      if (k.body < 0 || k.node < 0) return false;
      const ModalNode& node = model_.bodies[static_cast<std::size_t>(k.body)]
                                  .data->nodes[static_cast<std::size_t>(k.node)];
      return !node.X.isZero(0.0) || (k.rotates && !node.X_theta.isZero(0.0));
    };
    b.phi = link.parent >= 0 && b.nm_parent > 0 && moves(b.frame_F);
    b.psi = b.nm > 0 && moves(b.frame_M);
    b.b = Mat6X::Zero(6, b.nj);
    b.Phi = Mat6X::Zero(6, b.nm_parent);
    b.Psi = Mat6X::Zero(6, b.nm);
    b.inertia = BodyInertia(*m.data, m.name, method);
    b.M = MatX::Zero(6 + b.nm, 6 + b.nm);
    b.T = b.M;
    b.Qv = VecX::Zero(6 + b.nm);
    b.h = b.Qv;
    b.y = b.yd = b.ydd = VecX::Zero(b.nm);
    b.MzPhi = Mat6X::Zero(6, b.nm_parent);
    b.U = Mat6X::Zero(6, b.nj + b.nm);
    b.g_force.setZero();
    b.g_virial.setZero();
    b.g_modal = b.G_modal = Mat3X::Zero(3, b.nm);
  }
  markers_.resize(model_.markers.size());
  for (std::size_t i = 0; i < markers_.size(); ++i)
    static_cast<LocalMarker&>(markers_[i]) = LocalMarker(model_, model_.markers[i]);
}

void RelativeFormulation::build_clusters() {
  const int n = static_cast<int>(bodies_.size());
  for (std::size_t j = 0; j < model_.joints.size(); ++j)
    if (std::find(topology_.cut_joints.begin(), topology_.cut_joints.end(), static_cast<int>(j)) !=
        topology_.cut_joints.end())
      append_joint_parts(model_, static_cast<int>(j), parts_);
  for (std::size_t j = 0; j < model_.rods.size(); ++j)
    append_rod_parts(model_, static_cast<int>(j), parts_);
  for (std::size_t j = 0; j < model_.joints.size(); ++j)
    append_motion_parts(model_, static_cast<int>(j), parts_);

  // Union-find over bodies that one two-marker element ties together below their lowest common
  // ancestor.
  std::vector<int> set(static_cast<std::size_t>(n));
  std::iota(set.begin(), set.end(), 0);
  const auto find = [&](int i) {
    while (set[static_cast<std::size_t>(i)] != i) i = set[static_cast<std::size_t>(i)];
    return i;
  };
  const auto path_to_root = [&](int i) {
    std::vector<int> path;
    for (; i >= 0; i = body(i).parent) path.push_back(i);
    return path;
  };
  const auto tie = [&](int marker_a, int marker_b) {
    std::vector<int> pa = path_to_root(mark(marker_a).body), pb = path_to_root(mark(marker_b).body);
    while (!pa.empty() && !pb.empty() && pa.back() == pb.back()) {
      pa.pop_back();
      pb.pop_back();
    }
    pa.insert(pa.end(), pb.begin(), pb.end());
    for (std::size_t i = 1; i < pa.size(); ++i)
      set[static_cast<std::size_t>(find(pa[i]))] = find(pa[0]);
  };
  for (const ConstraintPart& p : parts_) tie(p.a, p.b);
  for (const Force& f : model_.forces)
    if (f.a >= 0 && mark(f.a).body >= 0 && mark(f.b).body >= 0) tie(f.a, f.b);

  // Clusters in the order of their first body, which keeps parents before children; coordinates
  // cluster by cluster.
  std::vector<int> cluster_of_set(static_cast<std::size_t>(n), -1);
  for (const Topology::Link& link : topology_.links) {
    const auto root = static_cast<std::size_t>(find(link.body));
    if (cluster_of_set[root] < 0) {
      cluster_of_set[root] = static_cast<int>(clusters_.size());
      clusters_.emplace_back();
    }
    clusters_[static_cast<std::size_t>(cluster_of_set[root])].bodies.push_back(link.body);
    body(link.body).cluster = cluster_of_set[root];
  }
  // A cluster found early may hang from a body of one found later: sort by depth of the parent
  // body.
  std::vector<int> depth(static_cast<std::size_t>(n), 0);
  for (const Topology::Link& link : topology_.links)
    depth[static_cast<std::size_t>(link.body)] =
        link.parent < 0 ? 1 : depth[static_cast<std::size_t>(link.parent)] + 1;
  for (Cluster& c : clusters_) {
    int best = n + 2;
    for (int i : c.bodies) {
      const int p = body(i).parent;
      if (p >= 0 && find(p) == find(i)) continue;
      const int d = p < 0 ? 0 : depth[static_cast<std::size_t>(p)];
      if (d < best) {
        best = d;
        c.parent = p;
      }
    }
  }
  std::vector<int> level(clusters_.size(), -1);
  const auto cluster_level = [&](auto&& self, std::size_t k) -> int {
    if (level[k] < 0)
      level[k] = clusters_[k].parent < 0
                     ? 0
                     : self(self, static_cast<std::size_t>(body(clusters_[k].parent).cluster)) + 1;
    return level[k];
  };
  cluster_order_.resize(clusters_.size());
  std::iota(cluster_order_.begin(), cluster_order_.end(), 0);
  for (std::size_t k = 0; k < clusters_.size(); ++k) cluster_level(cluster_level, k);
  std::stable_sort(cluster_order_.begin(), cluster_order_.end(), [&](int a, int b) {
    return level[static_cast<std::size_t>(a)] < level[static_cast<std::size_t>(b)];
  });
  for (int k : cluster_order_) {
    Cluster& c = clusters_[static_cast<std::size_t>(k)];
    c.offset = nv_;
    for (int i : c.bodies) {
      BodyData& b = body(i);
      order_.push_back(i);
      b.iq = nq_;
      nq_ += joint_configurations(b.type);
      b.iyq = nq_;
      nq_ += b.nm;
      b.iv = nv_;
      nv_ += b.nj;
      b.iy = nv_;
      nv_ += b.nm;
    }
    c.size = nv_ - c.offset;
    c.n = c.size + (c.parent < 0 ? 0 : 6 + body(c.parent).nm);
    c.front = MatX::Zero(c.n, c.n);
    c.original = VecX::Zero(c.n);
    c.work = VecX::Zero(c.n);
  }
}

int RelativeFormulation::mode_front(const Cluster& c, int i) const {
  if (i == c.parent) return c.size + 6;
  return body(i).iy - c.offset;
}

RelativeFormulation::Element RelativeFormulation::make_element(int a, int b) {
  Element e;
  e.a = a;
  e.b = b;
  const int body_a = a < 0 ? -1 : mark(a).body, body_b = mark(b).body;
  std::vector<int> pa, pb;
  for (int i = body_a; i >= 0; i = body(i).parent) pa.push_back(i);
  for (int i = body_b; i >= 0; i = body(i).parent) pb.push_back(i);
  int lca = -1;
  while (!pa.empty() && !pb.empty() && pa.back() == pb.back()) {
    lca = pa.back();
    pa.pop_back();
    pb.pop_back();
  }
  const int lead = !pa.empty() ? pa.front() : !pb.empty() ? pb.front() : lca;
  if (lead < 0) return e;
  // Both markers on one body: only its modes see the element; its front is that of its cluster.
  e.cluster = body(lead).cluster;
  const Cluster& c = clusters_[static_cast<std::size_t>(e.cluster)];
  const auto add = [&](PathEntry::What what, int i, int marker, bool side_b, int front, int count) {
    if (count > 0) e.path.push_back({what, i, marker, side_b, front, count});
  };
  const auto walk = [&](const std::vector<int>& path, int marker, bool side_b, int end) {
    for (int i : path) {
      const BodyData& d = body(i);
      add(PathEntry::What::joint, i, marker, side_b, d.iv - c.offset, d.nj);
      if (d.psi) add(PathEntry::What::own_modes, i, marker, side_b, d.iy - c.offset, d.nm);
      if (d.phi)
        add(PathEntry::What::parent_modes, i, marker, side_b, mode_front(c, d.parent), d.nm_parent);
    }
    if (end >= 0 && mark(marker).local)
      add(PathEntry::What::marker_modes, end, marker, side_b, mode_front(c, end), body(end).nm);
  };
  if (a >= 0) walk(pa, a, false, body_a);
  walk(pb, b, true, body_b);
  for (const PathEntry& p : e.path)
    for (int k = 0; k < p.count; ++k) e.columns.push_back(p.front + k);
  std::sort(e.columns.begin(), e.columns.end());
  e.columns.erase(std::unique(e.columns.begin(), e.columns.end()), e.columns.end());
  for (const PathEntry& p : e.path)
    e.entry_slot.push_back(static_cast<int>(
        std::lower_bound(e.columns.begin(), e.columns.end(), p.front) - e.columns.begin()));
  return e;
}

void RelativeFormulation::build_elements() {
  for (const ConstraintPart& p : parts_) {
    part_elements_.push_back(make_element(p.a, p.b));
    part_offset_.push_back(nc_);
    nc_ += p.rows();
  }
  for (const Force& f : model_.forces) {
    const bool two_bodies = f.a >= 0 && mark(f.a).body >= 0 && mark(f.b).body >= 0;
    if (two_bodies) {
      force_elements_.push_back(make_element(f.a, f.b));
    } else {
      Element e;
      e.a = f.a;
      e.b = f.b;
      e.body = mark(f.b).body >= 0 ? mark(f.b).body : f.a >= 0 ? mark(f.a).body : -1;
      force_elements_.push_back(e);
    }
  }
  omega2_ = VecX::Zero(nv_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    omega2_.segment(bodies_[i].iy, bodies_[i].nm) =
        bodies_[i].inertia.own_frequencies_squared(model_.bodies[i].data->K);
  rows_.resize(static_cast<std::size_t>(nc_));
  force_states_.resize(model_.forces.size());
  force_reference_.assign(model_.forces.size(), 0.0);
  phi_ = weights_ = lambda_ = VecX::Zero(nc_);
  std::size_t widest = 64;
  for (const Element& e : part_elements_) widest = std::max(widest, e.columns.size());
  for (const Element& e : force_elements_) widest = std::max(widest, e.columns.size());
  for (const BodyData& b : bodies_) widest = std::max(widest, static_cast<std::size_t>(6 + b.nm));
  slots_ = VecX::Zero(static_cast<Eigen::Index>(widest));
  // Markers grouped by body; a body's own joint marker is handled with the joint.
  used_markers_of_body_offset_.assign(bodies_.size() + 1, 0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    used_markers_of_body_offset_[i] = static_cast<int>(used_markers_.size());
    for (std::size_t k = 0; k < markers_.size(); ++k)
      if (markers_[k].body == static_cast<int>(i) && static_cast<int>(k) != bodies_[i].frame_M)
        used_markers_.push_back(static_cast<int>(k));
  }
  used_markers_of_body_offset_.back() = static_cast<int>(used_markers_.size());
}

void RelativeFormulation::start(VecX& q, VecX& v) const {
  q = VecX::Zero(nq_);
  v = VecX::Zero(nv_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const Joint& joint = model_.joints[static_cast<std::size_t>(b.joint)];
    double position[6] = {}, velocity[6] = {};
    for (int k = 0; k < b.nj; ++k) {
      const int from = b.reversed && b.type == JointType::universal ? 1 - k : k;
      const double sign = b.reversed ? -1.0 : 1.0;
      const auto f = static_cast<std::size_t>(from);
      if (f < joint.position.size()) position[k] = sign * joint.position[f];
      if (f < joint.velocity.size()) velocity[k] = sign * joint.velocity[f];
    }
    if (joint.motion && b.nj == 1) {
      const PiecewisePolynomial::Value f = evaluate(*joint.motion, 0.0);
      position[0] = b.reversed ? -f.f : f.f;
      velocity[0] = b.reversed ? -f.df : f.df;
    }
    joint_configuration(b.type, position, q.data() + b.iq);
    for (int k = 0; k < b.nj; ++k) v[b.iv + k] = velocity[k];
    if (b.type == JointType::free && b.parent < 0) v.segment<3>(b.iv) += model_.simulation.velocity;
    if (b.nm > 0 && model_.amplitudes[i].size() == b.nm)
      q.segment(b.iyq, b.nm) = model_.amplitudes[i];
    if (b.nm > 0 && model_.amplitude_rates[i].size() == b.nm)
      v.segment(b.iy, b.nm) = model_.amplitude_rates[i];
  }
}

std::vector<char> RelativeFormulation::given_coordinates() const {
  std::vector<char> given(static_cast<std::size_t>(nv_), 0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const Joint& joint = model_.joints[static_cast<std::size_t>(b.joint)];
    if (!joint.position.empty() || !joint.velocity.empty())
      for (int k = 0; k < b.nj; ++k) given[static_cast<std::size_t>(b.iv + k)] = 1;
    if (b.nm > 0 && model_.amplitudes[i].size() == b.nm)
      for (int k = 0; k < b.nm; ++k) given[static_cast<std::size_t>(b.iy + k)] = 1;
  }
  return given;
}

// -------------------------------------------------------------------------------------------------------
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
  static constexpr double at_rest[6] = {};
  {  // the origin of this evaluation: the first body's joint frame M
    BodyData& b = body(order_[0]);
    joint_motion(b.type, b.axis_1, b.axis_2, q.data() + b.iq, at_rest, b.motion);
    const Pose& X_WF = model_.markers[static_cast<std::size_t>(b.frame_F)].X_NM;
    origin_ = X_WF.p + X_WF.R * b.motion.p_FM;
  }
  for (MarkerData& m : markers_)
    if (m.body < 0) {
      const Pose& X = model_.markers[static_cast<std::size_t>(&m - markers_.data())].X_NM;
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
    joint_motion(b.type, b.axis_1, b.axis_2, q.data() + b.iq, at_rest, b.motion);
    if (M.local) M.deform(b.y);
    const Mat3 R_WM = F.s.R * b.motion.R_FM;
    const Vec3 r_M = F.s.r + F.s.R * b.motion.p_FM;
    b.A.noalias() = R_WM * M.R_B.transpose();
    b.r0.noalias() = r_M - b.A * M.p_B;
    marker_world_position(M);
    for (int k = 0; k < b.nj; ++k) {
      const Vec3 omega = F.s.R * b.motion.H.block<3, 1>(3, k);
      b.b.block<3, 1>(0, k) = F.s.R * b.motion.H.block<3, 1>(0, k) + r_M.cross(omega);
      b.b.block<3, 1>(3, k) = omega;
    }
    if (b.phi)
      for (int k = 0; k < b.nm_parent; ++k) {
        b.Phi.block<3, 1>(3, k) = F.Jw.col(k);
        b.Phi.block<3, 1>(0, k) = F.Jr.col(k) + F.s.r.cross(F.Jw.col(k));
      }
    if (b.psi)
      for (int k = 0; k < b.nm; ++k) {
        b.Psi.block<3, 1>(3, k) = M.Jw.col(k);
        b.Psi.block<3, 1>(0, k) = M.Jr.col(k) + r_M.cross(M.Jw.col(k));
      }
    for (int u = used_markers_of_body_offset_[static_cast<std::size_t>(i)];
         u < used_markers_of_body_offset_[static_cast<std::size_t>(i) + 1]; ++u) {
      MarkerData& m = mark(used_markers_[static_cast<std::size_t>(u)]);
      if (m.local) m.deform(b.y);
      marker_world_position(m);
    }
  }
  // The joint motion's bias needs velocities: `velocities` evaluates it with the configuration kept
  // in b.motion.
}

void RelativeFormulation::velocities(const VecX& v) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.yd = v.segment(b.iy, b.nm);
    MarkerData& M = mark(b.frame_M);
    const MarkerData& F = mark(b.frame_F);
    if (b.type == JointType::universal) {
      const Vec3 e1 = b.motion.H.block<3, 1>(3, 0), e2 = b.motion.H.block<3, 1>(3, 1);
      b.motion.bias.tail<3>() = v[b.iv] * v[b.iv + 1] * e1.cross(e2);
    }
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
    for (int u = used_markers_of_body_offset_[static_cast<std::size_t>(i)];
         u < used_markers_of_body_offset_[static_cast<std::size_t>(i) + 1]; ++u) {
      MarkerData& m = mark(used_markers_[static_cast<std::size_t>(u)]);
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
    for (int r = 0; r < p.rows(); ++r)
      phi_[offset + r] = rows_[static_cast<std::size_t>(offset + r)].phi;
  }
}

// ---------------------------------------------------------------------------------------------------------
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
    evaluate_force(model_, f, a, b, origin_, time_, force_reference_[k], force_states_[k]);
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

void RelativeFormulation::add_geometric(int marker, const Vec3& force) noexcept {
  const MarkerData& m = mark(marker);
  if (m.body < 0) return;
  BodyData& b = body(m.body);
  b.g_force += force;
  b.g_virial.noalias() += m.s.r * force.transpose();
  if (m.local)
    for (int k = 0; k < b.nm; ++k) b.g_modal.col(k) += m.Jr.col(k).cross(force);
}

void RelativeFormulation::project(VecX& out) noexcept {
  for (std::size_t k = order_.size(); k-- > 0;) {
    BodyData& b = body(order_[k]);
    const Vec6 hz = b.h.head<6>();
    if (b.psi) b.h.tail(b.nm).noalias() -= b.Psi.transpose() * hz;
    out.segment(b.iy, b.nm) = b.h.tail(b.nm);
    for (int j = 0; j < b.nj; ++j) out[b.iv + j] = b.b.col(j).dot(hz);
    b.wrench = hz;
    if (b.parent >= 0) {
      BodyData& p = body(b.parent);
      p.h.head<6>() += hz;
      if (b.phi) p.h.tail(p.nm).noalias() += b.Phi.transpose() * hz;
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
      if (b.phi) z.noalias() += b.Phi * p.ydd;
    }
    for (int j = 0; j < b.nj; ++j) z += b.b.col(j) * a[b.iv + j];
    if (b.psi) z.noalias() -= b.Psi * b.ydd;
    b.Zdot = z;  // without the bias D
  }
}

void RelativeFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  accelerations(a);
  for (const int i : order_) {
    BodyData& b = body(i);
    const Vec6 zdot = b.Zdot + b.D;
    b.g_force.setZero();
    b.g_virial.setZero();
    b.g_modal.setZero();
    b.h = -b.Qv;
    b.h.noalias() += b.M.leftCols<6>() * zdot;
    if (b.nm > 0) {
      b.h.noalias() += b.M.rightCols(b.nm) * b.ydd;
      const FlexibleBody& data = *model_.bodies[static_cast<std::size_t>(i)].data;
      b.h.tail(b.nm).noalias() += data.K * b.y;
      b.h.tail(b.nm).noalias() += data.D * b.yd;
    }
  }
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const WrenchRow& w = force_states_[k].wrench;
    if (f.a >= 0) {
      add_wrench(f.a, -w.Fa, -w.Ta);
      add_geometric(f.a, -w.Fa);
    }
    add_wrench(f.b, -w.Fb, -w.Tb);
    add_geometric(f.b, -w.Fb);
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
    sum_rows(k, lambda_,
             sum);  // the penalty part vanishes with convergence and would only disturb the tangent
    add_geometric(p.a, sum.Fa);
    add_geometric(p.b, sum.Fb);
  }
  project(out);
}

void RelativeFormulation::sum_rows(std::size_t part, const VecX& w, WrenchRow& sum) const noexcept {
  sum.Fa.setZero();
  sum.Ta.setZero();
  sum.Fb.setZero();
  sum.Tb.setZero();
  for (int r = 0; r < parts_[part].rows(); ++r) {
    const int i = part_offset_[part] + r;
    const WrenchRow& g = rows_[static_cast<std::size_t>(i)].gradient;
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
      const ConstraintRow& row = rows_[static_cast<std::size_t>(i)];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(a.v) + g.Ta.dot(a.w) + g.Fb.dot(b.v) + g.Tb.dot(b.w) + row.phi_t;
    }
  }
}

void RelativeFormulation::constraint_increments(const VecX&, VecX& out) noexcept {
  const auto motion = [&](int marker, Vec3& linear, Vec3& angular) {
    const MarkerData& m = mark(marker);
    linear.setZero();
    angular.setZero();
    if (m.body < 0) return;
    const BodyData& b = body(m.body);  // `solve` left the increments [Z; y] in h
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
      const WrenchRow& g = rows_[static_cast<std::size_t>(i)].gradient;
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
      const ConstraintRow& row = rows_[static_cast<std::size_t>(i)];
      const WrenchRow& g = row.gradient;
      out[i] = g.Fa.dot(aa) + g.Ta.dot(wa) + g.Fb.dot(ab) + g.Tb.dot(wb) + row.quad + row.phi_tt;
    }
  }
}

// ----------------------------------------------------------------------------------------------------------
// tangent

void RelativeFormulation::fill_gradient(const Element& e, const WrenchRow& g) noexcept {
  const auto n = static_cast<Eigen::Index>(e.columns.size());
  slots_.head(n).setZero();
  for (std::size_t k = 0; k < e.path.size(); ++k) {
    const PathEntry& p = e.path[k];
    const MarkerData& m = mark(p.marker);
    const Vec3& force = p.side_b ? g.Fb : g.Fa;
    const Vec3& torque = p.side_b ? g.Tb : g.Ta;
    double* out = slots_.data() + e.entry_slot[k];
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < p.count; ++j) {
        out[j] += m.Jr.col(j).dot(force);
        if (m.rotates) out[j] += m.Jw.col(j).dot(torque);
      }
      continue;
    }
    Vec6 f;
    f.head<3>() = force;
    f.tail<3>() = m.s.r.cross(force) + torque;
    const BodyData& b = body(p.body);
    switch (p.what) {
      case PathEntry::What::joint:
        for (int j = 0; j < p.count; ++j) out[j] += b.b.col(j).dot(f);
        break;
      case PathEntry::What::own_modes:
        for (int j = 0; j < p.count; ++j) out[j] -= b.Psi.col(j).dot(f);
        break;
      case PathEntry::What::parent_modes:
        for (int j = 0; j < p.count; ++j) out[j] += b.Phi.col(j).dot(f);
        break;
      case PathEntry::What::marker_modes:
        break;
    }
  }
}

void RelativeFormulation::add_rank_one(const Element& e, const WrenchRow& g,
                                       double weight) noexcept {
  if (weight == 0.0) return;
  fill_gradient(e, g);
  Cluster& c = clusters_[static_cast<std::size_t>(e.cluster)];
  const std::size_t n = e.columns.size();
  for (std::size_t j = 0; j < n; ++j) {
    const double w = weight * slots_[static_cast<Eigen::Index>(j)];
    if (w == 0.0) continue;
    double* column = c.front.data() + static_cast<Eigen::Index>(e.columns[j]) * c.n;
    for (std::size_t i = j; i < n; ++i)
      column[e.columns[i]] += w * slots_[static_cast<Eigen::Index>(i)];
  }
}

void RelativeFormulation::assemble_cluster(Cluster& c, double) noexcept {
  // Composite inertia inside the cluster, leaves to root (theory section 10).
  for (std::size_t k = c.bodies.size(); k-- > 0;) {
    const int i = c.bodies[k];
    BodyData& b = body(i);
    const int ij = b.iv - c.offset, iy = b.iy - c.offset;
    auto Mz = b.T.topLeftCorner<6, 6>();
    if (b.nm > 0) {
      auto N = b.T.topRightCorner(6, b.nm);
      auto Y = b.T.bottomRightCorner(b.nm, b.nm);
      if (b.psi) {  // from the body frame to marker M
        b.U.leftCols(b.nm).noalias() = Mz * b.Psi;
        Y.noalias() -= b.Psi.transpose() * N;
        Y.noalias() -= N.transpose() * b.Psi;
        Y.noalias() += b.Psi.transpose() * b.U.leftCols(b.nm);
        N -= b.U.leftCols(b.nm);
      }
      c.front.block(iy, iy, b.nm, b.nm) += Y;
      b.U.rightCols(b.nm) = N;
      b.U.bottomRightCorner(3, b.nm) += b.G_modal;
    }
    const Mat3 G_angular = b.G_virial - b.G_virial.trace() * Mat3::Identity();
    const auto geometric = [&](const auto& s) -> Vec3 {
      return s.template head<3>().cross(b.G_force) + G_angular * s.template tail<3>();
    };
    for (int j = 0; j < b.nj; ++j) {
      b.U.col(j).noalias() = Mz * b.b.col(j);
      b.U.col(j).tail<3>() += geometric(b.b.col(j));
    }
    for (int j = 0; j < b.nj; ++j) {
      // Coordinate j stands above l, but rotations of one ball have no order: symmetric part.
      const bool above = (b.type == JointType::free && j < 3) || b.type == JointType::cylindrical ||
                         b.type == JointType::universal;
      for (int l = j; l < b.nj; ++l)
        c.front(ij + l, ij + j) +=
            above ? b.b.col(j).dot(b.U.col(l))
                  : 0.5 * (b.b.col(l).dot(b.U.col(j)) + b.b.col(j).dot(b.U.col(l)));
      for (int l = 0; l < b.nm; ++l) c.front(iy + l, ij + j) += b.U.col(b.nj + l).dot(b.b.col(j));
    }
    // Couplings with everything between here and the cluster's parent.
    const int width = b.nj + b.nm;
    int current = i;
    while (true) {
      const BodyData& d = body(current);
      if (d.parent < 0) break;
      const bool inside = d.parent != c.parent;
      const BodyData& p = body(d.parent);
      if (inside) {
        const int pj = p.iv - c.offset, py = p.iy - c.offset;
        if (d.phi)
          for (int a = 0; a < p.nm; ++a)
            for (int l = 0; l < width; ++l) c.front(ij + l, py + a) += d.Phi.col(a).dot(b.U.col(l));
        for (int a = 0; a < p.nj; ++a)
          for (int l = 0; l < width; ++l) c.front(ij + l, pj + a) += p.b.col(a).dot(b.U.col(l));
        if (p.psi)
          for (int a = 0; a < p.nm; ++a)
            for (int l = 0; l < width; ++l) c.front(ij + l, py + a) -= p.Psi.col(a).dot(b.U.col(l));
        current = d.parent;
        continue;
      }
      c.front.block(c.size, ij, 6, width) += b.U;
      if (d.phi) c.front.block(c.size + 6, ij, p.nm, width).noalias() += d.Phi.transpose() * b.U;
      break;
    }
    if (b.parent < 0) continue;
    {
      BodyData& p = body(b.parent);
      p.G_force += b.G_force;
      p.G_virial += b.G_virial;
      if (b.phi)
        for (int k2 = 0; k2 < b.nm_parent; ++k2) p.G_modal.col(k2) += geometric(b.Phi.col(k2));
    }
    if (b.phi) b.MzPhi.noalias() = Mz * b.Phi;
    if (b.parent != c.parent) {
      BodyData& p = body(b.parent);
      p.T.topLeftCorner<6, 6>() += Mz;
      if (b.phi) {
        p.T.topRightCorner(6, p.nm) += b.MzPhi;
        p.T.bottomRightCorner(p.nm, p.nm).noalias() += b.Phi.transpose() * b.MzPhi;
      }
    } else {
      c.front.block<6, 6>(c.size, c.size) += Mz;
      if (b.phi) {
        c.front.block(c.size + 6, c.size, b.nm_parent, 6) += b.MzPhi.transpose();
        c.front.block(c.size + 6, c.size + 6, b.nm_parent, b.nm_parent).noalias() +=
            b.Phi.transpose() * b.MzPhi;
      }
    }
  }
}

int RelativeFormulation::factorize(double mass, double damping, double s, double alpha) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.T.noalias() = mass * b.M;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[static_cast<std::size_t>(i)].data;
      b.T.bottomRightCorner(b.nm, b.nm) += s * data.K + damping * data.D;
    }
    b.G_force = s * b.g_force;
    b.G_virial = s * b.g_virial;
    b.G_modal = s * b.g_modal;
  }
  for (Cluster& c : clusters_) c.front.setZero();
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const ForceState& f = force_states_[k];
    const Element& e = force_elements_[k];
    for (int r = 0; r < f.row_count; ++r) {
      const TangentRow& row = f.rows[r];
      const double weight = s * row.k + damping * row.c;
      if (e.cluster >= 0) {
        add_rank_one(e, row.g, weight);
      } else if (e.body >= 0) {  // a body against the ground: into its own matrix
        BodyData& b = body(e.body);
        const bool side_b = mark(e.b).body >= 0;
        const MarkerData& m = mark(side_b ? e.b : e.a);
        const Vec3& force = side_b ? row.g.Fb : row.g.Fa;
        const Vec3& torque = side_b ? row.g.Tb : row.g.Ta;
        auto g = slots_.head(6 + b.nm);
        g.head<3>() = force;
        g.segment<3>(3) = m.s.r.cross(force) + torque;
        g.tail(b.nm).setZero();
        if (m.local) {
          g.tail(b.nm).noalias() += m.Jr.transpose() * force;
          if (m.rotates) g.tail(b.nm).noalias() += m.Jw.transpose() * torque;
        }
        for (Eigen::Index j = 0; j < g.size(); ++j) b.T.col(j) += (weight * g[j]) * g;
      }
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (int r = 0; r < parts_[k].rows(); ++r)
      add_rank_one(part_elements_[k], rows_[static_cast<std::size_t>(part_offset_[k] + r)].gradient,
                   s * alpha);

  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[static_cast<std::size_t>(cluster_order_[k])];
    assemble_cluster(c, mass);
    const int failed = partial_ldlt(c.front.data(), c.n, c.n, c.size, c.original.data());
    if (failed >= 0) return c.offset + failed;
    if (c.parent >= 0) {
      BodyData& p = body(c.parent);
      const int np = c.n - c.size;
      for (int j = 0; j < np; ++j) {
        p.T(j, j) += c.front(c.size + j, c.size + j);
        for (int i = j + 1; i < np; ++i) {
          const double x = c.front(c.size + i, c.size + j);
          p.T(i, j) += x;
          p.T(j, i) += x;
        }
      }
    }
  }
  return -1;
}

void RelativeFormulation::solve(VecX& x) noexcept {
  // Leaves to root: linear terms of the minimisation 1/2 x^T T x - b^T x; body vectors h carry them
  // upwards.
  for (BodyData& b : bodies_) b.h.setZero();
  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[static_cast<std::size_t>(cluster_order_[k])];
    c.work.head(c.size) = x.segment(c.offset, c.size);
    c.work.tail(c.n - c.size).setZero();
    for (std::size_t l = c.bodies.size(); l-- > 0;) {
      BodyData& b = body(c.bodies[l]);
      const Vec6 hz = b.h.head<6>();
      if (b.psi) b.h.tail(b.nm).noalias() -= b.Psi.transpose() * hz;
      c.work.segment(b.iy - c.offset, b.nm) += b.h.tail(b.nm);
      for (int j = 0; j < b.nj; ++j) c.work[b.iv - c.offset + j] += b.b.col(j).dot(hz);
      if (b.parent < 0) continue;
      if (b.parent != c.parent) {
        BodyData& p = body(b.parent);
        p.h.head<6>() += hz;
        if (b.phi) p.h.tail(p.nm).noalias() += b.Phi.transpose() * hz;
      } else {
        c.work.segment<6>(c.size) += hz;
        if (b.phi) c.work.tail(b.nm_parent).noalias() += b.Phi.transpose() * hz;
      }
    }
    partial_forward(c.front.data(), c.n, c.n, c.size, c.work.data());
    if (c.parent >= 0) body(c.parent).h += c.work.tail(c.n - c.size);
  }
  // Root to leaves: h now holds the increments [Z; y] of each body.
  for (const int k : cluster_order_) {
    Cluster& c = clusters_[static_cast<std::size_t>(k)];
    if (c.parent >= 0) c.work.tail(c.n - c.size) = body(c.parent).h;
    partial_backward(c.front.data(), c.n, c.n, c.size, c.work.data());
    x.segment(c.offset, c.size) = c.work.head(c.size);
    for (const int i : c.bodies) {
      BodyData& b = body(i);
      Vec6 z = Vec6::Zero();
      if (b.parent >= 0) {
        const BodyData& p = body(b.parent);
        z = p.h.head<6>();
        if (b.phi) z.noalias() += b.Phi * p.h.tail(p.nm);
      }
      for (int j = 0; j < b.nj; ++j) z += b.b.col(j) * x[b.iv + j];
      b.h.tail(b.nm) = x.segment(b.iy, b.nm);
      if (b.psi) z.noalias() -= b.Psi * b.h.tail(b.nm);
      b.h.head<6>() = z;
    }
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

// Load time of the relative formulation: tree, clusters, elements, start values.
#include "floatframe/formulation/relative.hpp"

#include <algorithm>
#include <numeric>

#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

static_assert(EquationsOfMotion<RelativeFormulation>);

RelativeFormulation::RelativeFormulation(const Model& model, InertiaMethod method)
    : model_(model), topology_(find_topology(model)) {
  build_bodies(method);
  build_clusters();
  build_elements();
}
// load time

void RelativeFormulation::build_bodies(InertiaMethod method) {
  bodies_.resize(model_.bodies.size());
  for (const Topology::Link& link : topology_.links) {
    BodyData& b = body(link.body);
    const Joint& joint = model_.joints[link.joint];
    const Body& m = model_.bodies[link.body];
    b.parent = link.parent;
    b.joint = link.joint;
    b.type = joint.type;
    b.reversed = link.reversed;
    b.frame_F = link.reversed ? joint.frame_M : joint.frame_F;
    b.frame_M = link.reversed ? joint.frame_F : joint.frame_M;
    const JointKind& kind = joint_kind(joint.type);
    b.axes.axis_2 = joint.axis_2;
    if (link.reversed) {
      double position[6] = {}, velocity[6] = {};
      kind.reverse(b.axes, position, velocity);
    }
    b.nj = kind.coordinates.count();
    b.ordered = kind.rotation_vector < 0 ? b.nj : kind.rotation_vector;
    b.nm = m.modes();
    b.nm_parent = link.parent < 0 ? 0 : model_.bodies[link.parent].modes();
    const auto moves = [&](int marker) {
      const Marker& k = model_.markers[marker];
      if (k.body < 0 || k.node < 0) return false;
      const ModalNode& node = model_.bodies[k.body].data->nodes[k.node];
      return !node.X.isZero(0.0) || (k.rotates && !node.X_theta.isZero(0.0));
    };
    b.phi = link.parent >= 0 && b.nm_parent > 0 && moves(b.frame_F);
    b.psi = b.nm > 0 && moves(b.frame_M);
    b.damped = b.nm > 0 && !m.data->D.isZero(0.0);
    b.S = Mat6X::Zero(6, b.nj + b.nm);
    b.Phi = Mat6X::Zero(6, b.nm_parent);
    b.inertia = BodyInertia(*m.data, m.name, method);
    b.M = MatX::Zero(6 + b.nm, 6 + b.nm);
    b.T = b.M;
    b.Qv = VecX::Zero(6 + b.nm);
    b.h = b.Qv;
    b.y = b.yd = b.ydd = VecX::Zero(b.nm);
    b.MzPhi = Mat6X::Zero(6, b.nm_parent);
    b.U = Mat6X::Zero(6, b.nj + b.nm);
    b.G_force.setZero();
    b.G_virial.setZero();
    b.G_modal = Mat3X::Zero(3, b.nm);
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
  std::vector<int> set(n);
  std::iota(set.begin(), set.end(), 0);
  const auto find = [&](int i) {
    while (set[i] != i) i = set[i];
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
    for (std::size_t i = 1; i < pa.size(); ++i) set[find(pa[i])] = find(pa[0]);
  };
  for (const ConstraintPart& p : parts_) tie(p.a, p.b);
  for (const Force& f : model_.forces)
    if (f.a >= 0 && mark(f.a).body >= 0 && mark(f.b).body >= 0) tie(f.a, f.b);

  // Clusters in the order of their first body, which keeps parents before children; coordinates
  // cluster by cluster.
  std::vector<int> cluster_of_set(n, -1);
  for (const Topology::Link& link : topology_.links) {
    const std::size_t root = find(link.body);
    if (cluster_of_set[root] < 0) {
      cluster_of_set[root] = static_cast<int>(clusters_.size());
      clusters_.emplace_back();
    }
    clusters_[cluster_of_set[root]].bodies.push_back(link.body);
    body(link.body).cluster = cluster_of_set[root];
  }
  // A cluster found early may hang from a body of one found later: sort by depth of the parent
  // body.
  std::vector<int> depth(n, 0);
  for (const Topology::Link& link : topology_.links)
    depth[link.body] = link.parent < 0 ? 1 : depth[link.parent] + 1;
  for (Cluster& c : clusters_) {
    int best = n + 2;
    for (int i : c.bodies) {
      const int p = body(i).parent;
      if (p >= 0 && find(p) == find(i)) continue;
      const int d = p < 0 ? 0 : depth[p];
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
  std::stable_sort(cluster_order_.begin(), cluster_order_.end(),
                   [&](int a, int b) { return level[a] < level[b]; });
  for (int k : cluster_order_) {
    Cluster& c = clusters_[k];
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
    c.original = VecX::Zero(c.n);
    c.work = VecX::Zero(front_stride(c.n));
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
  const Cluster& c = clusters_[e.cluster];
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
  int last = 0;
  if (!e.path.empty()) e.first = c.n;
  for (const PathEntry& p : e.path) {
    e.first = std::min(e.first, p.front);
    last = std::max(last, p.front + p.count);
  }
  if (e.path.empty()) return e;
  e.first &= ~3;
  e.width = front_stride(last - e.first);
  return e;
}

void RelativeFormulation::build_elements() {
  int gradients = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Element e = make_element(parts_[k].a, parts_[k].b);
    e.gradient = gradients;
    gradients += e.width * parts_[k].rows();
    if (e.cluster >= 0) clusters_[e.cluster].parts.push_back(static_cast<int>(k));
    part_elements_.push_back(std::move(e));
    part_offset_.push_back(nc_);
    nc_ += parts_[k].rows();
  }
  for (Linearization& l : linearizations_) {
    for (const BodyData& b : bodies_) l.bodies.push_back({b.S, b.Phi});
    for (const Cluster& c : clusters_) l.fronts.push_back(MatX::Zero(front_stride(c.n), c.n));
    l.gradients.assign(gradients, 0.0);
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
  rows_.resize(nc_);
  force_states_.resize(model_.forces.size());
  force_reference_.assign(model_.forces.size(), 0.0);
  count_turns_from(model_, 0.0);
  kept_reference_ = force_reference_;
  for (const Input& input : model_.inputs) inputs_.push_back(input.initial);
  // The angle of a spring on a tree joint is the joint's own coordinate, whatever it turns in a
  // step.
  for (const Force& f : model_.forces) {
    int owner = -1;
    for (std::size_t i = 0; i < bodies_.size() && f.rotational; ++i) {
      const BodyData& b = bodies_[i];
      if ((b.frame_F == f.a && b.frame_M == f.b) || (b.frame_F == f.b && b.frame_M == f.a))
        owner = static_cast<int>(i);
    }
    force_tree_body_.push_back(owner);
  }
  phi_ = weights_ = lambda_ = VecX::Zero(nc_);
  std::size_t widest = 64;
  for (const Element& e : part_elements_)
    widest = std::max(widest, static_cast<std::size_t>(e.width));
  for (const Element& e : force_elements_)
    widest = std::max(widest, static_cast<std::size_t>(e.width));
  for (const BodyData& b : bodies_) widest = std::max(widest, static_cast<std::size_t>(6 + b.nm));
  slots_ = VecX::Zero(3 * static_cast<Eigen::Index>(widest));
  // Markers grouped by body; a body's own joint marker is handled with the joint.
  std::vector<char> needed(markers_.size(), 0);
  const auto need = [&](int marker) {
    if (marker >= 0) needed[marker] = 1;
  };
  for (const BodyData& b : bodies_) need(b.frame_F);
  for (const ConstraintPart& p : parts_) {
    need(p.a);
    need(p.b);
  }
  for (const Force& f : model_.forces) {
    need(f.a);
    need(f.b);
  }
  used_markers_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (std::size_t k = 0; k < markers_.size(); ++k)
      if (markers_[k].body == static_cast<int>(i) && static_cast<int>(k) != bodies_[i].frame_M) {
        used_markers_[i].all.push_back(static_cast<int>(k));
        if (needed[k]) used_markers_[i].dynamic.push_back(static_cast<int>(k));
      }
}

void RelativeFormulation::count_turns_from(const Model& values, double t) {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    force_reference_[k] = 0.0;
    if (!f.rotational) continue;
    for (const Joint& joint : values.joints) {
      if (joint.frame_F != f.a || joint.frame_M != f.b) continue;
      if (joint.motion)
        force_reference_[k] = evaluate(*joint.motion, t).f;
      else if (!joint.position.empty())
        force_reference_[k] = joint.position[0];
    }
  }
}

void RelativeFormulation::start(const Model& values, double t, VecX& q, VecX& v) {
  count_turns_from(values, t);
  q = VecX::Zero(nq_);
  v = VecX::Zero(nv_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const Joint& joint = values.joints[b.joint];
    double position[6] = {}, velocity[6] = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(b.nj); ++k) {
      if (k < joint.position.size()) position[k] = joint.position[k];
      if (k < joint.velocity.size()) velocity[k] = joint.velocity[k];
    }
    if (joint.motion && b.nj == 1) {
      const PiecewisePolynomial::Value f = evaluate(*joint.motion, t);
      position[0] = f.f;
      velocity[0] = f.df;
    }
    if (b.reversed) {
      JointDirections axes;
      joint_kind(b.type).reverse(axes, position, velocity);
    }
    joint_configuration(b.type, position, q.data() + b.iq);
    for (int k = 0; k < b.nj; ++k) v[b.iv + k] = velocity[k];
    if (joint_is_free(b.type) && b.parent < 0) v.segment<3>(b.iv) += values.simulation.velocity;
    if (b.nm > 0 && values.amplitudes[i].size() == b.nm)
      q.segment(b.iyq, b.nm) = values.amplitudes[i];
    if (b.nm > 0 && values.amplitude_rates[i].size() == b.nm)
      v.segment(b.iy, b.nm) = values.amplitude_rates[i];
  }
}

std::vector<RelativeFormulation::Given> RelativeFormulation::given_coordinates(bool rates) const {
  std::vector<Given> given(nv_, Given::no);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const Joint& joint = model_.joints[b.joint];
    if (!(rates ? joint.velocity : joint.position).empty())
      for (int k = 0; k < b.nj; ++k) given[b.iv + k] = joint.keep ? Given::kept : Given::yes;
    const VecX& amplitudes = rates ? model_.amplitude_rates[i] : model_.amplitudes[i];
    if (b.nm > 0 && amplitudes.size() == b.nm)
      for (int k = 0; k < b.nm; ++k) given[b.iy + k] = Given::yes;
  }
  return given;
}

}  // namespace floatframe

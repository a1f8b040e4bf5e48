// Load time of the relative formulation.
#include "floatframe/formulation/relative.hpp"

#include <cassert>

#include "floatframe/formulation/equations_of_motion.hpp"

namespace floatframe {

static_assert(EquationsOfMotion<RelativeFormulation>);

namespace {

/// Numbers coordinates cluster by cluster and constraint rows part by part.
std::vector<Cluster> number(TreeKinematics& tree, ConstraintSet& constraints) {
  std::vector<std::vector<int>> ties;
  for (const ConstraintPart& p : constraints.parts()) ties.push_back({p.a, p.b});
  for (const Element& e : tree.model().elements)
    if (!e.reads && bodies_of(tree, e.markers).size() > 1) ties.push_back(e.markers);
  std::vector<Cluster> clusters = find_clusters(tree, ties);
  number_coordinates(tree, clusters);
  constraints.number_rows(0);
  return clusters;
}

/// Markers used by constraints and forces.
std::vector<char> needed_markers(const Model& model, const ConstraintSet& constraints) {
  std::vector<char> needed(model.markers.size(), 0);
  for (const ConstraintPart& p : constraints.parts()) needed[p.a] = needed[p.b] = 1;
  for (const Element& e : model.elements)
    for (const int marker : e.markers) needed[marker] = 1;
  return needed;
}

/// Bodies without any mass on them or further out, and outside of all loops: their motion is
/// determined by forces and positions only.
std::vector<char> bodies_without_mass(const TreeKinematics& tree,
                                      const ConstraintSet& constraints) {
  std::vector<char> without;
  for (const Body& body : tree.model().bodies)
    without.push_back(body.data->invariants.m == 0.0 && body.data->invariants.P_u.isZero(0.0));
  for (const ConstraintPart& p : constraints.parts())
    for (const int marker : {p.a, p.b})
      if (marker >= 0 && tree.marker(marker).body >= 0) without[tree.marker(marker).body] = 0;
  const std::vector<Topology::Link>& links = tree.topology().links;
  for (auto link = links.rbegin(); link != links.rend(); ++link)
    if (link->parent >= 0 && !without[link->body]) without[link->parent] = 0;
  return without;
}

}  // namespace

RelativeFormulation::RelativeFormulation(const Model& model, InertiaMethod method)
    : Formulation(model, find_topology(model).cut_joints),
      tree_(model),
      tangent_(tree_, constraint_set_, element_set_, number(tree_, constraint_set_)),
      wrenches_(tree_.body_vectors()),
      increments_(wrenches_) {
  tree_.need_markers(needed_markers(model, constraint_set_));
  omega2_ = VecX::Zero(velocities());
  weights_ = VecX::Zero(constraints());
  projected_ = VecX::Zero(velocities());
  terms_.resize(model.bodies.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Body& body = model.bodies[i];
    const TreeBody& b = tree_.body(static_cast<int>(i));
    BodyTerms& terms = terms_[i];
    terms.inertia = BodyInertia(body, method);
    terms.M = MatX::Zero(6 + b.nm, 6 + b.nm);
    terms.Qv = VecX::Zero(6 + b.nm);
    terms.damped = b.nm > 0 && !body.data->D.isZero(0.0);
    omega2_.segment(b.iy, b.nm) = terms.inertia.own_frequencies_squared(body.data->K);
  }
  const std::vector<char> without = bodies_without_mass(tree_, constraint_set_);
  for (int i = 0; i < tree_.body_count(); ++i)
    if (without[i]) omega2_.segment(tree_.body(i).iv, tree_.body(i).nj).setConstant(no_inertia);
  // An angle of a tree joint is the joint coordinate, however far it rotates in a step.
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    for (std::size_t i = 0; i < model.elements[k].coordinates.size(); ++i) {
      const CoordinatePort& c = model.elements[k].coordinates[i];
      const int body = tree_.body_of_joint(c.joint);
      if (!c.counted || body < 0) continue;
      const TreeBody& b = tree_.body(body);
      tree_angles_.push_back(
          {element_set_.slot(k, i), b.iq + c.component, b.reversed ? -1.0 : 1.0});
    }
  element_set_.count_turns_from(model, 0.0);
  for (const TreeBody& b : tree_.bodies()) show_body(b.R_WB, b.w_WB, b.y, b.yd, b.ydd.data());
  for (std::size_t k = 0; k < model.markers.size(); ++k) {
    const TreeMarker& m = tree_.marker(static_cast<int>(k));
    show_marker(m.s, m);
  }
  connect_elements();
}

void RelativeFormulation::start(const Model& values, double t, VecX& q, VecX& v) {
  assert(values.joints.size() == model_.joints.size());
  element_set_.count_turns_from(values, t);
  tree_.start(values, t, q, v);
}

}  // namespace floatframe

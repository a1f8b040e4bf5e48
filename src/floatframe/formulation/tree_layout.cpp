// Load time of the tree: bodies and markers, numbers of coordinates, start values, owners.
#include "floatframe/formulation/tree_kinematics.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

TreeKinematics::TreeKinematics(const Model& model)
    : model_(model), topology_(find_topology(model)) {
  bodies_.resize(model_.bodies.size());
  for (const Topology::Link& link : topology_.links) {
    TreeBody& b = bodies_[link.body];
    const Joint& joint = model_.joints[link.joint];
    const JointKind& kind = joint_kind(joint.type);
    b.parent = link.parent;
    b.joint = link.joint;
    b.type = joint.type;
    b.reversed = link.reversed;
    b.frame_F = link.reversed ? joint.frame_M : joint.frame_F;
    b.frame_M = link.reversed ? joint.frame_F : joint.frame_M;
    b.axes.axis_2 = joint.axis_2;
    if (link.reversed) {
      double position[6] = {}, velocity[6] = {};
      kind.reverse(b.axes, position, velocity);
    }
    b.nj = kind.coordinates.count();
    b.ordered = kind.rotation_vector < 0 ? b.nj : kind.rotation_vector;
    b.nm = model_.bodies[link.body].modes();
    b.nm_parent = link.parent < 0 ? 0 : model_.bodies[link.parent].modes();
    b.parent_moves_F = link.parent >= 0 && b.nm_parent > 0 && moves_with_modes(b.frame_F);
    b.moves_M = b.nm > 0 && moves_with_modes(b.frame_M);
    b.own = Mat6X::Zero(6, b.nj + b.nm);
    b.of_parent = Mat6X::Zero(6, b.nm_parent);
    b.y = b.yd = b.ydd = VecX::Zero(b.nm);
  }
  markers_.resize(model_.markers.size());
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    static_cast<LocalMarker&>(markers_[i]) = LocalMarker(model_, model_.markers[i]);
    stiffens_ = stiffens_ || markers_[i].second;
    if (!markers_[i].slides) continue;
    markers_[i].s.foot = &markers_[i].slides->foot;
    sliding_.push_back(i);
  }
}

bool TreeKinematics::moves_with_modes(int marker) const {
  const Marker& m = model_.markers[marker];
  if (m.body < 0 || m.node < 0) return false;
  return LocalMarker(model_, m).local;
}

void TreeKinematics::number_coordinates(const std::vector<int>& order) {
  order_ = order;
  nq_ = nv_ = 0;
  for (const int i : order_) {
    TreeBody& b = bodies_[i];
    b.iq = nq_;
    nq_ += joint_configurations(b.type);
    b.iyq = nq_;
    nq_ += b.nm;
    b.iv = nv_;
    nv_ += b.nj;
    b.iy = nv_;
    nv_ += b.nm;
  }
}

void TreeKinematics::need_markers(std::vector<char> needed) {
  for (const TreeBody& b : bodies_) needed[b.frame_F] = 1;
  used_markers_.assign(bodies_.size(), {});
  for (int k = 0; k < static_cast<int>(markers_.size()); ++k) {
    const int i = markers_[k].body;
    if (i < 0 || k == bodies_[i].frame_M) continue;
    used_markers_[i].all.push_back(k);
    if (needed[k]) used_markers_[i].dynamic.push_back(k);
  }
}

BodyVectors TreeKinematics::body_vectors() const {
  BodyVectors x;
  for (const TreeBody& b : bodies_) x.push_back(VecX::Zero(6 + b.nm));
  return x;
}

void TreeKinematics::start(const Model& values, double t, VecX& q, VecX& v) const {
  q = VecX::Zero(nq_);
  v = VecX::Zero(nv_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const TreeBody& b = bodies_[i];
    const Joint& joint = values.joints[b.joint];
    double position[6] = {}, velocity[6] = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(b.nj); ++k) {
      if (k < joint.position.size()) position[k] = joint.position[k];
      if (k < joint.velocity.size()) velocity[k] = joint.velocity[k];
      if (const TimeFunction* motion = values.motion_of(joint, k)) {
        const PiecewisePolynomial::Value f = evaluate(*motion, t);
        position[k] = f.f;
        velocity[k] = f.df;
      }
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

std::vector<TreeKinematics::Given> TreeKinematics::given_coordinates(bool rates) const {
  std::vector<Given> given(nv_, Given::no);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const TreeBody& b = bodies_[i];
    const Joint& joint = model_.joints[b.joint];
    if (!(rates ? joint.velocity : joint.position).empty())
      for (int k = 0; k < b.nj; ++k) given[b.iv + k] = joint.keep ? Given::kept : Given::yes;
    const VecX& amplitudes = rates ? model_.amplitude_rates[i] : model_.amplitudes[i];
    if (b.nm > 0 && amplitudes.size() == b.nm)
      for (int k = 0; k < b.nm; ++k) given[b.iy + k] = Given::yes;
  }
  return given;
}

int TreeKinematics::body_of_joint(int joint) const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].joint == joint) return static_cast<int>(i);
  return -1;
}

std::vector<bool> TreeKinematics::elastic_coordinates() const {
  std::vector<bool> elastic(nv_, false);
  for (const TreeBody& b : bodies_)
    for (int k = 0; k < b.nm; ++k) elastic[b.iy + k] = true;
  return elastic;
}

std::vector<int> TreeKinematics::free_translations() const {
  std::vector<int> indices;
  for (const TreeBody& b : bodies_)
    if (joint_is_free(b.type) && b.parent < 0)
      indices.insert(indices.end(), {b.iq, b.iq + 1, b.iq + 2});
  return indices;
}

std::string TreeKinematics::coordinate_owner(int i) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const TreeBody& b = bodies_[k];
    if (i >= b.iv && i < b.iv + b.nj) return "joint '" + model_.joints[b.joint].name + "'";
    if (i >= b.iy && i < b.iy + b.nm)
      return "mode " + std::to_string(i - b.iy + 1) + " of body '" + model_.bodies[k].name + "'";
  }
  return "coordinate " + std::to_string(i);
}

}  // namespace floatframe

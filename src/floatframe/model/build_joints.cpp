// Joints of the description, and the free joints of bodies without one.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

/// The direction of a line through p_WP about which a body has no inertia, in world axes: a bar
/// without section inertia. Zero if there is none.
Vec3 line_of_mass(const Body& body, const Vec3& p_WP) {
  constexpr double no_inertia = 1e-6;  // a radius of gyration of a thousandth of the length
  const InertiaInvariants& I = body.data->invariants;
  const Vec3 p_BP = body.X_WB.R.transpose() * (p_WP - body.X_WB.p);
  const Mat3 moved = p_BP * I.m_u.transpose();
  const SymmetricEigen eig =
      symmetric_eigen(I.P_u - moved - moved.transpose() + I.m * p_BP * p_BP.transpose());
  const VecX& P = eig.values;
  if (P[0] + P[1] > no_inertia * P[2]) return Vec3::Zero();
  return body.X_WB.R * eig.vectors.col(2);
}

/// A universal joint as the only joint of a body without inertia about a line through it. Where the
/// line enters the plane of the two axes, the mass matrix of the joint's angles is singular and
/// their rates are unbounded; position and rotation of the body have no singularity.
bool turns_without_inertia(const Model& model, const Joint& joint) {
  constexpr double near_plane = 0.5;  // within 30 degrees
  const bool universal =
      joint_kind(joint.type).axes == JointAxes::two && joint_velocities(joint.type) == 2;
  if (!universal) return false;
  const Pose X_WF = design_pose(model, joint.frame_F);
  const Vec3 normal = (X_WF.R * Vec3::UnitZ().cross(joint.axis_2)).normalized();
  return std::ranges::any_of(std::array{joint.parent, joint.child}, [&](int body) {
    if (body < 0) return false;
    const auto holds = [body](const Joint& j) { return j.parent == body || j.child == body; };
    if (std::ranges::count_if(model.joints, holds) > 1) return false;
    const Vec3 line = line_of_mass(model.bodies[body], X_WF.p);
    return line != Vec3::Zero() && std::abs(line.dot(normal)) < near_plane;
  });
}

}  // namespace

Mat3 joint_frame(const JointDescription& joint) {
  return joint_kind(joint.type).axes == JointAxes::none ? Mat3::Identity().eval()
                                                        : frame_with_z(unit_vector(joint.axis));
}

void ModelBuilder::joints() {
  for (const JointDescription& j : d.joints) {
    const std::string who = "joints." + j.name;
    Joint joint;
    joint.name = j.name;
    joint.type = j.type;
    joint.position = j.position;
    joint.velocity = j.velocity;
    joint.keep = j.keep;
    joint.cut = j.cut;
    joint.parent = body_index(j.parent.body);
    joint.child = body_index(j.child.body);
    const JointKind& kind = joint_kind(j.type);
    const Mat3 R = joint_frame(j);
    if (kind.axes == JointAxes::two) joint.axis_2 = R.transpose() * unit_vector(j.axis_2);
    joint.frame_F = add_marker(j.parent, R, kind.oriented, j.origin.of("at"), who, "parent_node");
    joint.frame_M = add_marker(j.child, R, kind.oriented, j.origin.of("at"), who, "child_node");
    if (joint.frame_F < 0 || joint.frame_M < 0) continue;
    joint_names.add(joint.name);
    model.joints.push_back(std::move(joint));
  }
}

void ModelBuilder::free_joints() {
  for (Joint& j : model.joints) j.cut = j.cut || turns_without_inertia(model, j);
  std::vector<char> reached(model.bodies.size(), 0);
  std::vector<std::vector<int>> neighbours(model.bodies.size());
  std::vector<int> next;
  const auto reach = [&](int body) {
    if (std::exchange(reached[body], 1) == 0) next.push_back(body);
  };
  const auto spread = [&] {
    while (!next.empty()) {
      const int body = next.back();
      next.pop_back();
      for (const int other : neighbours[body]) reach(other);
    }
  };
  for (const Joint& j : model.joints) {
    if (j.cut) continue;
    if (j.parent < 0) {
      reach(j.child);
      continue;
    }
    neighbours[j.parent].push_back(j.child);
    neighbours[j.child].push_back(j.parent);
  }
  spread();
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (reached[i]) continue;
    const Body& b = model.bodies[i];
    Joint joint;
    joint.name = b.name + ".free";
    joint.type = JointType::free;
    joint.child = static_cast<int>(i);
    joint.automatic = true;
    Marker ground;
    ground.X_NM = {b.X_WB.p, Mat3::Identity()};
    joint.frame_F = static_cast<int>(model.markers.size());
    model.markers.push_back(ground);
    Marker own;
    own.body = static_cast<int>(i);
    own.X_NM.R = b.X_WB.R.transpose();
    joint.frame_M = static_cast<int>(model.markers.size());
    model.markers.push_back(own);
    model.joints.push_back(std::move(joint));
    reach(static_cast<int>(i));
    spread();
  }
}

}  // namespace floatframe

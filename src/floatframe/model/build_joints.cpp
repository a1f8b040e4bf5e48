// Joints of the description, and the free joints that bodies without one hang from.
#include <set>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

Mat3 frame_with_z(const Vec3& axis) {
  Vec3 x, y;
  const Vec3 z = axis.normalized();
  orthonormal_complement(z, x, y);
  Mat3 R;
  R << x, y, z;
  return R;
}

}  // namespace

void ModelBuilder::joints() {
  std::set<std::string> names;
  for (const JointDescription& j : d.joints) {
    const std::string who = "joints." + j.name;
    if (!names.insert(j.name).second)
      faults.add(j.origin.mark, who + ": the name is taken, expected a name used once");
    Joint joint;
    joint.name = j.name;
    joint.type = j.type;
    joint.position = j.position;
    joint.velocity = j.velocity;
    joint.motion = j.motion;
    joint.cut = j.cut;
    joint.parent = body_index(j.parent.body, j.origin.of("parent"), who + ".parent");
    joint.child = body_index(j.child.body, j.origin.of("child"), who + ".child");
    if (joint.parent == unknown || joint.child == unknown) continue;
    if (joint.child == ground_index) {
      faults.add(j.origin.of("child"),
                 who + ".child: found ground, expected a body (ground may be the parent)");
      continue;
    }
    if (joint.parent == joint.child) {
      faults.add(j.origin.mark, who + ": found parent and child on the same body '" + j.child.body +
                                    "', expected two bodies");
      continue;
    }
    const bool ball = j.type == JointType::spherical || j.type == JointType::free;
    Mat3 R = ball || j.type == JointType::weld ? Mat3::Identity().eval() : frame_with_z(j.axis);
    if (!ball && j.type != JointType::weld && !(j.axis.norm() > 0.0)) {
      faults.add(j.origin.of("axis"),
                 who + ".axis: found a vector of length zero, expected a direction");
      R.setIdentity();
    }
    if (j.type == JointType::universal) {
      if (!(j.axis.cross(j.axis_2).norm() > 1e-6 * j.axis.norm() * j.axis_2.norm()))
        faults.add(j.origin.of("axis_2"),
                   who + ".axis_2: found a direction parallel to axis, expected another");
      else
        joint.axis_2 = R.transpose() * j.axis_2.normalized();
    }
    const auto nv = static_cast<std::size_t>(joint_velocities(j.type));
    for (const auto* list : {&j.position, &j.velocity})
      if (!list->empty() && list->size() != nv)
        faults.add(j.origin.mark, who + ": found " + std::to_string(list->size()) +
                                      " start values, expected " + std::to_string(nv) + " for a " +
                                      joint_type_name(j.type) + " joint");
    if (j.motion && j.type != JointType::revolute && j.type != JointType::prismatic)
      faults.add(j.origin.of("motion"), who + ".motion: found on a " + joint_type_name(j.type) +
                                            " joint, expected a revolute or prismatic joint");
    joint.frame_F = add_marker(j.parent, R, !ball, j.origin.of("at"), who);
    joint.frame_M = add_marker(j.child, R, !ball, j.origin.of("at"), who);
    if (joint.frame_F < 0 || joint.frame_M < 0) continue;
    model.joints.push_back(std::move(joint));
  }
}

void ModelBuilder::free_joints() {
  std::vector<char> reached(model.bodies.size(), 0);
  const auto spread = [&] {
    for (bool more = true; more;) {
      more = false;
      for (const Joint& j : model.joints) {
        if (j.cut) continue;
        const bool p = j.parent < 0 || reached[static_cast<std::size_t>(j.parent)];
        const bool c = reached[static_cast<std::size_t>(j.child)];
        if (p == c) continue;
        reached[static_cast<std::size_t>(p ? j.child : j.parent)] = 1;
        more = true;
      }
    }
  };
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
    reached[i] = 1;
    spread();
  }
}

}  // namespace floatframe

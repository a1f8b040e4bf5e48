// The constraint parts of every joint type, of prescribed motions and of rods.
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

using Kind = ConstraintPart::Kind;

void append_joint_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[static_cast<std::size_t>(index)];
  const double length = model.bodies[static_cast<std::size_t>(joint.child)].length;
  ConstraintPart base;
  base.a = joint.frame_F;
  base.b = joint.frame_M;
  base.owner = {ConstraintOwner::Kind::joint, index};
  const auto add = [&](Kind kind) {
    ConstraintPart p = base;
    p.kind = kind;
    parts.push_back(p);
  };
  const auto add_perpendicular = [&](const Vec3& e_a, const Vec3& n_b, double c) {
    ConstraintPart p = base;
    p.kind = Kind::perpendicular;
    p.e_a = e_a;
    p.n_b = n_b;
    p.c = c;
    p.scale = length;
    parts.push_back(p);
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  switch (joint.type) {
    case JointType::weld:
      add(Kind::coincident);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      add_perpendicular(x, y, 0.0);
      break;
    case JointType::revolute:
      add(Kind::coincident);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      break;
    case JointType::prismatic:
      add(Kind::in_line);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      add_perpendicular(x, y, 0.0);
      break;
    case JointType::cylindrical:
      add(Kind::in_line);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      break;
    case JointType::universal:
      add(Kind::coincident);
      add_perpendicular(z, joint.axis_2, joint.axis_2.z());
      break;
    case JointType::spherical:
      add(Kind::coincident);
      break;
    case JointType::free:
      break;
  }
}

void append_motion_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[static_cast<std::size_t>(index)];
  if (!joint.motion) return;
  ConstraintPart p;
  p.kind = joint.type == JointType::prismatic ? Kind::drive_position : Kind::drive_angle;
  p.a = joint.frame_F;
  p.b = joint.frame_M;
  p.scale = p.kind == Kind::drive_angle ? model.bodies[static_cast<std::size_t>(joint.child)].length
                                        : 1.0;
  p.motion = &*joint.motion;
  p.owner = {ConstraintOwner::Kind::joint, index};
  parts.push_back(p);
}

void append_rod_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Rod& rod = model.rods[static_cast<std::size_t>(index)];
  ConstraintPart p;
  p.kind = Kind::distance;
  p.a = rod.a;
  p.b = rod.b;
  p.scale = rod.length;
  p.owner = {ConstraintOwner::Kind::rod, index};
  parts.push_back(p);
}

std::string owner_name(const Model& model, const ConstraintOwner& owner) {
  const auto i = static_cast<std::size_t>(owner.index);
  if (owner.kind == ConstraintOwner::Kind::rod) return "rod '" + model.rods[i].name + "'";
  return "joint '" + model.joints[i].name + "'";
}

}  // namespace floatframe

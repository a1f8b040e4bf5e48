// The constraint parts of joints and of elements.
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

JointParts::JointParts(const Joint& joint, int index, double length,
                       std::vector<ConstraintPart>& parts)
    : axis_2_(joint.axis_2), length_(length), parts_(parts) {
  assert(length > 0.0 && joint.frame_F >= 0 && joint.frame_M >= 0);
  base_.a = joint.frame_F;
  base_.b = joint.frame_M;
  base_.owner.joint = index;
}

ConstraintPart& JointParts::add(ConstraintType type) {
  parts_.push_back(base_);
  parts_.back().type = type;
  return parts_.back();
}

void JointParts::perpendicular(const Vec3& e_F, const Vec3& n_M, double c) {
  assert(is_unit(e_F) && is_unit(n_M) && std::abs(c) <= 1.0);
  ConstraintPart& p = add(ConstraintType::perpendicular);
  p.e_a = e_F;
  p.n_b = n_M;
  p.c = c;
  p.scale = length_;
}

void append_joint_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[index];
  const double length = model.bodies[joint.child].length;
  JointParts collected(joint, index, length, parts);
  joint_kind(joint.type).parts(collected);
}

void append_element_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Element& element = model.elements[index];
  if (!element.holds) return;
  ConstraintPart part;
  part.owner.element = index;
  const std::size_t before = parts.size();
  element_kind(element.type).rows(model, element, part, parts);
  // What holds coordinates of joints is one row, of several parts; what holds markers has any rows
  // between the first two. Multipliers are found from the wrench of these by what reads them.
  for (std::size_t k = before; k < parts.size(); ++k) {
    assert(element.links() || (parts[k].rows() == 1 && parts[k].continues == (k > before)));
    assert(!element.links() || (parts[k].owner.joint < 0 && !parts[k].continues));
    assert(!element.links() ||
           (parts[k].a == element.markers[0] && parts[k].b == element.markers[1]));
  }
  static_cast<void>(before);
}

std::string element_name(const Element& element) {
  return std::string(element_type_name(element.type)) + " '" + element.name + "'";
}

std::string owner_name(const Model& model, const ConstraintOwner& owner) {
  const bool of_joint =
      owner.joint >= 0 &&
      (owner.element < 0 ||
       element_kind(model.elements[owner.element].type).list == ElementList::motions);
  if (of_joint) return "joint '" + model.joints[owner.joint].name + "'";
  return element_name(model.elements[owner.element]);
}

}  // namespace floatframe

// Prescribed motion: the coordinate of a joint that has only one is a function of time f(t): one
// row `drive_angle` or `drive_position` between the markers of the joint, which owns it: the wrench
// of the joint includes that of the motion. It is drawn as its joint.
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(motion)

namespace {

constexpr ElementKey motion_keys[] = {{.name = "joint",
                                       .kind = KeyKind::joint,
                                       .about = "one with one coordinate",
                                       .required = true,
                                       .member = described_by<&PrescribedMotion::joint>},
                                      {.name = "motion",
                                       .kind = KeyKind::target,
                                       .about = "of its coordinate",
                                       .required = true,
                                       .axis = ElementAxis::coordinate,
                                       .member = described_by<&PrescribedMotion::motion>}};

bool motion_build(ElementBuild& build) {
  if (!build.connect_coordinate(build.text("joint"))) return false;
  build.element.coordinates[0].counted = false;  // its row is one within half a turn
  return true;
}

void motion_rows(const Model& model, const Element& element, ConstraintPart part,
                 std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[element.coordinates[0].joint];
  part.owner.joint = element.coordinates[0].joint;
  assert(joint_has_one_coordinate(joint.type));
  part.type = element.rotational ? ConstraintType::drive_angle : ConstraintType::drive_position;
  part.a = element.markers[0];
  part.b = element.markers[1];
  if (element.rotational) part.scale = model.bodies[joint.child].length;
  part.force = -part.scale;
  part.motion = &element.signals[0].function;
  parts.push_back(part);
}

constexpr ElementRegime motion_regimes[] = {{.name = "anywhere", .acts = false}};

ElementExample motion_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  PrescribedMotion motion;
  motion.motion = x.signal(numbers);
  motion.motion.input.clear();
  x.keys(motion);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

}  // namespace

constinit const ElementKind motion_element = {
    .about = "prescribes the coordinate of a joint",
    .keys = motion_keys,
    .list = ElementList::motions,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(PrescribedMotion()); },
    .build = motion_build,
    .rows = motion_rows,
    .regimes = motion_regimes,
    .example = motion_example};

}  // namespace floatframe

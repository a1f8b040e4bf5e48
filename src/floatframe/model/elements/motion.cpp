// Prescribed motion: a coordinate of a joint is a function of time f(t): one row `drive_position`,
// `drive_angle` (about the z axis that the markers share) or `drive_axis_angle` (about one of two
// axes) between the markers of the joint, which owns it: the wrench of the joint includes that of
// the motion. It is drawn as its joint. Components of rotation vectors are no such coordinates.
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(motion)

namespace {

constexpr ElementKey motion_keys[] = {{.name = "joint",
                                       .kind = KeyKind::joint,
                                       .about = "one with a coordinate",
                                       .required = true,
                                       .member = described_by<&PrescribedMotion::joint>},
                                      {.name = "motion",
                                       .kind = KeyKind::target,
                                       .about = "of its coordinate",
                                       .required = true,
                                       .axis = ElementAxis::coordinate,
                                       .member = described_by<&PrescribedMotion::motion>}};

bool motion_build(ElementBuild& build) {
  const int coordinate = build.keys<PrescribedMotion>().coordinate;
  if (!build.connect_coordinate(build.text("joint"), coordinate)) return false;
  build.element.coordinates[0].counted = false;  // its row is one within half a turn
  return true;
}

void motion_rows(const Model& model, const Element& element, ConstraintPart part,
                 std::vector<ConstraintPart>& parts) {
  const auto [number, component, port, counted] = element.coordinates[0];
  const Joint& joint = model.joints[number];
  part.owner.joint = number;
  assert(!is_of_rotation_vector(joint.type, component));
  JointMotion drawn;
  const double q[7] = {0.0, 0.0, 0.0,
                       1.0};  // of all joints without a quaternion zero is the design
  joint_motion(joint.type, {Vec3::UnitZ(), joint.axis_2}, joint_is_free(joint.type) ? q : q + 4,
               drawn);
  part.type = ConstraintType::drive_position;
  part.e_a = drawn.H.col(component).head<3>();
  if (element.rotational) {
    const bool common = coordinate_axis(joint.type, joint.axis_2, component).has_value();
    part.type = common ? ConstraintType::drive_angle : ConstraintType::drive_axis_angle;
    part.e_a = Vec3::UnitZ();
    part.n_b = joint.axis_2;
    part.c = component == 0 ? 1.0 : -1.0;
  }
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
    .regimes = motion_regimes};

constinit const ExampleMaker motion_examples = motion_example;

}  // namespace floatframe

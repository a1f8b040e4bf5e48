// Screw: the displacement is the lead times the turns,
//   x - (lead / 2 pi) q = 0:                                                                   (1)
// one row (coupled_coordinates.hpp), whose force is that along the screw. The coordinates are those
// of two joints, or both of one, about and along one axis: a lead above zero is a right-hand screw.
#include <numbers>

#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(screw)

namespace {

constexpr ElementKey screw_keys[] = {
    coordinate_key("joint", "one with both coordinates: cylindrical",
                   described_by<&ScrewDrive::joint>, ElementAxis::about, false),
    coordinate_key("translation", "instead of `joint`: of what is moved along",
                   described_by<&ScrewDrive::translation>, ElementAxis::along, false),
    coordinate_key("rotation", "of what turns", described_by<&ScrewDrive::rotation>,
                   ElementAxis::about, false),
    {.name = "lead",
     .kind = KeyKind::number,
     .about = "displacement per turn, not 0; negative: it falls while the angle grows, a left-hand "
              "screw",
     .required = true,
     .rule = any_number("m"),
     .member = described_by<&ScrewDrive::lead>}};

/// The only displacement of a joint that turns, too; -1: it has none.
int screw_displacement(JointType type) { return coupled_component(type, -1, ElementAxis::along); }

void screw_validate(const ElementCheck& check) {
  const bool both = check.has("translation") && check.has("rotation");
  const bool joint = check.has("joint"), some = check.has("translation") || check.has("rotation");
  if (check.wrong.empty() && (joint ? some : !both))
    check.error(joint ? ErrorCode::exclusive : ErrorCode::missing, joint ? "joint" : "",
                joint ? "excludes 'translation' and 'rotation'; remove it or both"
                      : "found no 'joint', expected it or both of 'translation' and 'rotation'");
  if (check.good("lead") && check.number("lead") == 0.0)
    check.error(ErrorCode::out_of_range, "lead", "found 0, expected a number other than 0 [m]");
  if (!validate_coordinates(check) || !joint) return;
  const std::string name = check.coordinate("joint").joint;
  const auto type = check.joint_type(name);
  if (type && screw_displacement(*type) < 0)
    check.error(ErrorCode::wrong_value, "joint",
                "found joint '" + check.written(name) + "', a " + joint_type_name(*type) +
                    " joint, expected a cylindrical joint, or 'translation' and 'rotation'");
}

bool screw_build(ElementBuild& build) {
  const double slope = build.keys<ScrewDrive>().lead / (2.0 * std::numbers::pi);
  double along = 1.0, about = 1.0;
  if (build.has("joint")) {
    const std::string name = build.coordinate("joint").joint;
    const Joint* joint = build.joint(name);
    if (!joint || !build.connect_coordinate(name, screw_displacement(joint->type)) ||
        !connect_coupled(build, "joint"))
      return false;
    about = mirrored_sense(build, "joint");
  } else {
    if (!connect_coupled(build, "translation") || !connect_coupled(build, "rotation")) return false;
    along = mirrored_sense(build, "translation");
    about = mirrored_sense(build, "rotation");
  }
  build.element.data = std::make_shared<CoupledSum>(CoupledSum{{along, -about * slope}});
  return true;
}

ElementExample screw_example(std::size_t, ExampleNumbers& numbers) {
  ScrewDrive screw;
  screw.rotation = CoordinateTerm{"a"};
  screw.translation = CoordinateTerm{"b"};
  screw.lead = numbers(0.1, 0.3);
  return coupled_example(std::move(screw), 2, numbers);
}

/// A thread on what turns; its turns are as many as can be seen.
std::vector<Stroke> screw_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const double size = out.size(out.child(1));
  out.thread(out.child(1), out.axis(1), 0.15 * size, size,
             std::get<ScrewDrive>(*element.keys).lead < 0.0);
  return out.take();
}

}  // namespace

constinit const ElementKind screw_element = {
    .about =
        "a displacement is the lead times the turns, without friction: it is driven from "
        "either end. A force along and a torque about the axis",
    .keys = screw_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(ScrewDrive()); },
    .validate = screw_validate,
    .build = screw_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .strokes = screw_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker screw_examples = screw_example;

}  // namespace floatframe

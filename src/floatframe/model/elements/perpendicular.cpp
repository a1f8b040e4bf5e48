// Perpendicular: a direction fixed in the body of `from` and one fixed in that of `to` keep a right
// angle: the row `perpendicular` between z of both markers. The torque acts along the common normal
// of both. Directions that are drawn at another angle are turned at the start.
#include "floatframe/model/axis_constraint.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(perpendicular)

namespace {

constexpr ElementKey perpendicular_keys[] = {
    constraint_from_key<Perpendicular>("on the first body"),
    constraint_to_key<Perpendicular>("on the second body"),
    constraint_axis_key<Perpendicular>("fixed in the body of `from`"),
    constraint_axis_2_key("fixed in the body of `to`; normal to `axis`",
                          described_by<&Perpendicular::axis_2>)};

void perpendicular_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  if (!check.good("axis") || !check.good("axis_2")) return;
  if (const auto complaint =
          sentences::second_axis(check.direction("axis"), check.direction("axis_2")))
    check.error(ErrorCode::geometry, "axis_2", *complaint);
}

bool perpendicular_build(ElementBuild& build) {
  return build_constraint(build, constraint_axes(build, "axis"), constraint_axes(build, "axis_2"),
                          true);
}

void perpendicular_rows(const Model& model, const Element& element, ConstraintPart part,
                        std::vector<ConstraintPart>& parts) {
  ConstraintParts(model, element, part, parts)
      .add_directions(ConstraintType::perpendicular, Vec3::UnitZ(), Vec3::UnitZ());
}

ElementExample perpendicular_example(std::size_t, ExampleNumbers& numbers) {
  return constraint_example<Perpendicular>(numbers);
}

}  // namespace

constinit const ElementKind perpendicular_element = {
    .about = "directions of two bodies keep a right angle: one row",
    .keys = perpendicular_keys,
    .list = ElementList::constraints,
    .axis = ElementAxis::about,
    .blank = [] { return ElementKeys(Perpendicular()); },
    .validate = perpendicular_validate,
    .build = perpendicular_build,
    .rows = perpendicular_rows,
    .picture = picture_of_constraint,
    .regimes = constraint_regimes};

constinit const ExampleMaker perpendicular_examples = perpendicular_example;

}  // namespace floatframe

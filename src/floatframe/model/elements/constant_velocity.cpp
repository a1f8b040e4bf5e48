// Constant velocity: two shafts whose axes meet turn by the same angle, however they are inclined:
// three rows `coincident` for the points, and the row `constant_velocity`. Of a joint that slides
// (plunging) that row alone: its shafts are held by bearings of their own. As drawn the second
// marker is the first one tilted from `axis` to `axis_2`, about their common normal.
#include <fmt/format.h>

#include "floatframe/model/axis_constraint.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(constant_velocity)

namespace {

constexpr ElementKey constant_velocity_keys[] = {
    constraint_from_key<ConstantVelocity>("the centre of the joint, on the first shaft"),
    constraint_to_key<ConstantVelocity>("the centre of the joint, on the second shaft"),
    constraint_axis_key<ConstantVelocity>("of the first shaft"),
    constraint_axis_2_key("of the second shaft, less than a right angle from `axis`",
                          described_by<&ConstantVelocity::axis_2>),
    {.name = "slides",
     .kind = KeyKind::flag,
     .about = "the points may move apart",
     .member = described_by<&ConstantVelocity::slides>}};

void constant_velocity_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  if (!check.good("axis") || !check.good("axis_2")) return;
  const Vec3 z = check.direction("axis").stableNormalized(),
             z_2 = check.direction("axis_2").stableNormalized();
  if (!(z.dot(z_2) > 1e-6))
    check.error(ErrorCode::geometry, "axis_2",
                fmt::format("found a direction at {:.4g} rad from 'axis', expected less than a "
                            "right angle (a shaft has two directions)",
                            std::acos(std::clamp(z.dot(z_2), -1.0, 1.0))));
}

bool constant_velocity_build(ElementBuild& build) {
  const Mat3 R = constraint_axes(build, "axis");
  const Vec3 z = R.col(2), z_2 = unit_vector(build.direction("axis_2"));
  const Vec3 c = z.cross(z_2);
  const double s = c.norm();
  Mat3 R_2 = R;
  if (s > 0.0) R_2 = rotation_exp(c * (std::atan2(s, z.dot(z_2)) / s)) * R;
  return build_constraint(build, R, R_2, true);
}

void constant_velocity_rows(const Model& model, const Element& element, ConstraintPart part,
                            std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  if (!std::get<ConstantVelocity>(*element.keys).slides) of.add(ConstraintType::coincident);
  of.add_directions(ConstraintType::constant_velocity, Vec3::UnitZ(), Vec3::UnitZ());
}

ElementExample constant_velocity_example(std::size_t, ExampleNumbers& numbers) {
  return constraint_example<ConstantVelocity>(numbers);
}

}  // namespace

constinit const ElementKind constant_velocity_element = {
    .about = "two shafts that meet turn by the same angle: four rows, or one if the joint slides",
    .keys = constant_velocity_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(ConstantVelocity()); },
    .validate = constant_velocity_validate,
    .build = constant_velocity_build,
    .rows = constant_velocity_rows,
    .picture = picture_of_constraint,
    .regimes = constraint_regimes};

constinit const ExampleMaker constant_velocity_examples = constant_velocity_example;

}  // namespace floatframe

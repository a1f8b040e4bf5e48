// Parallel: an axis that both bodies carry as drawn stays parallel in both: with z of both markers
// along it, z_a is normal to x_b and to y_b, two rows `perpendicular`. The bodies may still turn
// about the axis and move in all directions.
#include "floatframe/model/axis_constraint.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(parallel)

namespace {

constexpr ElementKey parallel_keys[] = {
    constraint_from_key<Parallel>("on the first body"),
    constraint_to_key<Parallel>("on the second body"),
    constraint_axis_key<Parallel>("of both bodies as drawn, which stays parallel")};

bool parallel_build(ElementBuild& build) {
  const Mat3 R = constraint_axes(build, "axis");
  return build_constraint(build, R, R, true);
}

void parallel_rows(const Model& model, const Element& element, ConstraintPart part,
                   std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  for (const Vec3& n : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    of.add_directions(ConstraintType::perpendicular, Vec3::UnitZ(), n);
}

ElementExample parallel_example(std::size_t, ExampleNumbers& numbers) {
  return constraint_example<Parallel>(numbers);
}

}  // namespace

constinit const ElementKind parallel_element = {
    .about = "an axis of two bodies stays parallel: two rows",
    .keys = parallel_keys,
    .list = ElementList::constraints,
    .axis = ElementAxis::about,
    .blank = [] { return ElementKeys(Parallel()); },
    .validate = validate_constraint,
    .build = parallel_build,
    .rows = parallel_rows,
    .picture = picture_of_constraint,
    .regimes = constraint_regimes};

constinit const ExampleMaker parallel_examples = parallel_example;

}  // namespace floatframe

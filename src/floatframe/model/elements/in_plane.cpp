// In plane: the point of `to` stays in the plane through the point of `from` whose normal turns
// with the body of `from`: the row `in_plane`, z of the first marker along the normal. The force is
// that along the normal on the body of `from`.
#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(in_plane)

namespace {

constexpr ElementKey in_plane_keys[] = {
    constraint_from_key<InPlane>("a point of the plane"),
    constraint_to_key<InPlane>("the point that stays in the plane"),
    constraint_axis_key<InPlane>("normal to the plane, fixed in the body of `from`")};

bool in_plane_build(ElementBuild& build) {
  return build_constraint(build, constraint_axes(build, "axis"), Mat3::Identity(), false);
}

void in_plane_rows(const Model& model, const Element& element, ConstraintPart part,
                   std::vector<ConstraintPart>& parts) {
  ConstraintParts(model, element, part, parts).add(ConstraintType::in_plane);
}

ElementExample in_plane_example(std::size_t, ExampleNumbers& numbers) {
  return constraint_example<InPlane>(numbers);
}

std::vector<Stroke> in_plane_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const int a = element.markers[0];
  out.square(a, Vec3::UnitZ(), 0.2 * std::max(out.size(a), out.size(element.markers[1])));
  return out.take();
}

}  // namespace

constinit const ElementKind in_plane_element = {
    .about = "a point stays in a plane of another body: one row",
    .keys = in_plane_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(InPlane()); },
    .validate = validate_constraint,
    .build = in_plane_build,
    .rows = in_plane_rows,
    .picture = picture_of_constraint,
    .strokes = in_plane_strokes,
    .regimes = constraint_regimes};

constinit const ExampleMaker in_plane_examples = in_plane_example;

}  // namespace floatframe

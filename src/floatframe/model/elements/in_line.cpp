// In line: the point of `to` stays on the line through the point of `from` along an axis that turns
// with the body of `from`: the two rows `in_line`, z of the first marker along the axis.
#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(in_line)

namespace {

constexpr ElementKey in_line_keys[] = {
    constraint_from_key<InLine>("a point of the line"),
    constraint_to_key<InLine>("the point that stays on the line"),
    constraint_axis_key<InLine>("along the line, fixed in the body of `from`")};

bool in_line_build(ElementBuild& build) {
  return build_constraint(build, constraint_axes(build, "axis"), Mat3::Identity(), false);
}

void in_line_rows(const Model& model, const Element& element, ConstraintPart part,
                  std::vector<ConstraintPart>& parts) {
  ConstraintParts(model, element, part, parts).add(ConstraintType::in_line);
}

ElementExample in_line_example(std::size_t, ExampleNumbers& numbers) {
  return constraint_example<InLine>(numbers);
}

std::vector<Stroke> in_line_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const int a = element.markers[0];
  const Vec3 half = 2.0 * std::max(out.size(a), out.size(element.markers[1])) * Vec3::UnitZ();
  out.line(a, -half, half);
  return out.take();
}

}  // namespace

constinit const ElementKind in_line_element = {
    .about = "a point stays on a line of another body: two rows",
    .keys = in_line_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(InLine()); },
    .validate = validate_constraint,
    .build = in_line_build,
    .rows = in_line_rows,
    .on_line = true,
    .picture = picture_of_constraint,
    .strokes = in_line_strokes,
    .regimes = constraint_regimes};

constinit const ExampleMaker in_line_examples = in_line_example;

}  // namespace floatframe

// Point on a curve: a point of one body stays on a curve that is fixed in another one: the two rows
// `on_curve`. The curve is given from the point of `from` along the axes of the world as drawn.
#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/curve_keys.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(point_on_curve)

namespace {

constexpr ElementKey point_on_curve_keys[] = {
    place_key("from", "on the body that carries the curve, which is given from here",
              described_by<&PointOnCurve::a>),
    place_key("to", "the point that stays on the curve", described_by<&PointOnCurve::b>),
    curve_points_key("points", described_by<&PointOnCurve::points>),
    curve_formula_key("x", "instead of points: their x over a parameter; 0 without it",
                      described_by<&PointOnCurve::x>),
    curve_formula_key("y", "the same of y", described_by<&PointOnCurve::y>),
    curve_formula_key("z", "the same of z", described_by<&PointOnCurve::z>),
    curve_range_key("range", described_by<&PointOnCurve::range>),
    curve_closed_key("closed", described_by<&PointOnCurve::closed>)};

void point_on_curve_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  validate_curve(check, "");
}

bool point_on_curve_build(ElementBuild& build) {
  if (!build_constraint(build, Mat3::Identity(), Mat3::Identity(), false)) return false;
  const std::optional<SpaceCurve> curve = build_curve(build, build.keys<PointOnCurve>());
  if (!curve) return false;
  build.element.data = std::make_shared<const SpaceCurve>(*curve);
  return true;
}

void point_on_curve_rows(const Model& model, const Element& element, ConstraintPart part,
                         std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  of.add(ConstraintType::on_curve).curve = &data_of<SpaceCurve>(element);
}

void point_on_curve_mirror(ElementDescription& element, const Placement& x) {
  PointOnCurve& keys = *std::get_if<PointOnCurve>(&element.kind);
  mirror_curve(keys.points, {&keys.x, &keys.y, &keys.z}, x);
}

ElementExample point_on_curve_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  PointOnCurve keys;
  keys.points = MatX{{0.0, 0.0, 0.0}, {1.0, numbers(-0.3, 0.3), 0.0}, {2.0, 0.0, 0.1}};
  x.keys(keys);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

std::vector<Stroke> point_on_curve_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  out.curve(element.markers[0], data_of<SpaceCurve>(element).samples());
  return out.take();
}

}  // namespace

constinit const ElementKind point_on_curve_element = {
    .about =
        "a point stays on a curve of another body, plane or in space, open or closed: two rows",
    .keys = point_on_curve_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(PointOnCurve()); },
    .validate = point_on_curve_validate,
    .build = point_on_curve_build,
    .rows = point_on_curve_rows,
    .mirror = point_on_curve_mirror,
    .picture = picture_of_constraint,
    .strokes = point_on_curve_strokes,
    .regimes = constraint_regimes};

constinit const ExampleMaker point_on_curve_examples = point_on_curve_example;

}  // namespace floatframe

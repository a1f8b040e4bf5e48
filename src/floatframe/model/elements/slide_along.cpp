// Slide along: a point of one body stays on a line through nodes of another one, which bends with
// it: a trolley on its girder, a lift in its guides. Two rows `on_curve`, whose first marker slides
// along these nodes (slide_path.hpp); of a rigid body they are on a spline through the points. With
// a motion the travel along the line is a function of time: one row `drive_on_curve`.
#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/curve_keys.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/slide_path.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(slide_along)

namespace {

constexpr ElementKey slide_along_keys[] = {
    place_key("from", "on the body that carries the path, which is given from here",
              described_by<&SlideAlong::a>),
    place_key("to", "the point that slides", described_by<&SlideAlong::b>),
    {.name = "points",
     .kind = KeyKind::points,
     .about = "of the path, along the axes of the world as drawn; of a flexible body nodes, and it "
              "goes through all nodes on the lines between them",
     .required = true,
     .words = curve_columns,
     .member = described_by<&SlideAlong::points>},
    {.name = "motion",
     .kind = KeyKind::motion,
     .about = "the travel along the path from its first point as a function of time; free without "
              "it",
     .member = described_by<&SlideAlong::motion>}};

void slide_along_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  const MatX points = check.matrix("points");
  if (check.good("points") && points.rows() > 0)
    validate_curve_points(check, "points", points, false);
}

bool slide_along_build(ElementBuild& build) {
  const MatX points = build.keys<SlideAlong>().points;
  if (points.rows() == 0) {  // of a program
    build.error(ErrorCode::missing, "found no points of the path, expected at least two");
    return false;
  }
  if (!build_constraint(build, Mat3::Identity(), Mat3::Identity(), false) || !build.slide(points))
    return false;
  PointOnCurve fixed;
  fixed.points = points;
  build.element.data =
      build.path_of(0) ? build.path_of(0) : std::make_shared<const SpaceCurve>(fixed);
  return true;
}

void slide_along_rows(const Model& model, const Element& element, ConstraintPart part,
                      std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  const auto* curve = &data_of<SpaceCurve>(element);
  of.add(ConstraintType::on_curve).curve = curve;
  if (!std::get<SlideAlong>(*element.keys).motion) return;
  ConstraintPart& drive = of.add(ConstraintType::drive_on_curve);
  drive.curve = curve;
  drive.motion = &element.signals[0].function;
}

void slide_along_mirror(ElementDescription& element, const Placement& x) {
  mirror_curve_points(std::get_if<SlideAlong>(&element.kind)->points, x);
}

std::vector<Stroke> slide_along_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  out.curve(element.markers[0], data_of<SpaceCurve>(element).samples());
  return out.take();
}

ElementExample slide_along_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  SlideAlong keys;
  keys.points = MatX{{0.0, 0.0, 0.0}, {1.0, numbers(-0.3, 0.3), 0.0}, {2.0, 0.0, 0.1}};
  x.keys(keys);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

}  // namespace

constinit const ElementKind slide_along_element = {
    .about =
        "a point slides along nodes of a flexible body, which bends below it, or along a rigid "
        "body: two rows, or three with a motion",
    .keys = slide_along_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(SlideAlong()); },
    .validate = slide_along_validate,
    .build = slide_along_build,
    .rows = slide_along_rows,
    .mirror = slide_along_mirror,
    .picture = picture_of_constraint,
    .strokes = slide_along_strokes,
    .regimes = constraint_regimes};

constinit const ExampleMaker slide_along_examples = slide_along_example;

}  // namespace floatframe

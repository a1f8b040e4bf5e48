// Point on a curve: a point of one body stays on a curve that is fixed in another one: the two rows
// `on_curve`. The curve is given from the point of `from` along the axes of the world as drawn.
#include <fmt/format.h>

#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/space_curve.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(point_on_curve)

namespace {

constexpr const char* point_on_curve_columns[] = {"x", "y", "z"};
constexpr const char* point_on_curve_range[] = {"from", "to"};
constexpr const char* point_on_curve_variable[] = {"u"};

constexpr ElementKey point_on_curve_formula(const char* name, const char* about, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::shape,
          .about = about,
          .words = point_on_curve_variable,
          .member = member};
}

constexpr ElementKey point_on_curve_keys[] = {
    place_key("from", "on the body that carries the curve, which is given from here",
              described_by<&PointOnCurve::a>),
    place_key("to", "the point that stays on the curve", described_by<&PointOnCurve::b>),
    {.name = "points",
     .kind = KeyKind::points,
     .about = "of the curve, joined by a cubic spline; along the axes of the world as drawn",
     .words = point_on_curve_columns,
     .member = described_by<&PointOnCurve::points>},
    point_on_curve_formula("x", "instead of points: their x over a parameter; 0 without it",
                           described_by<&PointOnCurve::x>),
    point_on_curve_formula("y", "the same of y", described_by<&PointOnCurve::y>),
    point_on_curve_formula("z", "the same of z", described_by<&PointOnCurve::z>),
    {.name = "range",
     .kind = KeyKind::numbers,
     .about = "of u in formulas",
     .words = point_on_curve_range,
     .member = described_by<&PointOnCurve::range>},
    {.name = "closed",
     .kind = KeyKind::flag,
     .about = "the curve ends where it begins; a closed spline needs no last point there",
     .member = described_by<&PointOnCurve::closed>}};

/// Neighbours are apart, those of a closed curve in a ring.
void point_on_curve_apart(const ElementCheck& check, const MatX& points, bool closed) {
  const Eigen::Index n = points.rows(), least = closed ? 3 : 2;
  if (n < least)
    return check.error(ErrorCode::wrong_count, "points",
                       fmt::format("found {}, expected at least {} points [x, y, z]",
                                   n == 1 ? "1 point" : "2 points", least));
  for (Eigen::Index i = closed ? 0 : 1; i < n; ++i)
    if ((points.row(i) - points.row(i > 0 ? i - 1 : n - 1)).norm() < 1e-9)
      return check.error(
          ErrorCode::geometry, "points",
          fmt::format("found row {} at the point before it, expected points apart", i + 1));
}

void point_on_curve_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  const bool points = check.given("points");
  const bool formulas = check.has("x") || check.has("y") || check.has("z");
  if (points == formulas && check.wrong.empty())
    return check.error(points ? ErrorCode::exclusive : ErrorCode::missing, "",
                       points ? "found points and formulas, expected one of them"
                              : "missing key 'points', or formulas 'x', 'y', 'z' with 'range'");
  const MatX rows = check.matrix("points"), range = check.matrix("range");
  if (check.good("points") && rows.rows() > 0)
    point_on_curve_apart(check, rows, check.flag("closed"));
  if (check.wrong.contains("range")) return;
  if (formulas && range.size() == 0)
    return check.error(ErrorCode::missing, "", "missing key 'range', of u in the formulas");
  if (!formulas && range.size() > 0)
    return check.error(ErrorCode::incomplete, "range", "found without formulas");
  if (range.size() == 2 && !(range(0) < range(1)))
    check.error(ErrorCode::wrong_value, "range",
                fmt::format("found {} to {}, expected two ascending numbers", number_text(range(0)),
                            number_text(range(1))));
}

bool point_on_curve_build(ElementBuild& build) {
  const PointOnCurve& keys = build.keys<PointOnCurve>();
  if (!build_constraint(build, Mat3::Identity(), Mat3::Identity(), false)) return false;
  auto curve = std::make_shared<SpaceCurve>(keys);
  if (!(curve->slowest() > 1e-6)) {
    build.error(ErrorCode::geometry,
                "found a curve that stops or has no value within its range, expected one whose "
                "tangent is not zero");
    return false;
  }
  if (keys.closed && keys.points.rows() == 0) {
    // At the end itself the curve begins again.
    const double begin = keys.range(0), end = keys.range(1) - 1e-9 * (keys.range(1) - begin);
    if (const double gap = (curve->at(begin).c - curve->at(end).c).norm(); gap > 1e-6) {
      build.error(
          ErrorCode::contradiction,
          fmt::format("found a gap of {:.3g} m between the ends of a closed curve, expected "
                      "none",
                      gap));
      return false;
    }
  }
  build.element.data = std::move(curve);
  return true;
}

void point_on_curve_rows(const Model& model, const Element& element, ConstraintPart part,
                         std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  of.add(ConstraintType::on_curve).curve = static_cast<const SpaceCurve*>(element.data.get());
}

void point_on_curve_mirror(ElementDescription& element, const Placement& x) {
  PointOnCurve& keys = *std::get_if<PointOnCurve>(&element.kind);
  for (int k = 0; k < 3; ++k) {
    if (!(x.P(k, k) < 0.0)) continue;
    if (keys.points.rows() > 0) keys.points.col(k) *= -1.0;
    std::optional<SharedFormula>& f = k == 0 ? keys.x : k == 1 ? keys.y : keys.z;
    if (!f || !*f) continue;
    auto turned = std::make_shared<Formula>(**f);
    turned->text = "-(" + turned->text + ")";
    turned->steps.push_back({.op = FormulaOp::negative});
    turned->sources.push_back(turned->text);
    f = std::move(turned);
  }
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
  const std::vector<Vec3>& samples = static_cast<const SpaceCurve*>(element.data.get())->samples();
  const std::size_t last = samples.size() - 1, pieces = std::min<std::size_t>(last, 300);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k <= pieces; ++k) points.push_back(samples[k * last / pieces]);
  Strokes out(model, element);
  out.add(element.markers[0], std::move(points));
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
    .regimes = constraint_regimes,
    .example = point_on_curve_example};

}  // namespace floatframe

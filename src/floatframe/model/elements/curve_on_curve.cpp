// Curve on curve: a plane curve of one body touches one of another body, in planes normal to the
// same axis: the row `curve_on_curve`. Its force acts in the contact along the common normal; where
// it changes its sign, a contact that only pushes would be lost: the row holds on.
// Curves may touch from outside or one in the other. As drawn, the pair of points with a common
// tangent that are nearest to each other is the contact.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "floatframe/model/axis_constraint.hpp"
#include "floatframe/model/curve_contact.hpp"
#include "floatframe/model/curve_keys.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(curve_on_curve)

namespace {

constexpr ElementKey curve_on_curve_keys[] = {
    constraint_from_key<CurveOnCurve>("on the first body, from which its curve is given"),
    constraint_to_key<CurveOnCurve>("on the second body, from which its curve is given"),
    constraint_axis_key<CurveOnCurve>("normal to the planes of both curves"),
    curve_points_key("points", described_by<&CurveOnCurve::points>),
    curve_formula_key("x", "instead of points: their x over a parameter; 0 without it",
                      described_by<&CurveOnCurve::x>),
    curve_formula_key("y", "the same of y", described_by<&CurveOnCurve::y>),
    curve_formula_key("z", "the same of z", described_by<&CurveOnCurve::z>),
    curve_range_key("range", described_by<&CurveOnCurve::range>),
    curve_closed_key("closed", described_by<&CurveOnCurve::closed>),
    curve_points_key("points_2", described_by<&CurveOnCurve::points_2>),
    curve_formula_key("x_2", "of the second curve", described_by<&CurveOnCurve::x_2>),
    curve_formula_key("y_2", "the same of y", described_by<&CurveOnCurve::y_2>),
    curve_formula_key("z_2", "the same of z", described_by<&CurveOnCurve::z_2>),
    curve_range_key("range_2", described_by<&CurveOnCurve::range_2>),
    curve_closed_key("closed_2", described_by<&CurveOnCurve::closed_2>)};

void curve_on_curve_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  validate_curve(check, "");
  validate_curve(check, "_2");
}

bool in_plane_of(const SpaceCurve& curve, const Vec3& k) {
  for (const double u : curve.parameters())
    if (const Vec3 t = curve.at(u).dc; !(std::abs(t.dot(k)) <= 1e-6 * t.norm())) return false;
  return true;
}

/// Whether the curvatures, against the same normal, are apart: the curves touch in one place.
bool one_contact(const CurvatureRange& a, const CurvatureRange& b, bool same) {
  const double low = same ? b.low : -b.high, high = same ? b.high : -b.low;
  const double size = 1e-9 * (std::abs(a.low) + std::abs(a.high) + std::abs(low) + std::abs(high));
  return a.low > high + size || a.high < low - size;
}

/// As drawn, with the point of the second curve at d from that of the first one.
std::shared_ptr<const CurveContact> contact_of_curves(const SpaceCurve& one, const SpaceCurve& two,
                                                      const Vec3& k, const Vec3& d,
                                                      std::string& complaint) {
  if (!in_plane_of(one, k) || !in_plane_of(two, k)) {
    complaint = "found a curve that leaves its plane, expected both curves normal to 'axis'";
    return nullptr;
  }
  const CurvatureRange a = curvatures(one, k), b = curvatures(two, k);
  std::shared_ptr<const CurveContact> best;
  double least = std::numeric_limits<double>::infinity(), refused = least;
  if (a.one_sign() || b.one_sign())
    for (const bool same : {false, true}) {
      auto contact = std::make_shared<const CurveContact>(one, two, k, same);
      const double gap =
          std::abs(contact->at(Mat3::Identity(), contact->swapped() ? Vec3(-d) : d).phi);
      if (!one_contact(a, b, same)) {
        if (gap < refused) refused = gap;
      } else if (gap < least) {
        least = gap;
        best = std::move(contact);
      }
    }
  // A pair that is clearly nearer is the one that is drawn.
  if (!best || refused < 0.5 * least) {
    best = nullptr;
    complaint = fmt::format(
        "found curvatures from {:.4g} to {:.4g} 1/m and from {:.4g} to {:.4g} 1/m, with which the "
        "curves can touch in two places, expected one that is curved more than the other "
        "everywhere",
        a.low, a.high, b.low, b.high);
  }
  return best;
}

bool curve_on_curve_build(ElementBuild& build) {
  const CurveOnCurve& keys = build.keys<CurveOnCurve>();
  if (!build_constraint(build, Mat3::Identity(), Mat3::Identity(), true)) return false;
  const auto one = build_curve(
      build, {keys.a, keys.b, keys.points, keys.x, keys.y, keys.z, keys.range, keys.closed});
  const auto two = build_curve(build, {keys.a, keys.b, keys.points_2, keys.x_2, keys.y_2, keys.z_2,
                                       keys.range_2, keys.closed_2});
  if (!one || !two) return false;
  std::string complaint;
  const Vec3 d = build.design_point(1) - build.design_point(0);
  build.element.data = contact_of_curves(*one, *two, unit_vector(keys.axis), d, complaint);
  if (!build.element.data) {
    build.error(ErrorCode::geometry, complaint);
    return false;
  }
  return true;
}

void curve_on_curve_rows(const Model& model, const Element& element, ConstraintPart part,
                         std::vector<ConstraintPart>& parts) {
  ConstraintParts of(model, element, part, parts);
  of.add(ConstraintType::curve_on_curve).curves = &data_of<CurveContact>(element);
}

void curve_on_curve_mirror(ElementDescription& element, const Placement& x) {
  CurveOnCurve& keys = *std::get_if<CurveOnCurve>(&element.kind);
  mirror_curve(keys.points, {&keys.x, &keys.y, &keys.z}, x);
  mirror_curve(keys.points_2, {&keys.x_2, &keys.y_2, &keys.z_2}, x);
}

std::vector<Stroke> curve_on_curve_strokes(const Model& model, const Element& element) {
  const auto* contact = &data_of<CurveContact>(element);
  Strokes out(model, element);
  for (const bool second : {false, true})
    out.curve(element.markers[second ? 1 : 0], contact->curve(second).samples());
  return out.take();
}

ElementExample curve_on_curve_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  CurveOnCurve keys;
  keys.points = MatX{{0.0, 0.0, 0.0}, {1.0, numbers(0.2, 0.3), 0.0}, {2.0, 0.0, 0.0}};
  keys.points_2 = MatX{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  x.keys(keys);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

}  // namespace

constinit const ElementKind curve_on_curve_element = {
    .about =
        "two plane curves of two bodies touch with a common tangent, as a cam and a curved or flat "
        "follower: one row. The force acts in the contact",
    .keys = curve_on_curve_keys,
    .list = ElementList::constraints,
    .blank = [] { return ElementKeys(CurveOnCurve()); },
    .validate = curve_on_curve_validate,
    .build = curve_on_curve_build,
    .rows = curve_on_curve_rows,
    .mirror = curve_on_curve_mirror,
    .picture = picture_of_constraint,
    .strokes = curve_on_curve_strokes,
    .regimes = constraint_regimes};

constinit const ExampleMaker curve_on_curve_examples = curve_on_curve_example;

}  // namespace floatframe

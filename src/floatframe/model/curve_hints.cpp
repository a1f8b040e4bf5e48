// Notes about cams and curves: corners, profiles that nearly fill a turn, curves that cross
// themselves, points that are not drawn on their curve, curves that are not drawn in touch.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/model/curve_checks.hpp"
#include "floatframe/model/curve_contact.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/hint_list.hpp"
#include "floatframe/model/lift_checks.hpp"
#include "floatframe/model/loop_mobility.hpp"

namespace floatframe {

namespace {

/// "", " (and 1 more corner)", " (and 3 more corners)"
std::string more_corners(std::size_t count) {
  if (count < 2) return {};
  return fmt::format(" (and {} more corner{})", count - 1, count > 2 ? "s" : "");
}

void hint_at_cam(const Model& model, const Element& e, HintList& out) {
  const CamProfile& profile = data_of<CamProfile>(e);
  const Cam& keys = *std::get_if<Cam>(e.keys.get());
  const CoordinatePort& port = e.coordinates[1];
  constexpr double turn = 2.0 * std::numbers::pi;
  if (!profile.formula && port.counted && profile.period == 0.0) {
    const double span = profile.spline
                            ? profile.pieces.breaks().back() - profile.pieces.breaks().front()
                            : profile.ends.back() - profile.ends.front();
    if (std::abs(span - turn) < 0.02 * turn)
      out.add("cam", e.name,
              fmt::format("its {} span {:.10g} rad, which is nearly a turn but not 2 pi = "
                          "6.283185307179586: the lift does not repeat, and goes on {} beyond them",
                          profile.spline ? "points" : "segments", span,
                          profile.spline ? "along its tangents" : "at its last value"));
  }
  if (!profile.formula) return;
  const std::vector<double>& position = model.joints[port.joint].position;
  const double start = position.empty() ? 0.0 : keys.cam.factor * position[port.component];
  const FormulaCorners corners = lift_corners(profile, port.counted, start);
  if (corners.slope)
    out.add("cam", e.name,
            fmt::format("its lift '{}' has a corner at x = {:.6g}, where its slope changes by "
                        "{:.3g}{}: a follower that comes there gets an impulse, and results are of "
                        "first order in the step; round it",
                        profile.formula->text, corners.slope->at, corners.slope->size,
                        more_corners(corners.slopes)));
  else if (const auto bend = lift_bend(profile, port.counted, start))
    out.add("cam", e.name,
            fmt::format("the slope of its lift '{}' has a corner at x = {:.6g}: the acceleration "
                        "of the follower jumps there, where no step ends, and results are of first "
                        "order in the step",
                        profile.formula->text, *bend));
}

void hint_at_curve(const std::string& name, const SpaceCurve& curve, HintList& out) {
  const CurveCorners corners = curve_corners(curve);
  if (corners.count > 0)
    out.add("constraint", name,
            fmt::format("its curve has a corner at u = {:.6g}, where its tangent turns by {:.3g} "
                        "degrees{}: a point that comes there gets an impulse, and results are of "
                        "first order in the step; round it",
                        corners.at, corners.angle * 180.0 / std::numbers::pi,
                        more_corners(corners.count)));
  if (const auto crossing = curve_crossing(curve))
    out.add("constraint", name,
            fmt::format("its curve crosses or meets itself at u = {:.6g} and {:.6g}: where the "
                        "nearer branch holds, a point may change from one to the other",
                        crossing->u, crossing->w));
}

double length_of(const SpaceCurve& curve) {
  double length = 0.0;
  for (std::size_t k = 1; k < curve.samples().size(); ++k)
    length += (curve.samples()[k] - curve.samples()[k - 1]).norm();
  return length;
}

constexpr double noticeable_gap = 1e-3;  // of the length of the curve

/// Curves that the start moves together.
void hint_at_contact(const Model& model, const Element& e, const CurveContact& contact,
                     HintList& out) {
  const Pose a = design_pose(model, e.markers[contact.swapped() ? 1 : 0]),
             b = design_pose(model, e.markers[contact.swapped() ? 0 : 1]);
  const Mat3 R = a.R.transpose() * b.R;
  const double off = std::abs(contact.at(R, a.R.transpose() * (b.p - a.p)).phi);
  const double length = std::min(length_of(contact.curve(false)), length_of(contact.curve(true)));
  if (off > noticeable_gap * length)
    out.add("constraint", e.name,
            fmt::format("its curves are drawn {:.3g} m from where they touch: the start moves them "
                        "there",
                        off));
}

/// A point that the start moves onto its curve.
void hint_at_point(const Model& model, const Element& e, const SpaceCurve& curve, HintList& out) {
  const Pose a = design_pose(model, e.markers[0]), b = design_pose(model, e.markers[1]);
  const double off = curve.foot(a.R.transpose() * (b.p - a.p)).e.norm();
  if (off > noticeable_gap * length_of(curve))
    out.add(
        "constraint", e.name,
        fmt::format("its point is drawn {:.3g} m from its curve: the start moves it there", off));
}

}  // namespace

void hint_at_curves(const Model& model, HintList& out) {
  for (const Element& e : model.elements) {
    if (!e.data) continue;
    if (std::get_if<Cam>(e.keys.get())) hint_at_cam(model, e, out);
    if (std::get_if<PointOnCurve>(e.keys.get())) {
      const auto& curve = data_of<SpaceCurve>(e);
      hint_at_curve(e.name, curve, out);
      hint_at_point(model, e, curve, out);
    }
    if (std::get_if<CurveOnCurve>(e.keys.get())) {
      const auto& contact = data_of<CurveContact>(e);
      for (const bool second : {false, true}) hint_at_curve(e.name, contact.curve(second), out);
      hint_at_contact(model, e, contact, out);
    }
  }
}

}  // namespace floatframe

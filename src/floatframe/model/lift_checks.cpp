#include "floatframe/model/lift_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/curve_gap.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {
namespace {

constexpr double intervals_of_lift = 10'000.0;

/// How far from the start the formula is looked at: nearby with more places.
std::vector<double> reaches_of_lift(bool turns) {
  if (turns) return {4.0 * std::numbers::pi};
  return {0.1, 10.0};
}

double coordinate_of_cam(const Ports& in) {
  const std::vector<CoordinatePort>& all = in.element.coordinates;
  const CoordinatePort& port = all.back();
  const MarkerState &a = in.marker(port.port), &b = in.marker(port.port + 1);
  const Joint& joint = in.model.joints[port.joint];
  const auto axis = coordinate_axis(joint.type, joint.axis_2, port.component);
  if (axis && axis->turns) {
    const auto slot =
        std::ranges::count_if(all, [](const CoordinatePort& p) { return p.counted; }) - 1;
    const double last = port.counted && in.angles ? in.angles[slot] : 0.0;
    return angle_about_z<double>(a, b, last);
  }
  const Vec3 e = a.R * (axis ? axis->direction : Vec3::UnitZ());
  return axis_measure(e, a, b).s;
}

/// It has a value at x, but next to it a slope without bound.
bool steep_without_bound(const CamProfile& profile, double x) {
  constexpr double beside = 1e-12, unbounded = 1e5;
  for (const double side : {-1.0, 1.0}) {
    const double slope = formula_at(*profile.formula, x + side * beside * (1.0 + std::abs(x))).df;
    if (std::abs(slope) > unbounded) return true;
  }
  return false;
}

CurveValue point_of_lift(const CamProfile& profile, double x) {
  const PiecewisePolynomial::Value v = formula_at(*profile.formula, x);
  return {Vec3(x, v.f, 0.0), Vec3(1.0, v.df, 0.0), Vec3(0.0, v.ddf, 0.0)};
}

}  // namespace

FormulaCorners lift_corners(const CamProfile& profile, bool turns, double coordinate) {
  FormulaCorners found;
  if (!profile.formula) return found;
  const double x = coordinate - profile.phase;
  for (const double reach : reaches_of_lift(turns)) {
    found =
        formula_corners(*profile.formula, x - reach, x + reach, 2.0 * reach / intervals_of_lift);
    if (found.jump || found.slope) break;
  }
  return found;
}

std::optional<double> lift_bend(const CamProfile& profile, bool turns, double coordinate) {
  if (!profile.formula || profile.formula->kinks.empty()) return std::nullopt;
  const Formula& f = *profile.formula;
  const double x = coordinate - profile.phase;
  constexpr double noticeable = 1e-3, rounding = 1e-6;  // of the largest s'', of the slope
  for (const double reach : reaches_of_lift(turns)) {
    const double step = 2.0 * reach / intervals_of_lift;
    double most = 0.0;
    std::vector<double> places;
    for (double from = x - reach; from < x + reach; from += step) {
      if (const double bend = std::abs(formula_at(f, from).ddf); std::isfinite(bend))
        most = std::max(most, bend);
      if (const double at = piece_change(f, from, from + step); at <= from + step)
        places.push_back(at);
    }
    for (const double at : places) {
      const double side = 1e-9 * (1.0 + std::abs(at));
      const PiecewisePolynomial::Value a = formula_at(f, at - side), b = formula_at(f, at + side);
      const double bend = std::abs(b.ddf - a.ddf);
      if (bend > noticeable * most && std::abs(b.df - a.df) <= rounding * (1.0 + bend)) return at;
    }
  }
  return std::nullopt;
}

std::optional<double> lift_end(const CamProfile& profile, double x, double reach) {
  if (!profile.formula) return std::nullopt;
  constexpr int intervals = 200;
  const auto at = [&](double u) { return point_of_lift(profile, u); };
  const double step = reach / intervals;
  for (int k = 0; k < intervals; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double p = x + side * step * k, q = x + side * step * (k + 1);
      if (const auto gap = gap_between(std::min(p, q), std::max(p, q), 1e-6, at)) return gap->at;
    }
  return std::nullopt;
}

void keep_from_ends(CamProfile& profile, double x) {
  if (!profile.formula || !(x > profile.low && x < profile.high)) return;
  constexpr double part = 0.9;
  constexpr int intervals = 1000;
  const auto at = [&](double u) { return point_of_lift(profile, u); };
  for (double* end : {&profile.low, &profile.high}) {
    const double step = (*end - x) / intervals;
    for (int k = 0; k < intervals; ++k) {
      const double p = x + step * k, q = x + step * (k + 1);
      const auto gap = gap_between(std::min(p, q), std::max(p, q), 1e-6, at);
      if (!gap) continue;
      *end = x + part * (gap->at - x);
      break;
    }
  }
}

bool has_lift_formulas(const Model& model) noexcept {
  return std::ranges::any_of(model.elements, [](const Element& e) {
    const Cam* keys = e.keys ? std::get_if<Cam>(e.keys.get()) : nullptr;
    return keys && keys->formula;
  });
}

std::string lift_complaint(const Ports& in, bool near) {
  if (!std::get_if<Cam>(in.element.keys.get())) return {};
  const CamProfile& profile = in.data<CamProfile>();
  if (!profile.formula) return {};
  const Formula& f = *profile.formula;
  const double x =
      std::get<Cam>(*in.element.keys).cam.factor * coordinate_of_cam(in) - profile.phase;
  if (!std::isfinite(x)) return {};
  const std::string who = element_name(in.element) + ": ";
  if (const std::string why = fault_at(f, x); !why.empty())
    return fmt::format("{}its lift has no value at x = {:.6g}: {}", who, x, why);
  if (steep_without_bound(profile, x))
    return fmt::format("{}its lift '{}' has a slope without bound at x = {:.6g}", who, f.text, x);
  constexpr double further = 0.02;
  if (!near) return {};
  if (const auto end = lift_end(profile, x, further * (1.0 + std::abs(x))))
    return fmt::format(
        "{}its lift '{}' ends, or grows without bound, at x = {:.6g}, next to "
        "x = {:.6g}",
        who, f.text, *end, x);
  return {};
}

}  // namespace floatframe

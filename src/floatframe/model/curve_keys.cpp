#include "floatframe/model/curve_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "floatframe/model/curve_checks.hpp"

namespace floatframe {

void validate_curve_points(const ElementCheck& check, const std::string& key, const MatX& points,
                           bool closed) {
  const Eigen::Index n = points.rows(), least = closed ? 3 : 2;
  if (n < least)
    return check.error(ErrorCode::wrong_count, key,
                       fmt::format("found {}, expected at least {} points [x, y, z]",
                                   n == 1 ? "1 point" : "2 points", least));
  for (Eigen::Index i = closed ? 0 : 1; i < n; ++i)
    if ((points.row(i) - points.row(i > 0 ? i - 1 : n - 1)).norm() < 1e-9)
      return check.error(
          ErrorCode::geometry, key,
          fmt::format("found row {} at the point before it, expected points apart", i + 1));
}

void validate_curve(const ElementCheck& check, const std::string& ending) {
  const std::string rows_key = "points" + ending, x = "x" + ending, y = "y" + ending,
                    z = "z" + ending, range_key = "range" + ending;
  const bool points = check.given(rows_key);
  const bool formulas = check.has(x) || check.has(y) || check.has(z);
  if (points == formulas && check.wrong.empty())
    return check.error(points ? ErrorCode::exclusive : ErrorCode::missing, "",
                       points
                           ? "found points and formulas, expected one of them"
                           : fmt::format("missing key '{}', or formulas '{}', '{}', '{}' with '{}'",
                                         rows_key, x, y, z, range_key));
  const MatX rows = check.matrix(rows_key), range = check.matrix(range_key);
  if (check.good(rows_key) && rows.rows() > 0)
    validate_curve_points(check, rows_key, rows, check.flag("closed" + ending));
  if (check.wrong.contains(range_key)) return;
  if (formulas && range.size() == 0)
    return check.error(ErrorCode::missing, "",
                       fmt::format("missing key '{}', of u in the formulas", range_key));
  if (!formulas && range.size() > 0)
    return check.error(ErrorCode::incomplete, range_key, "found without formulas");
  if (range.size() == 2 && !(range(0) < range(1)))
    check.error(ErrorCode::wrong_value, range_key,
                fmt::format("found {} to {}, expected two ascending numbers", number_text(range(0)),
                            number_text(range(1))));
}

std::optional<SpaceCurve> build_curve(ElementBuild& build, const PointOnCurve& keys) {
  SpaceCurve curve(keys);
  if (!(curve.slowest() > 1e-6)) {
    build.error(ErrorCode::geometry,
                "found a curve that stops or has no value within its range, expected one whose "
                "tangent is not zero");
    return std::nullopt;
  }
  if (keys.closed && keys.points.rows() == 0) {
    // At the end itself the curve begins again.
    const double begin = keys.range(0), end = keys.range(1) - 1e-9 * (keys.range(1) - begin);
    if (const double gap = (curve.at(begin).c - curve.at(end).c).norm(); gap > 1e-6) {
      build.error(ErrorCode::contradiction,
                  fmt::format("found a gap of {:.3g} m between the ends of a closed curve, "
                              "expected none",
                              gap));
      return std::nullopt;
    }
  }
  if (keys.points.rows() > 0) return curve;
  if (const auto gap = curve_gap(curve)) {
    build.error(ErrorCode::geometry,
                std::isinf(gap->size)
                    ? fmt::format("found a curve without a place at u = {:.6g}, expected one that "
                                  "has no end within its range",
                                  gap->at)
                    : fmt::format("found a gap of {:.3g} m in the curve at u = {:.6g}, expected "
                                  "none within its range",
                                  gap->size, gap->at));
    return std::nullopt;
  }
  return curve;
}

bool has_path(const ElementKeys& keys) {
  const PointOnCurve* curve = std::get_if<PointOnCurve>(&keys);
  return std::holds_alternative<SlideAlong>(keys) || (curve && curve->points.rows() > 0);
}

void mirror_curve_points(MatX& points, const Placement& x) {
  for (int k = 0; k < 3; ++k)
    if (points.rows() > 0 && x.P(k, k) < 0.0) points.col(k) *= -1.0;
}

void mirror_curve(MatX& points, const std::array<std::optional<SharedFormula>*, 3>& formulas,
                  const Placement& x) {
  mirror_curve_points(points, x);
  for (int k = 0; k < 3; ++k) {
    if (!(x.P(k, k) < 0.0)) continue;
    std::optional<SharedFormula>& f = *formulas.at(k);
    if (!f || !*f) continue;
    auto turned = std::make_shared<Formula>(**f);
    turned->text = "-(" + turned->text + ")";
    turned->steps.push_back({.op = FormulaOp::negative});
    turned->sources.push_back(turned->text);
    f = std::move(turned);
  }
}

}  // namespace floatframe

#pragma once
// What elements with curves share: their keys, checks, curves and mirror images. Load time only.
#include <array>
#include <optional>
#include <string>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/space_curve.hpp"

namespace floatframe {

inline constexpr const char* curve_columns[] = {"x", "y", "z"};
inline constexpr const char* curve_range_words[] = {"from", "to"};
inline constexpr const char* curve_variable[] = {"u"};

constexpr ElementKey curve_points_key(const char* name, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::points,
          .about = "of the curve, joined by a cubic spline; along the axes of the world as drawn",
          .words = curve_columns,
          .member = member};
}
constexpr ElementKey curve_formula_key(const char* name, const char* about, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::shape,
          .about = about,
          .words = curve_variable,
          .member = member};
}
constexpr ElementKey curve_range_key(const char* name, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::numbers,
          .about = "of u in formulas",
          .words = curve_range_words,
          .member = member};
}
constexpr ElementKey curve_closed_key(const char* name, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::flag,
          .about = "the curve ends where it begins; a closed spline needs no last point there",
          .member = member};
}

/// The curve of the keys `points`, `x`, `y`, `z`, `range`, `closed` with this ending.
void validate_curve(const ElementCheck& check, const std::string& ending);
/// None after an error.
std::optional<SpaceCurve> build_curve(ElementBuild& build, const PointOnCurve& keys);
/// Points of this key: neighbours are apart, those of a closed curve in a ring.
void validate_curve_points(const ElementCheck& check, const std::string& key, const MatX& points,
                           bool closed);
/// A constraint whose travel along its points is a length.
bool has_path(const ElementKeys& keys);
/// In the mirrored subsystem.
void mirror_curve_points(MatX& points, const Placement& x);
void mirror_curve(MatX& points, const std::array<std::optional<SharedFormula>*, 3>& formulas,
                  const Placement& x);

}  // namespace floatframe

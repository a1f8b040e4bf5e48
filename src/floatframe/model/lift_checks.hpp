#pragma once
// What the formula of a lift s(x) should not have: jumps, corners of s or s', places where it has
// no value or grows without bound. Load time, and for messages.
#include <optional>
#include <string>

#include "floatframe/formulas/formula_corners.hpp"
#include "floatframe/model/cam_profile.hpp"
#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

/// Jumps and corners two turns, or 10 m, around the coordinate of the cam at the start.
FormulaCorners lift_corners(const CamProfile& profile, bool turns, double coordinate);
/// The first x there at which s'' jumps, while s and s' do not.
std::optional<double> lift_bend(const CamProfile& profile, bool turns, double coordinate);
/// The nearest x to this one, within `reach`, where it ends, jumps or grows without bound.
std::optional<double> lift_end(const CamProfile& profile, double x, double reach);

/// Keeps `low` and `high` of a formula away from where it grows without bound or ends, next to x:
/// the row would be scaled by slopes that the cam never has.
void keep_from_ends(CamProfile& profile, double x);
bool has_lift_formulas(const Model& model) noexcept;
/// Why a cam by a formula has no lift in this motion: "cam 'k': its lift ... at x = 0"; empty: it
/// has one, or is no cam by a formula. `near`: or why it has none a little further.
std::string lift_complaint(const Ports& in, bool near);

}  // namespace floatframe

#pragma once
// Heights z(x, y) by a formula of x and y, in the language of all formulas, with exact first and
// second derivatives: the formula is evaluated once over functions of two variables.
#include <string>

#include "floatframe/formulas/formula.hpp"
#include "floatframe/roads/surface_point.hpp"

namespace floatframe {

/// Why a formula cannot be a height: it reads something else than x and y, or a grid, whose second
/// derivatives are not known; empty if it can.
std::string height_formula_complaint(const Formula& formula);

/// Not a number where the formula has no value. Step time.
SurfacePoint formula_height(const Formula& formula, double x, double y) noexcept;

}  // namespace floatframe

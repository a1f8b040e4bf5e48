#pragma once
// Jumps of a formula of time, and of its slope. They are looked for between neighbours of a row of
// instants: where the change over an interval of length h is not that of its slopes,
//   |f(b) - f(a) - h (f'(a) + f'(b)) / 2| > h |f'(b) - f'(a)| + h^2 (|f''(a)| + |f''(b)|),      (1)
// it is halved until its ends are neighbouring numbers, and a change that remains is a jump. The
// same of f' with f''. A pulse between two of the instants is not seen. Load time only.
#include <cstddef>
#include <optional>

#include "floatframe/formulas/formula.hpp"

namespace floatframe {

struct FormulaCorner {
  double at = 0.0;    ///< [s]
  double size = 0.0;  ///< right side less left side
};
struct FormulaCorners {
  std::optional<FormulaCorner> jump;   ///< the first one of the value
  std::optional<FormulaCorner> slope;  ///< the largest one of the slope
  std::size_t slopes = 0;
};
/// Of a formula of time alone from `begin` to `end`, which may be infinite, in intervals of a step
/// or, in a long run, of several. Slopes up to the first jump only.
FormulaCorners formula_corners(const Formula& f, double begin, double end, double step);

}  // namespace floatframe

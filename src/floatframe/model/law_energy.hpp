#pragma once
// Potential energy of a force law.
#include "floatframe/math/piecewise_polynomial.hpp"

namespace floatframe {

/// Integral of spring(s) from 0 to s (from the nearest end of its first piece outwards) [J].
double law_energy(const PiecewisePolynomial& law, double s) noexcept;

}  // namespace floatframe

#pragma once
// Circular frequencies [rad/s], eigenvalues of K x = lambda M x, and frequencies in Hz.
#include <algorithm>
#include <cmath>
#include <numbers>

namespace floatframe {

inline constexpr double hertz(double omega) { return omega / (2.0 * std::numbers::pi); }
inline constexpr double omega_of(double hertz) { return 2.0 * std::numbers::pi * hertz; }
/// Of an eigenvalue omega^2; rounding below zero counts as zero.
inline double hertz_of_eigenvalue(double lambda) { return hertz(std::sqrt(std::max(0.0, lambda))); }

}  // namespace floatframe

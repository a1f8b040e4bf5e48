#pragma once
// Random roads after ISO 8608: profiles whose height has the one-sided displacement spectrum
//   G(n) = G0 (n / n0)^-2,   n0 = 0.1 cycles/m,   0.011 <= n <= 2.83 cycles/m        [m3]
// with the roughness G0 = G(n0) of a class: A 16e-6, B 64e-6, ..., H 262144e-6 m3, four times as
// much from class to class (the geometric means of the standard).
#include <cstdint>
#include <vector>

#include "floatframe/math/piecewise_polynomial.hpp"

namespace floatframe {

namespace road_classes {
inline constexpr const char* names[] = {"A", "B", "C", "D", "E", "F", "G", "H"};
/// G0 of a class by its place [m3].
constexpr double roughness(int place) { return 16e-6 * static_cast<double>(1 << (2 * place)); }
inline constexpr double reference = 0.1;           ///< n0 [cycles/m]
inline constexpr double low = 0.011, high = 2.83;  ///< [cycles/m]
}  // namespace road_classes

struct RoadSpectrum {
  double roughness = road_classes::roughness(2);  ///< G0 [m3]
  double start = 0.0, length = 100.0;             ///< [m]
  std::int64_t seed = 1;                          ///< each value gives a different road
  bool operator==(const RoadSpectrum&) const = default;
};

/// int G dn between two wave numbers [m2]; G is 0 outside the range.
double road_variance(const RoadSpectrum& spectrum, double from, double to) noexcept;

/// amplitude cos(k (x - start) + phase): [m], [rad/m], [rad].
struct RoadWave {
  double amplitude = 0.0, k = 0.0, phase = 0.0;
};
/// The waves of `random_road`, the longest first.
std::vector<RoadWave> road_waves(const RoadSpectrum& spectrum);
/// Throws InputError as `random_road`.
void check_spectrum(const RoadSpectrum& spectrum);
/// The sum of waves on the length of the spectrum, as `random_road` makes it.
PiecewisePolynomial road_of_waves(const RoadSpectrum& spectrum, const std::vector<RoadWave>& waves);

/// A sum of 1000 waves with random phases, one in each of as many bands of equal ratio, with the
/// variance of its band; the wave number within the band is random, so that the road is not
/// periodic.
/// Cubic pieces of 0.035 m with the exact heights and slopes at their ends: C1. Over the first and
/// last 10 m (at most a tenth of the length) it is blended into the plane, zero beyond. Equal
/// arguments give the same road on every machine up to rounding. Throws InputError if the length is
/// not between 1 and 10 000 m or the roughness is negative or not finite.
PiecewisePolynomial random_road(const RoadSpectrum& spectrum);

}  // namespace floatframe

#include "floatframe/description/road_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/rules.hpp"

namespace floatframe {

namespace {

constexpr int wave_count = 1000;
constexpr double spacing = 0.035;  ///< a tenth of the shortest wave [m]
constexpr double ramp = 10.0;      ///< [m]

/// In [0, 1): the same bits everywhere, unlike the distributions of the standard library.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

/// Amplitude factor of the road at a distance from the nearer end, with its slope.
std::pair<double, double> share(double distance, double over) {
  const double s = std::clamp(distance / over, 0.0, 1.0);
  return {s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / over};
}

}  // namespace

double road_variance(const RoadSpectrum& spectrum, double from, double to) noexcept {
  const double a = std::clamp(from, road_classes::low, road_classes::high),
               b = std::clamp(to, road_classes::low, road_classes::high * (1.0 + 1e-9));
  return spectrum.roughness * road_classes::reference * road_classes::reference *
         std::max(0.0, 1.0 / a - 1.0 / b);
}

std::vector<RoadWave> road_waves(const RoadSpectrum& spectrum) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(spectrum.seed));
  const double ratio = std::pow(road_classes::high / road_classes::low, 1.0 / wave_count);
  std::vector<RoadWave> waves;
  double low = road_classes::low;
  for (int i = 0; i < wave_count; ++i) {
    const double high = low * ratio;
    const double n = low * std::pow(ratio, uniform(engine));
    const double turn = 2.0 * std::numbers::pi;
    waves.push_back(
        {std::sqrt(2.0 * road_variance(spectrum, low, high)), turn * n, turn * uniform(engine)});
    low = high;
  }
  return waves;
}

void check_spectrum(const RoadSpectrum& spectrum) {
  if (const auto complaint = rules::random_road_length.complaint(spectrum.length))
    throw InputError(ErrorCode::out_of_range, "random road: length: " + *complaint);
  if (const auto complaint = non_negative_number("m3").complaint(spectrum.roughness))
    throw InputError(ErrorCode::out_of_range, "random road: roughness: " + *complaint);
  if (!std::isfinite(spectrum.start))
    throw InputError(ErrorCode::not_finite,
                     "random road: start: found a number that is not finite");
}

PiecewisePolynomial road_of_waves(const RoadSpectrum& spectrum,
                                  const std::vector<RoadWave>& waves) {
  const auto count = static_cast<std::size_t>(std::ceil(spectrum.length / spacing));
  const double h = spectrum.length / static_cast<double>(count);
  std::vector<double> z(count + 1, 0.0), slope(count + 1, 0.0);
  for (const RoadWave& w : waves) {
    // cos and sin of k i h + phase by recurrence, restarted every 256 points: rounding below 1e-13.
    const double c = std::cos(w.k * h), s = std::sin(w.k * h);
    double cosine = 0.0, sine = 0.0;
    for (std::size_t i = 0; i <= count; ++i) {
      if (i % 256 == 0) {
        const double angle = w.k * h * static_cast<double>(i) + w.phase;
        cosine = std::cos(angle);
        sine = std::sin(angle);
      }
      z[i] += w.amplitude * cosine;
      slope[i] -= w.amplitude * w.k * sine;
      const double next = cosine * c - sine * s;
      sine = sine * c + cosine * s;
      cosine = next;
    }
  }
  const double over = std::min(ramp, 0.1 * spectrum.length);
  for (std::size_t i = 0; i <= count; ++i) {
    const double x = h * static_cast<double>(i), back = spectrum.length - x;
    const bool rising = x < back;
    const auto [part, rate] = share(rising ? x : back, over);
    slope[i] = part * slope[i] + (rising ? rate : -rate) * z[i];
    z[i] *= part;
  }

  std::vector<double> breaks{spectrum.start};
  std::vector<PiecewisePolynomial::Piece> pieces{{spectrum.start, {0.0}}};
  for (std::size_t i = 0; i < count; ++i) {
    const double rise = (z[i + 1] - z[i]) / h;
    pieces.push_back({breaks.back(),
                      {z[i], slope[i], (3.0 * rise - 2.0 * slope[i] - slope[i + 1]) / h,
                       (slope[i] + slope[i + 1] - 2.0 * rise) / (h * h)}});
    breaks.push_back(spectrum.start + h * static_cast<double>(i + 1));
  }
  pieces.push_back({breaks.back(), {0.0}});
  return {std::move(breaks), std::move(pieces)};
}

PiecewisePolynomial random_road(const RoadSpectrum& spectrum) {
  check_spectrum(spectrum);
  return road_of_waves(spectrum, road_waves(spectrum));
}

}  // namespace floatframe

// Random roads: the spectrum that was asked for, smooth, the same again, and nothing else.
#include "floatframe/description/road_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

/// Variance of the waves between two wave numbers in the middle of the road, from its Fourier
/// coefficients under a Hann window (whose mean square is 3/8).
double measured_variance(const PiecewisePolynomial& road, double from, double to, double low,
                         double high) {
  const int samples = 4096;
  const double length = high - low, dx = length / samples, turn = 2.0 * std::numbers::pi;
  std::vector<double> z(samples);
  for (int i = 0; i < samples; ++i)
    z[i] = 0.5 * (1.0 - std::cos(turn * i / samples)) * road(low + i * dx).f;
  double sum = 0.0;
  for (int k = static_cast<int>(std::ceil(from * length)); k < to * length; ++k) {
    std::complex<double> c = 0.0, wave = 1.0;
    const std::complex<double> next = std::polar(1.0, -turn * k / samples);
    for (int i = 0; i < samples; ++i, wave *= next) c += z[i] * wave;
    sum += 2.0 * std::norm(c / static_cast<double>(samples)) / 0.375;
  }
  return sum;
}

TEST(RoadSpectrum, HasTheVarianceOfEachOctave) {
  RoadSpectrum s;
  s.roughness = road_classes::roughness(2);
  s.length = 520.0;
  s.start = 30.0;
  const double octaves[] = {0.05, 0.1, 0.2, 0.4};
  double mean[4] = {};
  const int roads = 12;
  for (int seed = 1; seed <= roads; ++seed) {
    s.seed = seed;
    const PiecewisePolynomial road = random_road(s);
    for (int k = 0; k < 4; ++k)
      mean[k] += measured_variance(road, octaves[k], 2.0 * octaves[k], 40.0, 540.0) / roads;
  }
  // 25 lines of the window in the lowest octave, 12 roads: 8 % of scatter, less in the higher ones.
  for (int k = 0; k < 4; ++k) {
    const double expected = road_variance(s, octaves[k], 2.0 * octaves[k]);
    EXPECT_NEAR(mean[k] / expected, 1.0, k == 0 ? 0.2 : 0.12) << octaves[k];
    std::printf("[ figure ] road_variance_%g %.3f\n", octaves[k], mean[k] / expected);
  }
}

TEST(RoadSpectrum, ClassesAndIntegralAreThoseOfTheStandard) {
  EXPECT_DOUBLE_EQ(road_classes::roughness(0), 16e-6);
  EXPECT_DOUBLE_EQ(road_classes::roughness(2), 256e-6);
  EXPECT_DOUBLE_EQ(road_classes::roughness(7), 262144e-6);
  RoadSpectrum s;
  EXPECT_LT(road_variance(s, 0.0, 0.01) + road_variance(s, 3.0, 4.0), 1e-9 * s.roughness);
  double sum = 0.0;  // of G = roughness (0.1 / n)^2
  const int parts = 20000;
  for (int i = 0; i < parts; ++i)
    sum += s.roughness * std::pow(0.1 / (0.2 + 0.6 * (i + 0.5) / parts), 2.0) * 0.6 / parts;
  EXPECT_NEAR(sum, road_variance(s, 0.2, 0.8), 1e-8 * sum);
}

TEST(RoadSpectrum, IsSmoothAndEndsInThePlane) {
  RoadSpectrum s;
  s.length = 60.0;
  s.start = -20.0;
  const PiecewisePolynomial road = random_road(s);
  EXPECT_TRUE(road.edges().empty());
  EXPECT_EQ(road(-20.0).f, 0.0);
  EXPECT_EQ(road(-21.0).f, 0.0);
  EXPECT_EQ(road(40.5).f, 0.0);
  EXPECT_NE(road(3.0).f, 0.0);
  EXPECT_EQ(road(3.0).f, random_road(s)(3.0).f);
  s.seed = 2;
  EXPECT_NE(road(3.0).f, random_road(s)(3.0).f);
  const double slope = (road(3.0 + 1e-6).f - road(3.0 - 1e-6).f) / 2e-6;
  EXPECT_NEAR(slope, road(3.0).df, 1e-7);
}

TEST(RoadSpectrum, InvalidSpectraAreErrors) {
  RoadSpectrum s;
  s.length = 0.5;
  EXPECT_EQ(error_of([&] { random_road(s); }), "out_of_range");
  s.length = 10.0;
  s.roughness = -1.0;
  EXPECT_EQ(error_of([&] { random_road(s); }), "out_of_range");
}

}  // namespace
}  // namespace floatframe::test

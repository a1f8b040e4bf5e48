// Two random tracks: their spectra, and their coherence on the waves and on realisations.
#include "floatframe/description/random_tracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <vector>

#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Of the surface whose sections have the spectrum 1/n^2 the density in the plane falls with the
/// third power of the wave number: g = int cos(b w) (a^2 + b^2)^(-3/2) db a^2 / 2, a = 2 pi n. With
/// b = a sinh(q) this is int_0^inf cos(a w sinh q) / cosh^2 q dq.
double isotropic_by_quadrature(double s) {
  const int n = 400000;
  const double most = 12.0, h = most / n;
  double sum = 0.5;
  for (int k = 1; k <= n; ++k) {
    const double q = h * k, c = std::cosh(q);
    sum += std::cos(s * std::sinh(q)) / (c * c);
  }
  return h * sum;
}

TEST(RandomTracks, CoherenceOfAnIsotropicSurface) {
  TrackSpectrum t;
  t.width = 1.6;
  for (const double n : {0.011, 0.05, 0.1, 0.3, 1.0}) {
    const double s = turn * n * t.width;
    EXPECT_NEAR(track_coherence(t, n), isotropic_by_quadrature(s), 1e-6) << n;
  }
  EXPECT_NEAR(track_coherence(t, 1.0 / (turn * t.width)), 0.6019072301972346, 1e-14);  // K_1(1)
  t.coherence = TrackCoherence::exponential;
  t.decay = 3.0;
  EXPECT_DOUBLE_EQ(track_coherence(t, 0.2), std::exp(-0.96));
}

/// Sums over the waves of a band: spectra of both tracks, real and imaginary part of the cross
/// spectrum, and what the coherence says of it.
TEST(RandomTracks, ExactOnTheSpectrumUsed) {
  for (const TrackCoherence kind : {TrackCoherence::isotropic, TrackCoherence::exponential}) {
    TrackSpectrum t;
    t.coherence = kind;
    t.decay = 2.0;
    t.road.seed = 5;
    const TrackWaves w = track_waves(t);
    double quadrature = 0.0, total = 0.0;
    for (std::size_t k = 0; k < w.left.size(); ++k) {
      const RoadWave &l = w.left[k], &r = w.right[k];
      EXPECT_EQ(l.amplitude, r.amplitude);
      EXPECT_EQ(l.k, r.k);
      EXPECT_NEAR(std::cos(r.phase - l.phase), track_coherence(t, l.k / turn), 1e-12);
      const double power = l.amplitude * l.amplitude;
      quadrature += power * std::sin(r.phase - l.phase);
      total += power;
    }
    EXPECT_LT(std::abs(quadrature) / total, 0.003);
    const TwoTracks tracks = random_tracks(t);
    EXPECT_EQ(tracks.left(40.3).f, random_road(t.road)(40.3).f);
    EXPECT_NE(tracks.right(40.3).f, tracks.left(40.3).f);
  }
}

/// Powers of both tracks and real part of the cross power between two wave numbers, under a Hann
/// window.
struct Powers {
  double left = 0.0, right = 0.0, cross = 0.0;
};
Powers powers(const TwoTracks& tracks, double from, double to, double low, double high) {
  const int samples = 2048;
  const double length = high - low, dx = length / samples;
  std::vector<double> l(samples), r(samples);
  for (int i = 0; i < samples; ++i) {
    const double window = 0.5 * (1.0 - std::cos(turn * i / samples));
    l[i] = window * tracks.left(low + i * dx).f;
    r[i] = window * tracks.right(low + i * dx).f;
  }
  Powers sum;
  for (int k = static_cast<int>(std::ceil(from * length)); k < to * length; ++k) {
    std::complex<double> a = 0.0, b = 0.0, wave = 1.0;
    const std::complex<double> next = std::polar(1.0, -turn * k / samples);
    for (int i = 0; i < samples; ++i, wave *= next) a += l[i] * wave, b += r[i] * wave;
    sum.left += std::norm(a);
    sum.right += std::norm(b);
    sum.cross += (a * std::conj(b)).real();
  }
  return sum;
}

TEST(RandomTracks, CoherenceOfRealisations) {
  TrackSpectrum t;
  t.road.length = 320.0;
  t.width = 1.5;
  const int roads = 16;
  for (const double low : {0.05, 0.1, 0.2, 0.4}) {
    // What the spectrum says of the octave: int G g dn / int G dn.
    double expected = 0.0, total = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double n = low * std::pow(2.0, (k + 0.5) / 1000.0), power = 1.0 / n;  // G dn
      expected += power * track_coherence(t, n);
      total += power;
    }
    expected /= total;
    double mean = 0.0, squares = 0.0;
    for (int seed = 1; seed <= roads; ++seed) {
      t.road.seed = seed;
      const Powers p = powers(random_tracks(t), low, 2.0 * low, 10.0, 310.0);
      const double g = p.cross / std::sqrt(p.left * p.right);
      mean += g / roads;
      squares += g * g / roads;
    }
    const double error = std::sqrt((squares - mean * mean) / (roads - 1));
    EXPECT_LT(std::abs(mean - expected), 3.0 * error) << low << ": " << mean << " " << expected;
    EXPECT_LT(error, 0.08);
    std::printf("[ figure ] coherence from %g to %g cycles/m: %.3f +- %.3f, expected %.3f\n", low,
                2.0 * low, mean, error, expected);
  }
}

TEST(RandomTracks, Refused) {
  TrackSpectrum t;
  t.width = 0.0;
  EXPECT_EQ(error_of([&] { random_tracks(t); }), "out_of_range");
  t.width = 1.5;
  t.decay = -1.0;
  EXPECT_EQ(error_of([&] { random_tracks(t); }), "out_of_range");
  t.decay = 1.0;
  t.road.length = 0.0;
  EXPECT_EQ(error_of([&] { random_tracks(t); }), "out_of_range");
}

}  // namespace
}  // namespace floatframe::test

// Profiles of cams: the laws against their derivatives by differences, rises that begin and end at
// rest, turns that repeat, and splines through 720 points of 12 digits against the laws.
#include "floatframe/model/cam_profile.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/enum_index.hpp"

namespace floatframe::test {
namespace {

constexpr CamLaw all_cam_laws[] = {CamLaw::harmonic, CamLaw::cycloidal, CamLaw::polynomial_345,
                                   CamLaw::polynomial_4567};

TEST(CamRises, HaveTheDerivativesOfTheirLaws) {
  constexpr double h = 1e-5;
  for (const CamLaw law : all_cam_laws) {
    EXPECT_NEAR(cam_rise(law, 0.0).f, 0.0, 1e-15);
    EXPECT_NEAR(cam_rise(law, 1.0).f, 1.0, 1e-14);
    for (const double u : {0.0, 1.0}) {
      EXPECT_NEAR(cam_rise(law, u).df, 0.0, 1e-14);
      if (law != CamLaw::harmonic) {
        EXPECT_NEAR(cam_rise(law, u).ddf, 0.0, 1e-13);
      }
    }
    for (double u = 0.01; u < 1.0; u += 0.03) {
      const auto plus = cam_rise(law, u + h), minus = cam_rise(law, u - h), at = cam_rise(law, u);
      EXPECT_NEAR(at.df, (plus.f - minus.f) / (2.0 * h), 1e-8);
      EXPECT_NEAR(at.ddf, (plus.df - minus.df) / (2.0 * h), 1e-7);
    }
  }
}

/// Rise, dwell, return, dwell: a turn.
Cam turn_of(CamLaw law) {
  constexpr double pi = std::numbers::pi;
  Cam keys;
  keys.law = law;
  keys.segments = MatX{{0.75 * pi, 0.01}, {pi, 0.0}, {1.75 * pi, -0.01}, {2.0 * pi, 0.0}};
  return keys;
}

TEST(CamProfiles, ThatFillATurnRepeat) {
  Cam keys = turn_of(CamLaw::polynomial_345);
  keys.phase = 0.4;
  const CamProfile turns = cam_profile(keys, true), slides = cam_profile(keys, false);
  for (double x = 0.0; x < 6.2; x += 0.1) {
    const auto first = turns(x + 0.4), later = turns(x + 0.4 + 10.0 * std::numbers::pi);
    EXPECT_NEAR(first.f, later.f, 1e-15);
    EXPECT_NEAR(first.df, later.df, 1e-13);
    EXPECT_NEAR(first.f, slides(x + 0.4).f, 1e-15);
  }
  EXPECT_EQ(slides(-3.0).f, 0.0);
  EXPECT_NEAR(turns(0.4 + std::numbers::pi).f, 0.01, 1e-16);
  EXPECT_NEAR(turns.steepest(), 0.01 * 1.875 / (0.75 * std::numbers::pi), 1e-7);
}

TEST(CamProfiles, ThroughPointsOfALawAreTheLaw) {
  for (const CamLaw law : all_cam_laws) {
    const CamProfile exact = cam_profile(turn_of(law), true);
    Cam keys;
    keys.points.resize(721, 2);
    for (Eigen::Index k = 0; k <= 720; ++k) {
      const double x = 2.0 * std::numbers::pi * static_cast<double>(k) / 720.0;
      keys.points(k, 0) = std::stod(fmt::format("{:.12g}", x));
      keys.points(k, 1) = k == 720 ? 0.0 : std::stod(fmt::format("{:.12g}", exact(x).f));
    }
    const CamProfile spline = cam_profile(keys, true);
    EXPECT_GT(spline.period, 6.0);
    double error = 0.0, most = 0.0;
    for (double x = 0.001; x < 15.0; x += 0.0037) {
      most = std::max(most, std::abs(exact(x).ddf));
      error = std::max(error, std::abs(exact(x).ddf - spline(x).ddf));
      EXPECT_NEAR(exact(x).f, spline(x).f, 1e-7);
    }
    std::printf("[ figure ] cam_spline_%s %.1e\n", cam_laws[index_of(law)], error / most);
    if (law != CamLaw::harmonic) {  // whose acceleration jumps
      EXPECT_LT(error, 1e-3 * most);
    }
  }
}

}  // namespace
}  // namespace floatframe::test

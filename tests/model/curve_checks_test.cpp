// What curves and lifts must not have: gaps and ends, corners, crossings, each where it is known to
// be; and smooth ones have none of them.
#include "floatframe/model/curve_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/model/lift_checks.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

SpaceCurve curve_by(const char* x, const char* z, double from, double to, bool closed = false) {
  PointOnCurve keys;
  keys.x = formula(x);
  keys.z = formula(z);
  keys.range = MatX{{from, to}};
  keys.closed = closed;
  return SpaceCurve(keys);
}

TEST(CurveChecks, GapsAndEndsAreFound) {
  const auto step = curve_gap(curve_by("if(u < 0.5, u, u + 0.2)", "-0.1 * u", 0.0, 1.0));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->at, 0.5, 1e-12);
  EXPECT_NEAR(step->size, 0.2, 1e-12);
  const auto pole = curve_gap(curve_by("u", "-tan(u)", 0.0, 3.0));
  ASSERT_TRUE(pole);
  EXPECT_NEAR(pole->at, std::numbers::pi / 2.0, 1e-9);
  EXPECT_TRUE(std::isinf(pole->size));
  const auto even = curve_gap(curve_by("u", "1 / (u - 0.1234)^2", -1.0, 1.0));
  ASSERT_TRUE(even);
  EXPECT_NEAR(even->at, 0.1234, 1e-3);
}

TEST(CurveChecks, SmoothCurvesHaveNone) {
  for (const SpaceCurve& curve :
       {curve_by("0.5 * cos(u)", "0.5 * sin(u)", 0.0, 2.0 * std::numbers::pi, true),
        curve_by("u", "tanh(1000 * u)", -1.0, 1.0), curve_by("u + sin(u)", "1 - cos(u)", -2.6, 2.6),
        curve_by("u", "max(0, u)^2", -1.0, 1.0)}) {
    EXPECT_FALSE(curve_gap(curve));
    EXPECT_EQ(curve_corners(curve).count, 0u);
    EXPECT_FALSE(curve_crossing(curve));
  }
}

TEST(CurveChecks, CornersTurnTheTangent) {
  const CurveCorners one = curve_corners(curve_by("u", "abs(u - 0.3)", 0.0, 1.0));
  EXPECT_EQ(one.count, 1u);
  EXPECT_NEAR(one.at, 0.3, 1e-9);
  EXPECT_NEAR(one.angle, 90.0 * degree, 1e-9);
  EXPECT_FALSE(curve_gap(curve_by("u", "abs(u - 0.3)", 0.0, 1.0)));
  // Faster along the same line is no corner.
  EXPECT_EQ(curve_corners(curve_by("if(u < 0, u, 3 * u)", "0", -1.0, 1.0)).count, 0u);
  // A drop, whose ends meet at an angle.
  const CurveCorners drop =
      curve_corners(curve_by("sin(u)", "sin(2 * u)", 0.0, std::numbers::pi, true));
  EXPECT_EQ(drop.count, 1u);
  EXPECT_NEAR(drop.angle, std::numbers::pi - 2.0 * std::atan(2.0), 1e-6);
}

TEST(CurveChecks, CrossingsAreFound) {
  const auto eight = curve_crossing(
      curve_by("0.5 * sin(2 * u)", "0.5 * sin(u)", 0.1, 0.1 + 2.0 * std::numbers::pi, true));
  ASSERT_TRUE(eight);
  EXPECT_NEAR(std::sin(eight->u), 0.0, 1e-6);
  EXPECT_NEAR(std::abs(eight->u - eight->w), std::numbers::pi, 1e-6);
  PointOnCurve coil;  // many turns side by side
  coil.x = formula("cos(u)");
  coil.y = formula("sin(u)");
  coil.z = formula("0.02 * u");
  coil.range = MatX{{0.0, 300.0}};
  EXPECT_FALSE(curve_crossing(SpaceCurve(coil)));
}

CamProfile lift_by(const char* text) {
  Cam keys;
  keys.formula = formula(text);
  return cam_profile(keys, true);
}

TEST(LiftChecks, JumpsAndCornersAreWhereTheyAre) {
  const FormulaCorners jump = lift_corners(lift_by("if(x < 1, 0, 0.1)"), true, 0.0);
  ASSERT_TRUE(jump.jump);
  EXPECT_NEAR(jump.jump->at, 1.0, 1e-12);
  EXPECT_NEAR(jump.jump->size, 0.1, 1e-12);
  EXPECT_TRUE(lift_corners(lift_by("0.01 * floor(x)"), true, 0.0).jump);
  EXPECT_TRUE(lift_corners(lift_by("if(x < 0.01, 0, 1e-4)"), false, 0.0).jump);
  const FormulaCorners corner = lift_corners(lift_by("abs(x - 1)"), true, 0.0);
  EXPECT_FALSE(corner.jump);
  ASSERT_TRUE(corner.slope);
  EXPECT_EQ(corner.slopes, 1u);
  EXPECT_NEAR(corner.slope->at, 1.0, 1e-9);
  EXPECT_NEAR(corner.slope->size, 2.0, 1e-9);
}

TEST(LiftChecks, BendsAreCornersOfTheSlopeAlone) {
  const auto bend = lift_bend(lift_by("0.1 * max(0, sin(x))^2"), true, 0.3);
  ASSERT_TRUE(bend);
  EXPECT_NEAR(std::sin(*bend), 0.0, 1e-6);
  for (const char* none : {"0.1 * sin(x)", "max(0, sin(x))^4", "abs(x - 1)"})
    EXPECT_FALSE(lift_bend(lift_by(none), true, 0.3)) << none;
}

TEST(LiftChecks, EndsAreTheNearestOnes) {
  EXPECT_NEAR(lift_end(lift_by("sqrt(x)"), 0.05, 0.1).value_or(9.0), 0.0, 1e-9);
  EXPECT_NEAR(lift_end(lift_by("1 / (x - 1)"), 0.95, 0.1).value_or(9.0), 1.0, 1e-9);
  EXPECT_FALSE(lift_end(lift_by("sqrt(x)"), 0.5, 0.1));
  EXPECT_FALSE(lift_end(lift_by("sin(x)"), 0.5, 0.1));
}

/// A follower on a cam, and more lines of the model.
std::string follower_text(const std::string& cam, const std::string& start = "velocity: 3") {
  return R"(
bodies:
  shaft: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
  valve: {position: [0, 0, 1], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints:
  shaft: {type: revolute, child: shaft, at: [0, 0, 0], axis: y, )" +
         start + R"(}
  valve: {type: prismatic, child: valve, at: [0, 0, 1], axis: z}
couplings: {lift: {type: cam, follower: valve, cam: shaft, )" +
         cam + "}}\n";
}

std::string hint_of(const std::string& text) {
  std::string all;
  for (const std::string& note : build_model(description_of(text)).hints.notes) all += note + "\n";
  return all;
}

TEST(LiftChecks, OfCamsAreRefusedOrNoted) {
  EXPECT_EQ(hint_of(follower_text("formula: 0.1 * sin(x)")), "");
  expect_in(message_of<InputError>([] { hint_of(follower_text("formula: 0.01 * floor(x)")); }),
            "expected a lift without jumps: a follower cannot jump");
  expect_in(hint_of(follower_text("formula: abs(x - 1)")),
            "cam 'lift': its lift 'abs((x - 1))' has a corner at x = 1, where its slope changes by "
            "2: ");
  expect_in(hint_of(follower_text("formula: 'max(0, sin(x))^2'")),
            "cam 'lift': the slope of its lift");
  expect_in(hint_of(follower_text("points: [[0, 0], [1, 0.1], [6.28, 0.05]]")),
            "cam 'lift': its points span 6.28 rad, which is nearly a turn");
  expect_in(hint_of(follower_text("segments: [[1, 0.1], [6.29, -0.1]]")),
            "cam 'lift': its segments span 6.29 rad, which is nearly a turn");
  EXPECT_EQ(hint_of(follower_text("points: [[0, 0], [1, 0.1], [7, 0.05], [8, 0]]")), "");
}

std::string bead_text(const std::string& curve) {
  return "bodies: {bead: {position: [0.5, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}}\n"
         "constraints: {wire: {type: point_on_curve, from: {body: ground, at: [0, 0, 0]}, to: "
         "{body: bead}, " +
         curve + "}}\n";
}

TEST(CurveChecks, OfConstraintsAreRefusedOrNoted) {
  EXPECT_EQ(hint_of(bead_text("x: u, range: [0, 1]")), "");
  expect_in(message_of<InputError>(
                [] { hint_of(bead_text("x: \"if(u < 0.5, u, u + 0.2)\", range: [0, 1]")); }),
            "found a gap of 0.2 m in the curve at u = 0.5, expected none within its range");
  expect_in(
      message_of<InputError>([] { hint_of(bead_text("x: u, z: -tan(u), range: [0, 3]")); }),
      "found a curve without a place at u = 1.5708, expected one that has no end within its range");
  expect_in(hint_of(bead_text("x: u, z: abs(u - 0.5), range: [0, 1]")),
            "constraint 'wire': its curve has a corner at u = 0.5, where its tangent turns by 90 "
            "degrees: ");
  expect_in(hint_of(bead_text("x: u, z: 0.3, range: [0, 1]")),
            "constraint 'wire': its point is drawn 0.3 m from its curve: the start moves it there");
  expect_in(
      hint_of(bead_text("x: 0.5 * sin(2 * u), z: 0.5 * sin(u), range: [0, 6.283185307179586], "
                        "closed: true")),
      "constraint 'wire': its curve crosses or meets itself at u = ");
}

// A disc of 0.1 m whose centre is 0.1 m above the plate, or more.
TEST(CurveChecks, CurvesThatAreDrawnApartAreNoted) {
  const auto disc_at = [](const std::string& z) {
    return "bodies: {disc: {position: [0, 0, " + z +
           "], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}}\n"
           "constraints: {roll: {type: curve_on_curve, from: {body: ground, at: [0, 0, 0]}, to: "
           "{body: disc}, axis: y, x: u, range: [-1, 1], x_2: 0.1 * cos(u), z_2: 0.1 * sin(u), "
           "range_2: [0, 6.283185307179586], closed_2: true}}\n";
  };
  EXPECT_EQ(hint_of(disc_at("0.1")), "");
  expect_in(hint_of(disc_at("0.15")),
            "constraint 'roll': its curves are drawn 0.05 m from where they touch: the start moves "
            "them there");
}

}  // namespace
}  // namespace floatframe::test

// Curves that touch, in both formulations: circles as a rod, an eccentric under a flat follower and
// under a roller as closed forms, a spline, and curves that could touch in two places.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string circle(double radius, double x, const char* ending) {
  return fmt::format(
      "x{0}: {1} + {2} * cos(u), z{0}: {2} * sin(u), range{0}: [0, 6.283185307179586], closed{0}: "
      "true",
      ending, x, radius);
}

/// A disc of 0.1 m on one of 0.2 m, by curves or by the rod between their centres.
std::string disc_on_disc(bool curves) {
  const double a = 0.4, L = 0.3;
  const std::string held =
      curves ? fmt::format(
                   "constraints: {{c: {{type: curve_on_curve, from: {{body: ground, at: [0, "
                   "0, 0]}}, to: {{body: disc}}, axis: y, {}, {}}}}}",
                   circle(0.2, 0.0, ""), circle(0.1, 0.0, "_2"))
             : "rods: {c: {from: {body: ground, at: [0, 0, 0]}, to: {body: disc}}}";
  return fmt::format(R"(
bodies: {{disc: {{position: [{:.17g}, 0, {:.17g}],
  rigid: {{mass: 2, inertia: [0.01, 0.01, 0.01]}}}}}}
joints: {{plane: {{type: planar, child: disc, at: [0, 0, 0], axis: y, axis_2: x}}}}
{}
outputs: {{x: {{position: disc, axis: x}}, z: {{position: disc, axis: z}}}}
simulation: {{step: 1.0e-3, duration: 0.5, tolerance: 1.0e-13, position_tolerance: 1.0e-13}}
)",
                     L * std::sin(a), L * std::cos(a), held);
}

TEST(CurveOnCurve, OfCirclesIsARod) {
  const Model touching = model_of(disc_on_disc(true)), rod = model_of(disc_on_disc(false));
  for (const Coordinates c : both_coordinates) {
    const RunResult a = completed_run(touching, with(touching.simulation, c)),
                    b = completed_run(rod, with(rod.simulation, c));
    for (std::size_t i = 0; i < a.table.rows(); ++i) {
      EXPECT_NEAR(std::hypot(a.table.at(i, 1), a.table.at(i, 2)), 0.3, 1e-11);
      EXPECT_NEAR(a.table.at(i, 1), b.table.at(i, 1), 1e-9);
      EXPECT_NEAR(a.table.at(i, 2), b.table.at(i, 2), 1e-9);
    }
    EXPECT_LT(a.table.at(a.table.rows() - 1, 2), 0.2);  // it slides down
  }
}

/// An eccentric of 0.05 m, 0.02 m off its axis, that turns with 10 rad/s under a follower.
std::string eccentric(const std::string& cam, const std::string& follower, double height) {
  return fmt::format(R"(
bodies:
  cam: {{position: [0, 0, 0], rigid: {{mass: 1, inertia: [0.01, 0.01, 0.01]}}}}
  follower: {{position: [0, 0, {}], rigid: {{mass: 0.5, inertia: [0.01, 0.01, 0.01]}}}}
joints:
  shaft: {{type: revolute, child: cam, at: [0, 0, 0], axis: y, motion: {{velocity: 10}}}}
  guide: {{type: prismatic, child: follower, at: [0, 0, 0], axis: z}}
constraints: {{c: {{type: curve_on_curve,
  from: {{body: cam, at: [0, 0, 0]}}, to: {{body: follower}}, axis: y, {}, {}}}}}
outputs: {{s: {{joint_position: guide}}, F: {{joint_force: {{constraint: c}}}}}}
simulation: {{step: 1.0e-3, duration: 1, tolerance: 1.0e-13, position_tolerance: 1.0e-13}}
)",
                     height, cam, follower);
}

// s = -e sin(wt); the force carries m (g + sddot), along the axis of the guide.
TEST(CurveOnCurve, OfAnEccentricUnderAFlatFollowerIsASine) {
  const double e = 0.02, w = 10.0;
  const Model model =
      model_of(eccentric(circle(0.05, 0.02, ""), "x_2: u, range_2: [-0.1, 0.1]", 0.05));
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t i = 0; i < r.table.rows(); ++i) {
      const double angle = w * r.table.at(i, 0);
      EXPECT_NEAR(r.table.at(i, 1), -e * std::sin(angle), 1e-9);
      EXPECT_NEAR(r.table.at(i, 2), 0.0, 1e-8);
      EXPECT_NEAR(r.table.at(i, 4), 0.5 * (9.81 + e * w * w * std::sin(angle)), 1e-6);
    }
  }
}

// Under a roller of 0.03 m the centres keep 0.08 m: s = -e sin(wt) + sqrt(L^2 - (e cos(wt))^2).
TEST(CurveOnCurve, OfAnEccentricUnderARollerIsASliderCrank) {
  const double e = 0.02, L = 0.08, height = std::sqrt(L * L - e * e);
  for (const bool roller_first : {false, true}) {
    std::string text = eccentric(circle(0.05, 0.02, ""), circle(0.03, 0.0, "_2"), height);
    if (roller_first) {
      text = eccentric(circle(0.03, 0.0, ""), circle(0.05, 0.02, "_2"), height);
      text.replace(text.find("from: {body: cam, at: [0, 0, 0]}, to: {body: follower}"), 54,
                   "from: {body: follower}, to: {body: cam, at: [0, 0, 0]}");
    }
    const Model model = model_of(text);
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      for (std::size_t i = 0; i < r.table.rows(); i += 10) {
        const double angle = 10.0 * r.table.at(i, 0), x = e * std::cos(angle);
        EXPECT_NEAR(r.table.at(i, 1), -e * std::sin(angle) + std::sqrt(L * L - x * x) - height,
                    1e-9);
      }
    }
  }
}

// A closed spline through 90 points of the eccentric.
TEST(CurveOnCurve, OfASplineIsThatOfItsCurve) {
  std::string points = "points: [";
  for (int k = 0; k < 90; ++k) {
    const double u = 2.0 * std::numbers::pi * k / 90.0;
    points += fmt::format("{}[{:.15g}, 0, {:.15g}]", k > 0 ? ", " : "", 0.02 + 0.05 * std::cos(u),
                          0.05 * std::sin(u));
  }
  const Model model = model_of(
      eccentric(points + "], closed: true", "points_2: [[-0.1, 0, 0], [0.1, 0, 0]]", 0.05));
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t i = 0; i < r.table.rows(); ++i)
      EXPECT_NEAR(r.table.at(i, 1), -0.02 * std::sin(10.0 * r.table.at(i, 0)), 1e-6);
  }
}

// A wave and a plate, and a roller that does not fit into a hollow.
TEST(CurveOnCurve, CurvesThatCouldTouchTwiceAreRefused) {
  const auto refused = [](const std::string& cam, const std::string& follower) {
    return error_of([&] { model_of(eccentric(cam, follower, 0.05)); });
  };
  const std::string wave = "x: u, z: 0.01 * cos(50 * u), range: [-0.1, 0.1]";
  for (const std::string& follower :
       {std::string("x_2: u, range_2: [-0.1, 0.1]"), circle(0.05, 0.0, "_2")})
    EXPECT_NE(refused(wave, follower).find(": geometry"), std::string::npos);
  EXPECT_EQ(refused(wave, circle(0.03, 0.0, "_2")), "no error");
}

// A groove that is sharper at its bottom than the eccentric below it, and wider further up. From
// outside they could touch in one place, on the other side of the cam, which is not what is drawn.
TEST(CurveOnCurve, AnotherPairThanTheDrawnOneIsNotTaken) {
  const auto refused = [](const std::string& follower) {
    return error_of([&] { model_of(eccentric(circle(0.05, 0.0, ""), follower, 0.05)); });
  };
  EXPECT_NE(refused("x_2: u, z_2: -100 * u^2, range_2: [-0.06, 0.06]").find(": geometry"),
            std::string::npos);
  EXPECT_EQ(refused("x_2: u, z_2: -4 * u^2, range_2: [-0.06, 0.06]"), "no error");
  EXPECT_EQ(refused("x_2: u, z_2: 100 * u^2, range_2: [-0.06, 0.06]"), "no error");
}

}  // namespace
}  // namespace floatframe::test

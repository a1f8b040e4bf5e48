// A swing axle on the rig: toe, camber, track and wheel rate against closed forms.
#include "floatframe/vehicle/suspension_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/vehicle/rig_report.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

// Two wheels on arms of the length 0.5 m that turn about longitudinal hinges at the height of the
// wheel centres; torsion springs of 2000 N m/rad. No weight.
const char* const swing_axle = R"(
gravity: [0, 0, 0]
bodies:
  chassis: {position: [0, 0, 0.3], rigid: {mass: 500, inertia: [100, 100, 100]}}
  left:
    position: [0, 0.7, 0.3]
    rigid: {mass: 20, inertia: [1, 1, 1], centre_of_mass: [0, 0.7, 0.3]}
  right:
    position: [0, -0.7, 0.3]
    rigid: {mass: 20, inertia: [1, 1, 1], centre_of_mass: [0, -0.7, 0.3]}
joints:
  left: {type: revolute, parent: chassis, child: left, at: [0, 0.2, 0.3], axis: x}
  right: {type: revolute, parent: chassis, child: right, at: [0, -0.2, 0.3], axis: x}
forces:
  left_spring: {type: joint_spring, joint: left, spring: 2000}
  right_spring: {type: joint_spring, joint: right, spring: 2000}
  left_tyre: {type: force, body: left, direction: z, magnitude: 100}
  right_tyre: {type: force, body: right, direction: z, magnitude: 100}
vehicle:
  chassis: chassis
  axles:
    only: {left: {wheel: left, tyre: left_tyre}, right: {wheel: right, tyre: right_tyre}}
)";

TEST(SuspensionRig, SwingAxleInClosedForm) {
  const ModelDescription d = description_of(swing_axle);
  const RigOptions options{.travel = 0.05, .points = 11};
  for (const RigSweep sweep : {RigSweep::travel, RigSweep::roll}) {
    const auto points = suspension_sweep(d, sweep, options);
    ASSERT_EQ(points.size(), 11u);
    for (const RigPoint& p : points) {
      const RigAxle& a = p.axles[0];
      // The arm is at the angle s with 0.5 sin s = z; the wheel stays normal to it.
      const double s = std::asin(p.travel / 0.5), c = std::cos(s);
      const double other = sweep == RigSweep::roll ? -s : s;
      EXPECT_NEAR(a.left.height, p.travel, 1e-9);
      EXPECT_NEAR(a.left.camber, -s, 1e-9);
      EXPECT_NEAR(a.right.camber, -other, 1e-9);
      EXPECT_NEAR(a.left.toe, 0.0, 1e-9);
      const double half = 0.2 + 0.5 * c + 0.3 * std::sin(s);
      const double half_right = 0.2 + 0.5 * c + 0.3 * std::sin(other);
      EXPECT_NEAR(a.track, half + half_right, 1e-9);
      EXPECT_NEAR(a.left.force, 2000.0 * s / (0.5 * c), 1e-5);
    }
    // At the design height dF/dz = k/l^2; parabolas through points 1 cm apart.
    EXPECT_NEAR(points[5].axles[0].left.rate, 2000.0 / 0.25, 8.0);
  }
}

TEST(SuspensionRig, FiguresAndWhatIsMissing) {
  ModelDescription d = description_of(swing_axle);
  const RigFigures figures = suspension_figures(d, {.travel = 0.02, .points = 3});
  EXPECT_TRUE(figures.steer.empty());
  EXPECT_TRUE(contains(rig_report("axle", figures).text, "only, parallel travel"));
  EXPECT_TRUE(contains(sentences_of([&] { suspension_sweep(d, RigSweep::steer, {}); }),
                       "found no 'steering'"));
  d.vehicle.reset();
  EXPECT_TRUE(contains(sentences_of([&] { suspension_figures(d, {}); }), "no section 'vehicle'"));
}

}  // namespace
}  // namespace floatframe::test

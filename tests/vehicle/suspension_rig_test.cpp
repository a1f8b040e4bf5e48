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
    EXPECT_NEAR(*points[5].axles[0].left.rate, 2000.0 / 0.25, 8.0);
  }
}

// Knuckles that slide along z on the chassis, and wheels that turn on them about kingpins 0.1 m
// within and 0.02 m ahead of the wheel centres, held by torsion springs of 1e5 N m/rad.
const char* const kingpins = R"(
gravity: [0, 0, 0]
bodies:
  chassis: {position: [0, 0, 0.3], rigid: {mass: 500, inertia: [100, 100, 100]}}
  left_knuckle: {position: [0.02, 0.6, 0.3], rigid: {mass: 10, inertia: [1, 1, 1]}}
  right_knuckle: {position: [0.02, -0.6, 0.3], rigid: {mass: 10, inertia: [1, 1, 1]}}
  left: {position: [0, 0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
  right: {position: [0, -0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
joints:
  left_slide:
    {type: prismatic, parent: chassis, child: left_knuckle, at: [0.02, 0.6, 0.3], axis: z}
  right_slide:
    {type: prismatic, parent: chassis, child: right_knuckle, at: [0.02, -0.6, 0.3], axis: z}
  left_pin: {type: revolute, parent: left_knuckle, child: left, at: [0.02, 0.6, 0.3], axis: z}
  right_pin: {type: revolute, parent: right_knuckle, child: right, at: [0.02, -0.6, 0.3], axis: z}
forces:
  left_spring: {type: joint_spring, joint: left_pin, spring: 1e5}
  right_spring: {type: joint_spring, joint: right_pin, spring: 1e5}
  left_tyre: {type: force, body: left, direction: z, magnitude: 100}
  right_tyre: {type: force, body: right, direction: z, magnitude: 100}
vehicle:
  chassis: chassis
  axles:
    only: {left: {wheel: left, tyre: left_tyre}, right: {wheel: right, tyre: right_tyre}}
)";

// The moment of the load about the kingpin over the stiffness, turned by it to first order: half
// the difference of both senses leaves the third.
TEST(SuspensionRig, ComplianceOfKingpins) {
  const auto all = suspension_compliance(description_of(kingpins));
  ASSERT_EQ(all.size(), 3u);
  const double stiffness = 1e5;
  for (const RigCompliance& c : all) {
    const RigWheel &left = c.axles[0].left, &right = c.axles[0].right;
    const double moment = c.load == RigLoad::lateral   ? -0.02 * 1000.0
                          : c.load == RigLoad::braking ? 0.1 * 1000.0
                                                       : 100.0;
    const double other = c.load == RigLoad::braking ? -moment : moment;
    EXPECT_NEAR(left.steer, moment / stiffness, 1e-6 * std::abs(moment) / stiffness + 1e-8);
    EXPECT_NEAR(right.steer, other / stiffness, 1e-6 * std::abs(moment) / stiffness + 1e-8);
    EXPECT_NEAR(left.toe, -left.steer, 1e-14);
    // The centre is at (-0.02, 0.1) from its kingpin.
    EXPECT_NEAR(left.x, -0.1 * left.steer, 1e-7);
    EXPECT_NEAR(left.y, -0.02 * left.steer, 1e-7);
    EXPECT_NEAR(left.camber, 0.0, 1e-9);
    EXPECT_NEAR(left.height, 0.0, 1e-9);
  }
}

TEST(SuspensionRig, FiguresAndWhatIsMissing) {
  ModelDescription d = description_of(swing_axle);
  const RigFigures figures = suspension_figures(d, {.travel = 0.02, .points = 3});
  EXPECT_TRUE(figures.steer.empty());
  EXPECT_TRUE(contains(rig_report("axle", figures).text, "only, parallel travel"));
  EXPECT_TRUE(contains(rig_report("axle", figures).text, "lateral force, per kN"));
  EXPECT_TRUE(contains(sentences_of([&] { suspension_sweep(d, RigSweep::steer, {}); }),
                       "found no 'steering'"));
  d.vehicle.reset();
  EXPECT_TRUE(contains(sentences_of([&] { suspension_figures(d, {}); }), "no section 'vehicle'"));
}

}  // namespace
}  // namespace floatframe::test

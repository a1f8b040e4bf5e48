// Constraints of points and directions against closed forms, in both formulations: a bead on a
// wire, a puck on a plane, bodies whose axes stay parallel or at a right angle, shafts with a joint
// of constant velocity.
#include <gtest/gtest.h>

#include <cmath>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

RunResult run_in(const std::string& text, Coordinates c) {
  ModelDescription d = description_of(text);
  d.simulation.coordinates = c;
  return completed_run(d);
}

// A body of 2 kg slides down a wire that is inclined by the angle of 3-4-5.
TEST(InLineConstraint, IsABeadOnAWire) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(R"(
bodies: {bead: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.01, 0.01, 0.01]}}}
constraints:
  wire: {type: in_line, from: {body: ground, at: [0, 0, 0]}, to: {body: bead}, axis: [4, 0, -3]}
outputs:
  p: {position: bead}
  F: {joint_force: {constraint: wire}}
simulation: {step: 1.0e-3, duration: 1}
)",
                               c);
    const std::size_t end = r.table.rows() - 1;
    const double g = 9.81, s = 0.5 * 0.6 * g, normal = 2.0 * g * 0.8;
    EXPECT_NEAR(r.table.at(end, 1), 0.8 * s, 1e-6 * s);
    EXPECT_NEAR(r.table.at(end, 2), 0.0, 1e-12);
    EXPECT_NEAR(r.table.at(end, 3), -0.6 * s, 1e-6 * s);
    EXPECT_NEAR(r.table.at(end, 4), 0.6 * normal, 1e-8 * normal);
    EXPECT_NEAR(r.table.at(end, 5), 0.0, 1e-8 * normal);
    EXPECT_NEAR(r.table.at(end, 6), 0.8 * normal, 1e-8 * normal);
  }
}

// A puck of 0.5 kg, thrown along an inclined plane: a parabola in the plane.
TEST(InPlaneConstraint, IsAPuckOnAnIncline) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(R"(
bodies: {puck: {position: [0, 0, 0], rigid: {mass: 0.5, inertia: [0.01, 0.01, 0.01]}}}
joints:
  free: {type: free, child: puck, at: [0, 0, 0], velocity: [0, 2, 0, 0, 0, 0]}
constraints:
  table: {type: in_plane, from: {body: ground, at: [0, 0, 0]}, to: {body: puck}, axis: [3, 0, 4]}
outputs:
  p: {position: puck}
  F: {joint_force: {constraint: table}}
simulation: {step: 1.0e-3, duration: 1}
)",
                               c);
    const std::size_t end = r.table.rows() - 1;
    const double g = 9.81, s = 0.5 * 0.6 * g, normal = 0.5 * g * 0.8;
    EXPECT_NEAR(r.table.at(end, 1), 0.8 * s, 1e-6 * s);
    EXPECT_NEAR(r.table.at(end, 2), 2.0, 1e-9);
    EXPECT_NEAR(r.table.at(end, 3), -0.6 * s, 1e-6 * s);
    EXPECT_NEAR(r.table.at(end, 4), 0.6 * normal, 1e-8 * normal);
    EXPECT_NEAR(r.table.at(end, 6), 0.8 * normal, 1e-8 * normal);
  }
}

// A top whose axis stays upright: it turns about z alone, and the moment across is held.
TEST(ParallelConstraint, LeavesTheTurnAboutTheAxis) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(R"(
gravity: [0, 0, 0]
bodies: {top: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.3, 0.2, 0.4]}}}
constraints:
  upright: {type: parallel, from: {body: ground, at: [0, 0, 0]}, to: {body: top}, axis: z}
forces: {turn: {type: torque, body: top, direction: [5, 0, 1], magnitude: 1}}
outputs:
  w: {angular_velocity: top}
  M: {joint_torque: {constraint: upright}}
simulation: {step: 1.0e-3, duration: 1}
)",
                               c);
    const std::size_t end = r.table.rows() - 1;
    EXPECT_NEAR(r.table.at(end, 1), 0.0, 1e-10);
    EXPECT_NEAR(r.table.at(end, 2), 0.0, 1e-10);
    // Turns in absolute coordinates have an error of the step.
    EXPECT_NEAR(r.table.at(end, 3), 1.0 / 0.4, c == Coordinates::relative ? 1e-9 : 1e-5);
    EXPECT_NEAR(r.table.at(end, 4), -5.0, 1e-8);
    EXPECT_NEAR(r.table.at(end, 5), 0.0, 1e-8);
    EXPECT_NEAR(r.table.at(end, 6), 0.0, 1e-8);
  }
}

// x of the body stays normal to z of the ground: of a moment about y nothing is left.
TEST(PerpendicularConstraint, TakesTheMomentAboutTheCommonNormal) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(R"(
gravity: [0, 0, 0]
bodies: {plate: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}}
constraints:
  square:
    type: perpendicular
    from: {body: ground, at: [0, 0, 0]}
    to: {body: plate}
    axis: z
    axis_2: x
forces: {turn: {type: torque, body: plate, direction: [0.2, 3, 0], magnitude: 1}}
outputs:
  w: {angular_velocity: plate}
  M: {joint_torque: {constraint: square}}
simulation: {step: 1.0e-3, duration: 1}
)",
                               c);
    const std::size_t end = r.table.rows() - 1;
    // Turns in absolute coordinates have an error of the step.
    EXPECT_NEAR(r.table.at(end, 1), 2.0, c == Coordinates::relative ? 1e-9 : 1e-5);
    EXPECT_NEAR(r.table.at(end, 2), 0.0, 1e-10);
    EXPECT_NEAR(r.table.at(end, 3), 0.0, 1e-10);
    EXPECT_NEAR(r.table.at(end, 4), 0.0, 1e-8);
    EXPECT_NEAR(r.table.at(end, 5), -3.0, 1e-8);
  }
}

/// Two shafts at 40 degrees; the first one turns at 20 rad/s, the second one is braked with 3 N m.
std::string shafts(const char* joint) {
  return R"(
parameters: {tilt: 0.6981317007977318}
gravity: [0, 0, 0]
bodies:
  one: {position: [-1, 0, 0], rigid: {mass: 1, inertia: [0.02, 0.03, 0.03]}}
  two: {position: [1, 0, 0], rigid: {mass: 1, inertia: [0.05, 0.05, 0.05]}}
joints:
  one: {type: revolute, child: one, at: [0, 0, 0], axis: x, motion: {velocity: 20}}
  two: {type: revolute, child: two, at: [0, 0, 0], axis: ["${cos(tilt)}", "${sin(tilt)}", 0]}
constraints:
  joint: )" +
         std::string(joint) + R"(
forces:
  brake: {type: joint_spring, joint: two, actuator: -3}
outputs:
  one: {joint_position: one}
  two: {joint_position: two}
  motor: {motion_force: one}
  M: {joint_torque: {constraint: joint}}
simulation: {step: 1.0e-3, duration: 2}
)";
}

// The angles are the same at any time, unlike those of a universal joint; so is the moment along
// the shafts. The moment of the joint lies in the plane that bisects them.
TEST(ConstantVelocityConstraint, TurnsShaftsByTheSameAngle) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(
        shafts(
            "{type: constant_velocity, from: {body: one, at: [0, 0, 0]}, to: {body: two, at: "
            "[0, 0, 0]}, axis: x, axis_2: [\"${cos(tilt)}\", \"${sin(tilt)}\", 0], slides: true}"),
        c);
    const double tilt = 0.6981317007977318;
    for (std::size_t k = 0; k < r.table.rows(); k += 100) {
      EXPECT_NEAR(r.table.at(k, 2), r.table.at(k, 1), 1e-9);
      EXPECT_NEAR(r.table.at(k, 3), 3.0, 1e-7);
      const Vec3 M(r.table.at(k, 4), r.table.at(k, 5), r.table.at(k, 6));
      const Vec3 bisector(1.0 + std::cos(tilt), std::sin(tilt), 0.0);
      // Of the homokinetic plane, which is normal to the bisector: M = m (z_a + z_b) / (1 + cos).
      EXPECT_LT((M - 3.0 * bisector / (1.0 + std::cos(tilt))).norm(), 1e-7);
    }
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 40.0, 1e-9);
  }
}

// With its points it carries a shaft that has no bearing of its own in the middle.
TEST(ConstantVelocityConstraint, HoldsThePointsToo) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run_in(R"(
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.02, 0.03, 0.03]}}
  two: {position: [0.5, 0, 0], rigid: {mass: 2, inertia: [0.01, 0.04, 0.04]}}
joints:
  one: {type: revolute, child: one, at: [0, 0, 0], axis: x, velocity: 10}
constraints:
  joint:
    type: constant_velocity
    from: {body: one, at: [0, 0, 0]}
    to: {body: two, at: [0, 0, 0]}
    axis: x
    axis_2: x
outputs:
  p: {distance: {from: {body: one, at: [0, 0, 0]}, to: {body: two, at: [0, 0, 0]}}}
  F: {joint_force: {constraint: joint}}
simulation: {step: 1.0e-3, duration: 0.2}
)",
                               c);
    for (std::size_t k = 0; k < r.table.rows(); ++k) EXPECT_LT(r.table.at(k, 1), 1e-9);
    // A bar that begins to fall about its end: R = m g (1 - m l^2 / (m l^2 + J)).
    EXPECT_NEAR(r.table.at(0, 4), 2.0 * 9.81 * (1.0 - 0.5 / 0.54), 1e-8);
  }
}

}  // namespace
}  // namespace floatframe::test

// Friction as a key of joints: an incline at its angle, no drift below breakaway, stick-slip,
// brakes by their signals.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/stepping/stepping.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double gravity = 9.81;

/// 2 kg on a slope with the coefficient 0.5; the slide points downhill.
std::string incline(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return R"(
bodies: {block: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints:
  slope: {type: prismatic, child: block, at: [0, 0, 0], axis: [)" +
         std::to_string(c) + ", 0, " + std::to_string(-s) + R"(],
    friction: {breakaway: 0.5, stiffness: 1e5, damping: 200, normal: )" +
         std::to_string(2.0 * gravity * c) + R"(}}
outputs: {x: {joint_position: slope}, f: {force: slope.friction}}
simulation: {step: 1.0e-3, duration: 2, spectral_radius: 0.8}
)";
}

// It slides from atan(0.5) on, with the acceleration g (sin a - 0.5 cos a).
TEST(JointFriction, HoldsABlockUpToItsAngle) {
  const double edge = std::atan(0.5);
  for (const Coordinates c : both_coordinates) {
    for (const double part : {0.5, 0.99, 0.999}) {
      const Model model = model_of(incline(part * edge));
      const RunResult r = completed_run(model, with(model.simulation, c));
      const std::size_t last = r.table.rows() - 1;
      EXPECT_LT(std::abs(r.table.at(last, 1)), 2e-5) << part;
      EXPECT_LT(std::abs(r.table.at(last, 1) - r.table.at(last / 2, 1)), 1e-9) << part;
      EXPECT_NEAR(r.table.at(last, 2), 2.0 * gravity * std::sin(part * edge), 1e-3) << part;
    }
    for (const double part : {1.01, 1.5}) {
      const double a = part * edge, rate = gravity * (std::sin(a) - 0.5 * std::cos(a));
      const Model model = model_of(incline(a));
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 2.0 * rate, 2e-3 * 2.0 * rate) << part;
    }
  }
}

/// Pulled with 0.6 of breakaway, for 10 s.
std::string pulled(const std::string& friction, double shaken) {
  return R"(
bodies: {sledge: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints: {slide: {type: prismatic, child: sledge, at: [0, 0, 0], axis: x, friction: {breakaway: 20,
  stiffness: 1e6, damping: 1e3)" +
         friction + R"(}}}
forces: {p: {type: force, body: sledge, direction: x, magnitude: {polynomial: [12],
  sine: {amplitude: )" +
         std::to_string(shaken) + R"(, frequency: 10}}}}
outputs: {x: {joint_position: slide}}
simulation: {step: 1.0e-3, duration: 11, spectral_radius: 0.8}
)";
}

double drift_of_friction(const Model& model, Coordinates c) {
  const RunResult r = completed_run(model, with(model.simulation, c));
  return std::abs(r.table.at(11000, 1) - r.table.at(1000, 1));
}

TEST(JointFriction, DoesNotDriftBelowBreakaway) {
  const Model still = model_of(pulled("", 0.0)), shaken = model_of(pulled("", 6.0));
  for (const Coordinates c : both_coordinates) {
    EXPECT_LT(drift_of_friction(still, c), 1e-9);
    EXPECT_LT(drift_of_friction(shaken, c), 1e-9);
  }
  // The choice that creeps, as docs/model-file.md says.
  const double creep =
      drift_of_friction(model_of(pulled(", elastic: 0", 6.0)), Coordinates::relative);
  figure("creep of the LuGre model in 10 s [m]", creep);
  EXPECT_GT(creep, 1e-5);
}

// A block on a belt, held by a spring: it sticks for 2 D / (k V) and slips for
// 2 / w (pi - atan(D w / (k V))), D the fall from breakaway to the kinetic friction.
TEST(JointFriction, SticksAndSlipsWithItsPeriod) {
  const double k = 1000.0, V = 0.1, D = 4.0, w = std::sqrt(k);
  const double period =
      2.0 * D / (k * V) + 2.0 / w * (std::numbers::pi - std::atan(D * w / (k * V)));
  const Model model = model_of(R"(
bodies:
  belt: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  block: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  drive: {type: prismatic, child: belt, at: [0, 0, 0], axis: x, motion: {velocity: 0.1}}
  rub: {type: prismatic, parent: belt, child: block, at: [0, 0, 0], axis: x,
    friction: {breakaway: 10, kinetic: 6, stribeck: 3.0e-4, stiffness: 1e7, damping: 3000}}
forces:
  s: {type: spring_damper, from: {body: ground, at: [-1, 0, 0]}, to: {body: block, at: [0, 0, 0]},
    spring: {linear: {stiffness: 1000, free: 1}}}
outputs: {v: {velocity: {body: block}, axis: x}}
simulation: {step: 2.0e-5, duration: 1.3, spectral_radius: 0.8}
)");
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    std::vector<double> slips;  // instants at which the block turns back
    for (std::size_t i = 1; i < r.table.rows(); ++i) {
      const double a = r.table.at(i - 1, 1), b = r.table.at(i, 1);
      if (a > 0.0 && b <= 0.0) slips.push_back(r.table.at(i, 0) - 2e-5 * b / (b - a));
    }
    ASSERT_GE(slips.size(), 4u);
    const double found = (slips.back() - slips[1]) / (std::ssize(slips) - 2.0);
    EXPECT_NEAR(found, period, 0.01 * period) << name_of(c);
    figure("stick-slip period, " + name_of(c), found / period - 1.0);
  }
}

/// A disc of 0.1 kg m2 with a brake of the radius 0.15 m, the coefficient 0.4, 20 N of preload.
std::string braked(const std::string& clamp) {
  return R"(
inputs: {clamp: {unit: N}}
bodies: {disc: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints:
  axle: {type: revolute, child: disc, at: [0, 0, 0], axis: z, velocity: 20,
    friction: {breakaway: 0.4, stiffness: 400, damping: 1, radius: 0.15, preload: 20, normal: )" +
         clamp + R"(}}
outputs: {w: {joint_velocity: axle}, f: {force: axle.friction}}
simulation: {step: 1.0e-3, duration: 1, spectral_radius: 0.8}
)";
}

TEST(JointFriction, IsTheTorqueOfABrakeByItsSignal) {
  // N = 20 + 400 t: the speed is 20 - 0.06 / 0.1 (20 t + 200 t^2), and 0 at t = 0.361 s.
  const Model ramp = model_of(braked("{table: [[0, 0], [1, 400]]}"));
  const Model pedal = model_of(braked("{input: clamp}"));
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(ramp, with(ramp.simulation, c));
    EXPECT_NEAR(r.table.at(300, 1), 20.0 - 0.6 * (6.0 + 18.0), 3e-3);
    EXPECT_NEAR(r.table.at(300, 2), 0.06 * 140.0, 2e-3);
    EXPECT_NEAR(r.table.at(1000, 1), 0.0, 1e-6);
    Simulation s(pedal, {.coordinates = c});
    for (const double clamp : {0.0, 100.0, 40.0}) {
      s.set_input("clamp", clamp);
      for (int k = 0; k < 50; ++k) ASSERT_TRUE(s.step()) << s.failure();
      EXPECT_NEAR(s.output("f"), 0.06 * (clamp + 20.0), 1e-6);
    }
    // A clamp that pulls the faces apart.
    s.set_input("clamp", -30.0);
    ASSERT_TRUE(s.step());
    EXPECT_EQ(s.output("f"), 0.0);
  }
}

// A cylindrical joint: friction on its displacement leaves its angle alone, and vice versa.
TEST(JointFriction, ActsOnTheCoordinateThatIsNamed) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies:
  rod: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
  cross: {position: [0, 1, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  tube: {type: cylindrical, child: rod, at: [0, 0, 0], axis: x, velocity: [1, 5],
    friction: {displacement: {breakaway: 4, stiffness: 1e5, damping: 500}}}
  hub: {type: universal, child: cross, at: [0, 1, 0], axis: x, axis_2: z, velocity: [2, 0],
    friction: {angle about axis: {breakaway: 0.25, stiffness: 100, damping: 1}}}
outputs: {x: {joint_velocity: tube, coordinate: 1}, a: {joint_velocity: tube, coordinate: 2},
  h: {joint_velocity: hub, coordinate: 1}}
simulation: {step: 1.0e-3, duration: 0.4, spectral_radius: 0.8}
)");
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 1.0 - 4.0 / 2.0 * 0.4, 1e-6);
    // Turns in absolute coordinates have an error of the step.
    const bool exact = c == Coordinates::relative;
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 2), 5.0, exact ? 1e-9 : 1e-5);
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 3), 2.0 - 2.5 * 0.4, exact ? 1e-6 : 1e-5);
  }
}

}  // namespace
}  // namespace floatframe::test

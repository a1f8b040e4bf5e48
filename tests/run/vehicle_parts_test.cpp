// Parts of vehicles made of joints, couplings and forces, as docs/vehicle-models.md writes them: a
// rack whose ratio is a table, a column with a torsion bar, a driven axle with a differential and a
// brake that sticks, anti-roll bars, a damper from a file. Closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr const char* steering_text = R"(
gravity: [0, 0, 0]
bodies:
  box: {rigid: {mass: 100, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
  rack: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
  hand_wheel: {rigid: {mass: 1, centre_of_mass: [0, 0, 0.3], inertia: [0.03, 0.03, 0.03]}}
  column: {rigid: {mass: 1, centre_of_mass: [0, 0, 0.3], inertia: [0.01, 0.01, 0.01]}}
joints:
  box: {type: weld, child: box, at: [0, 0, 0]}
  rack: {type: prismatic, parent: box, child: rack, at: [0, 0, 0], axis: y}
  column: {type: revolute, parent: box, child: column, at: [0, 0, 0.3], axis: [-0.9, 0, 0.4]}
  torsion: {type: revolute, parent: column, child: hand_wheel, at: [0, 0, 0.3],
    axis: [-0.9, 0, 0.4]}
couplings:
  pinion: {type: cam, follower: rack, cam: column,
    points: [[-8, 0.064], [-4, 0.03], [-2, 0.0142], [0, 0], [2, -0.0142], [4, -0.03], [8, -0.064]]}
forces:
  torsion: {type: joint_spring, joint: torsion, spring: 120, damper: 1}
  rods: {type: joint_spring, joint: rack, spring: 2.0e5, damper: 2000}
  hands: {type: torque, body: hand_wheel, direction: [-0.9, 0, 0.4],
    magnitude: ${4 / sqrt(0.97)}}
outputs:
  rack: {joint_position: rack}
simulation: {step: 0.01, duration: 0.1, start: equilibrium}
)";

// A torque T on the steering wheel twists the torsion bar by T / k and holds the rack where its
// spring gives T = k_rack x dx/dq.
TEST(VehicleParts, RackWithATableAndATorsionBar) {
  const Model model = model_of(steering_text);
  const StaticsResult s = statics(model);
  double twist = 0.0, rack_force = 0.0, rack = 0.0;
  for (const StaticsForce& f : s.forces) {
    if (f.name == "torsion") twist = f.length;
    if (f.name == "rods") rack_force = f.force, rack = f.length;
  }
  EXPECT_NEAR(twist, 4.0 / 120.0, 1e-9);
  EXPECT_NEAR(std::abs(rack_force), 2.0e5 * std::abs(rack), 1e-6);
  // The slope of the spline near the middle, that of its chords there within 3 %.
  EXPECT_NEAR(4.0 / std::abs(rack_force), 0.0071, 2e-4);
  EXPECT_LT(rack, 0.0);
}

std::string axle_text(double throttle) {
  return R"(
bodies:
  car: {rigid: {mass: 500, centre_of_mass: [0, 0, 0.5], inertia: [100, 200, 200]}}
  knuckle_l: {rigid: {mass: 10, centre_of_mass: [0, 0.7, 0.3], inertia: [0.5, 0.5, 0.5]}}
  knuckle_r: {rigid: {mass: 10, centre_of_mass: [0, -0.7, 0.3], inertia: [0.5, 0.5, 0.5]}}
  rim_l: {rigid: {mass: 20, centre_of_mass: [0, 0.7, 0.3], inertia: [1, 1.5, 1]}}
  rim_r: {rigid: {mass: 20, centre_of_mass: [0, -0.7, 0.3], inertia: [1, 1.5, 1]}}
  cage: {rigid: {mass: 1, centre_of_mass: [0, 0, 0.3], inertia: [0.05, 0.05, 0.05]}}
joints:
  car: {type: weld, child: car, at: [0, 0, 0.5]}
  steer_l: {type: revolute, parent: car, child: knuckle_l, at: [0, 0.7, 0.3], axis: z, motion: 0.3}
  steer_r: {type: revolute, parent: car, child: knuckle_r, at: [0, -0.7, 0.3], axis: z,
    motion: 0.25}
  spin_l: {type: revolute, parent: knuckle_l, child: rim_l, at: [0, 0.7, 0.3], axis: y,
    friction: {breakaway: 1, stiffness: 2000, damping: 2, normal: {steps: [[1, 300]]}}}
  spin_r: {type: revolute, parent: knuckle_r, child: rim_r, at: [0, -0.7, 0.3], axis: y}
  cage: {type: revolute, parent: car, child: cage, at: [0, 0, 0.3], axis: y}
couplings:
  differential: {type: differential, left: spin_l, right: spin_r, cage: cage}
inputs:
  throttle: {unit: N m, initial: )" +
         std::to_string(throttle) + R"(}
controllers:
  engine: {type: limiter, input: {input: throttle}, lower: 0, upper: 250}
forces:
  drive: {type: joint_spring, joint: cage, actuator: {controller: engine}}
outputs:
  left: {joint_velocity: spin_l}
  right: {joint_velocity: spin_r}
  brake: {force: spin_l.friction}
simulation: {step: 0.001, duration: 3}
)";
}

// The engine gives 250 N m at most, to the cage with I = 0.05; wheels have J = 1.5.
TEST(VehicleParts, DifferentialAndABrakeThatSticks) {
  const RunResult r = completed_run(model_of(axle_text(400.0)));
  const auto at = [&](double t, const char* name) {
    return entry(r.table, static_cast<std::size_t>(std::lround(t / 0.001)), name);
  };
  // Both alike: T = (2 J + I) alpha. The left one held: T/2 = (J + I/4) alpha of the right one.
  EXPECT_NEAR(at(1.0, "left"), 250.0 / 3.05, 1e-9 * 82);
  EXPECT_NEAR(at(1.0, "right"), 250.0 / 3.05, 1e-9 * 82);
  const double alpha = 125.0 / 1.5125;
  EXPECT_NEAR(at(3.0, "right") - at(2.5, "right"), 0.5 * alpha, 1e-6);
  EXPECT_NEAR(at(3.0, "left"), 0.0, 1e-9);
  EXPECT_NEAR(at(3.0, "brake"), 1.5 * alpha, 1e-5);
  // While it brakes: 300 N m and the torque of the shafts.
  const double slower = at(1.1, "left") - at(1.4, "left");
  const double faster = at(1.4, "right") - at(1.1, "right");
  EXPECT_NEAR(slower + faster, 0.3 * 300.0 / 1.5, 1e-6);
  const RunResult gentle = completed_run(model_of(axle_text(100.0)));
  EXPECT_NEAR(entry(gentle.table, 1000, "left"), 100.0 / 3.05, 1e-8);
}

std::string arms_text(const std::string& right, const std::string& bar) {
  return R"(
gravity: [0, 0, 0]
bodies:
  car: {rigid: {mass: 500, centre_of_mass: [0, 0, 0.5], inertia: [100, 200, 200]}}
  arm_l: {rigid: {mass: 10, centre_of_mass: [0, 0.6, 0.3], inertia: [0.5, 0.5, 0.5]}}
  arm_r: {rigid: {mass: 10, centre_of_mass: [0, -0.6, 0.3], inertia: [0.5, 0.5, 0.5]}}
  lever_l: {rigid: {mass: 1, centre_of_mass: [-0.2, 0.4, 0.3], inertia: [0.01, 0.01, 0.01]}}
  lever_r: {rigid: {mass: 1, centre_of_mass: [-0.2, -0.4, 0.3], inertia: [0.01, 0.01, 0.01]}}
joints:
  car: {type: weld, child: car, at: [0, 0, 0.5]}
  left: {type: revolute, parent: car, child: arm_l, at: [0, 0.2, 0.3], axis: x}
  right: {type: revolute, parent: car, child: arm_r, at: [0, -0.2, 0.3], axis: [-1, 0, 0]}
  bar: {type: revolute, parent: car, child: lever_l, at: [-0.3, 0, 0.3], axis: y}
  twist: {type: revolute, parent: lever_l, child: lever_r, at: [-0.3, 0, 0.3], axis: y}
rods:
  drop_l: {from: {body: lever_l, at: [-0.1, 0.4, 0.3]}, to: {body: arm_l, at: [-0.1, 0.4, 0.2]}}
  drop_r: {from: {body: lever_r, at: [-0.1, -0.4, 0.3]}, to: {body: arm_r, at: [-0.1, -0.4, 0.2]}}
forces:
  left: {type: joint_spring, joint: left, spring: 5000}
  right: {type: joint_spring, joint: right, spring: 5000}
  load_l: {type: torque, body: arm_l, direction: x, magnitude: 0.05}
  load_r: {type: torque, body: arm_r, direction: x, magnitude: )" +
         right + R"(}
)" + bar +
         R"(
outputs: {left: {joint_position: left}}
simulation: {step: 0.01, duration: 0.01, start: equilibrium}
)";
}

double left_arm(const std::string& right, const std::string& bar) {
  return entry(completed_run(model_of(arms_text(right, bar))).table, 0, "left");
}

// Three ways to write a bar of 1000 N m/rad between the angles of the arms. Levers of 0.2 m on
// drop links 0.2 m beside the hinges of the arms: the twist is the difference of the angles.
TEST(VehicleParts, AntiRollBars) {
  const std::string torsion = "  twist: {type: joint_spring, joint: twist, spring: 1000}\n";
  const std::string formulas =
      "  bar_l: {type: joint_spring, joint: left, "
      "actuator: {formula: \"-1000 * (angle(left) - angle(right))\"}}\n"
      "  bar_r: {type: joint_spring, joint: right, "
      "actuator: {formula: \"1000 * (angle(left) - angle(right))\"}}\n";
  const std::string gear =
      "couplings:\n"
      "  bar: {type: gear, driver: left, driven: right, ratio: 1, mesh_stiffness: 1000}\n";
  for (const std::string& bar : {torsion, formulas, gear}) {
    // In bounce both arms turn alike, against each other in the world: the bar does nothing.
    EXPECT_NEAR(left_arm("-0.05", bar), 0.05 / 5000.0, 1e-12) << bar;
    EXPECT_NEAR(left_arm("0.05", bar), 0.05 / (5000.0 + 2.0 * 1000.0), 2e-10) << bar;
  }
}

}  // namespace
}  // namespace floatframe::test

// Machines whose controllers are formulas: a satellite with wheels, a gas spring with a table of
// two variables.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/stepping/stepping.hpp"
#include "support/completed_run.hpp"
#include "support/linear_models.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A satellite that turns into a direction by three wheels whose torques are limited.
const std::string satellite = R"(
gravity: [0, 0, 0]
parameters: {kp: 2, kd: 12, most: 0.3}
bodies:
  sat: {rigid: {mass: 100, centre_of_mass: [0, 0, 0], inertia: [20, 30, 25]}}
  wx: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.05, 0.03, 0.03]}}
  wy: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.03, 0.05, 0.03]}}
  wz: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.03, 0.03, 0.05]}}
joints:
  free:
    type: free
    child: sat
    at: [0, 0, 0]
    position: [0, 0, 0, 0.8, -0.5, 0.4]
    velocity: [0, 0, 0, 0.02, 0.03, -0.01]
  x: {type: revolute, parent: sat, child: wx, at: [0, 0, 0], axis: x}
  y: {type: revolute, parent: sat, child: wy, at: [0, 0, 0], axis: y}
  z: {type: revolute, parent: sat, child: wz, at: [0, 0, 0], axis: z}
measures:
  q: {quaternion: sat}
  w: {angular_velocity: sat, in: sat}
forces:
  mx: {type: joint_spring, joint: x, actuator: {formula: 'clip(kp * q.x + kd * w.x, -most, most)'}}
  my: {type: joint_spring, joint: y, actuator: {formula: 'clip(kp * q.y + kd * w.y, -most, most)'}}
  mz: {type: joint_spring, joint: z, actuator: {formula: 'clip(kp * q.z + kd * w.z, -most, most)'}}
outputs:
  L: {angular_momentum: model}
  qw: {quaternion: sat, component: w}
  torque: {force: mx}
simulation: {step: 0.01, duration: 90, output_interval: 0.5}
)";

TEST(FormulaMachines, ASatelliteTurnsAndKeepsItsMomentum) {
  const Model model = model_of(satellite);
  const auto drift = [&](double step, Coordinates coordinates) {
    SimulationDescription o = with(model.simulation, coordinates);
    o.step = step;
    o.duration = 10.0;
    const std::vector<double> rows = completed_run(model, o).table.data;
    double most = 0.0;
    for (std::size_t k = 0; k + 5 < rows.size(); k += 6)
      for (std::size_t i = 1; i < 4; ++i) most = std::max(most, std::abs(rows[k + i] - rows[i]));
    return most;
  };
  for (const Coordinates c : both_coordinates) {
    const double coarse = drift(0.02, c), fine = drift(0.01, c);
    // Absolute coordinates resolve the spin of the wheels, 0.3 rad per step, less exactly.
    EXPECT_LT(fine, c == Coordinates::relative ? 2e-6 : 0.05);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3);
  }
  const std::vector<double> rows = completed_run(model, model.simulation).table.data;
  EXPECT_LT(rows[4], 0.9);
  EXPECT_EQ(std::abs(rows[5]), 0.3);                        // at its limit
  EXPECT_NEAR(std::abs(rows[rows.size() - 2]), 1.0, 1e-6);  // there
}

TEST(FormulaMachines, AGasSpringByATableOfTwoVariables) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
inputs: {T: {initial: 350}}
tables:
  gas: {grid: {x: [0.1, 0.2, 0.4], y: [300, 400], values: [[900, 1200], [450, 600], [225, 300]]}}
bodies: {piston: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}}
joints: {slide: {type: prismatic, child: piston, at: [0, 0, 0], axis: x, position: 0.25}}
forces:
  gas: {type: joint_spring, joint: slide, actuator: {formula: 'table2(gas, angle(slide), T) - 500'}}
outputs: {x: {joint_position: slide}, f: {force: gas}, v: {joint_velocity: slide}}
simulation: {step: 0.0005, duration: 0.2}
)");
  for (const Coordinates c : both_coordinates) {
    const std::vector<double> rows = completed_run(model, with(model.simulation, c)).table.data;
    for (std::size_t k = 0; k + 3 < rows.size(); k += 4) {
      const double x = rows[k + 1];
      const double p = x < 0.2 ? 1050 + (x - 0.1) * -5250 : 525 + (x - 0.2) * -1312.5;
      EXPECT_NEAR(-rows[k + 2], p - 500, 1e-9 * 500);
    }
  }
}

}  // namespace
}  // namespace floatframe::test

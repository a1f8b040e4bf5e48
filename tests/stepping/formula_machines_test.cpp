// Machines whose controllers are formulas: a satellite with wheels, an engine whose gas is a table
// of crank angle and load.
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
  EXPECT_LT(drift(1e-3, Coordinates::relative), 1e-7);  // [N m s]
  const std::vector<double> rows = completed_run(model, model.simulation).table.data;
  EXPECT_LT(rows[4], 0.9);
  EXPECT_EQ(std::abs(rows[5]), 0.3);                        // at its limit
  EXPECT_NEAR(std::abs(rows[rows.size() - 2]), 1.0, 1e-6);  // there
}

// The pressure of the gas is a table of crank angle and load.
const std::string engine = R"(
gravity: [0, 0, 0]
parameters: {crank: 0.05, rod: 0.15, area: 0.005, turn: 6.283185307179586}
points: {o: [0, 0, 0], c: ['${crank}', 0, 0], p: ['${crank + rod}', 0, 0]}
inputs: {load: {initial: 0.7}}
tables:
  gas:
    grid:
      x: [0, 1.2, 3.0, '${turn}']
      y: [0, 1]
      values: [[1e5, 30e5], [3e5, 12e5], [1e5, 2e5], [1e5, 30e5]]
bodies:
  crank: {rigid: {mass: 5, centre_of_mass: o, inertia: [0.02, 0.02, 0.02]}}
  rod: {rigid: {mass: 0.5, centre_of_mass: ['${crank + rod/3}', 0, 0], inertia: [1e-4, 2e-3, 2e-3]}}
  piston: {rigid: {mass: 0.4, centre_of_mass: p, inertia: [1e-4, 1e-4, 1e-4]}}
joints:
  main: {type: revolute, child: crank, at: o, axis: z, velocity: 100}
  pin: {type: revolute, parent: crank, child: rod, at: c, axis: z}
  bore: {type: prismatic, child: piston, at: p, axis: x}
  wrist: {type: spherical, parent: rod, child: piston, at: p}
forces:
  gas:
    type: joint_spring
    joint: bore
    actuator:
      formula: '-area * table2(gas, angle(main) - turn * floor(angle(main) / turn), load)'
outputs: {a: {joint_position: main}, f: {force: gas}, x: {joint_position: bore}}
simulation: {step: 0.0001, duration: 0.2}
)";

TEST(FormulaMachines, AnEngineByATableOfAngleAndLoad) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const auto pressure = [](double angle) {
    const std::vector<double> x{0.0, 1.2, 3.0, turn}, idle{1e5, 3e5, 1e5, 1e5},
        full{30e5, 12e5, 2e5, 30e5};
    angle -= turn * std::floor(angle / turn);
    std::size_t k = 2;
    while (x[k] > angle) --k;
    const double s = (angle - x[k]) / (x[k + 1] - x[k]);
    const auto at = [&](const std::vector<double>& p) { return (1.0 - s) * p[k] + s * p[k + 1]; };
    return 0.3 * at(idle) + 0.7 * at(full);
  };
  const Model model = model_of(engine);
  std::vector<double> ends;
  for (const Coordinates c : both_coordinates) {
    const std::vector<double> rows = completed_run(model, with(model.simulation, c)).table.data;
    for (std::size_t k = 0; k + 3 < rows.size(); k += 4) {
      EXPECT_NEAR(rows[k + 2], 0.005 * pressure(rows[k + 1]), 1e-8);
      const double a = rows[k + 1];
      EXPECT_NEAR(rows[k + 3],
                  0.05 * std::cos(a) + std::sqrt(0.0225 - std::pow(0.05 * std::sin(a), 2)) - 0.2,
                  1e-8);
    }
    ends.push_back(rows[rows.size() - 3]);
  }
  EXPECT_LT(ends[0], -turn);  // the gas turned it backwards, more than a turn
  EXPECT_NEAR(ends[0], ends[1], 1e-2);
}

}  // namespace
}  // namespace floatframe::test

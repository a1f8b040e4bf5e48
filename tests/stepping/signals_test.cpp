// Signals between elements, and controllers: poles and motions against closed forms, order, both
// formulations, loops, rings, limits, saved simulations.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A box of 3 kg that a controller pulls to 0.2 m.
std::string controlled_box(const std::string& pid, const std::string& more = "") {
  return R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}}
forces: {motor: {type: joint_spring, joint: slide, actuator: {controller: hold}}}
controllers: {hold: {type: pid, measured: {length: motor}, )" +
         pid + R"(}}
outputs: {x: {joint_position: slide}, u: {controller: hold}, f: {force: motor}}
simulation: {step: 0.01, duration: 0.6}
)" + more;
}
const std::string whole_pid =
    "target: 0.2, proportional: 300, integral: 500, derivative: 20, filter: 0.02";

/// Of (x, v, i, filtered error), the target being 0.
MatX controlled_box_matrix() {
  const double m = 3.0, kp = 300.0, ki = 500.0, kd = 20.0, T = 0.02;
  MatX A = MatX::Zero(4, 4);
  A(0, 1) = 1.0;
  A.row(1) << -(kp + kd / T) / m, 0.0, 1.0 / m, -kd / T / m;
  A(2, 0) = -ki;
  A.row(3) << -1.0 / T, 0.0, 0.0, -1.0 / T;
  return A;
}

/// x and the value of the controller, by the exponential of the matrix. The filter begins at the
/// error.
Eigen::Vector2d exact_control(double t) {
  const GeneralEigen e = general_eigen(controlled_box_matrix());
  Eigen::VectorXcd x(4);
  x << -0.2, 0.0, 0.0, 0.2;
  x = e.vectors.partialPivLu().solve(x).eval();
  x.array() *= (e.values.array() * t).exp();
  const VecX y = (e.vectors * x).real();
  return {0.2 + y[0], 3.0 * controlled_box_matrix().row(1).dot(y)};
}

class Signals : public ::testing::TestWithParam<std::tuple<Coordinates, double>> {};

TEST_P(Signals, StatesOfControllersConvergeWithOrderTwo) {
  const auto [coordinates, rho] = GetParam();
  const Model model = model_of(controlled_box(whole_pid));
  const Eigen::Vector2d exact = exact_control(0.6);
  double errors[2][2];
  for (int k = 0; k < 2; ++k) {
    SimulationDescription o = with(model.simulation, coordinates, k == 0 ? 4e-3 : 2e-3, 0.6);
    o.spectral_radius = rho;
    const RunResult r = completed_run(model, o);
    const auto row = r.table.data.end() - 4;
    errors[k][0] = std::abs(row[1] - exact[0]);
    errors[k][1] = std::abs(row[2] - exact[1]);
    EXPECT_NEAR(row[3], -row[2], 1e-12);
  }
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(errors[0][i] / errors[1][i]), 2.0, 0.15) << i;
  EXPECT_LT(errors[1][0], 1e-4);
}

// The tangent contains the signals: a linear system takes one Newton iteration and one that
// confirms it, however stiff the controller is.
TEST_P(Signals, NewtonIsExactWithStiffControllers) {
  const auto [coordinates, rho] = GetParam();
  const Model model = model_of(controlled_box(
      "target: 0.2, proportional: 3e6, integral: 5e6, derivative: 2e4, filter: 0.02"));
  SimulationOptions o{.coordinates = coordinates};
  o.spectral_radius = rho;
  Simulation s(model, o);
  for (int k = 0; k < 40; ++k) {
    const StepReport report = s.step();
    ASSERT_TRUE(report) << s.failure();
    EXPECT_LE(report.iterations, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Signals,
                         ::testing::Combine(::testing::ValuesIn(both_coordinates),
                                            ::testing::Values(1.0, 0.8)));

TEST(SignalsLinear, PolesOfAControlledBoxAreExact) {
  const Model model = model_of(controlled_box(whole_pid.substr(whole_pid.find("prop"))));
  const GeneralEigen own = general_eigen(controlled_box_matrix());
  for (const Coordinates c : both_coordinates) {
    const LinearSystem s = linear_system(model, {.coordinates = c});
    ASSERT_EQ(s.A.rows(), 4);
    EXPECT_EQ(s.states[1], "state 1 of pid 'hold'");
    for (const LinearMode& mode : linear_modes(s))
      EXPECT_LT((own.values.array() - mode.lambda).abs().minCoeff(), 1e-9 * 30.0);
  }
}

/// An arm in gravity that a controller alone holds.
const std::string held_arm = R"(
bodies: {arm: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}}
joints: {hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: [0, -1, 0]}}
forces: {motor: {type: joint_spring, joint: hinge, actuator: {controller: hold}}}
controllers:
  hold: {type: pid, measured: {length: motor}, rate: {rate: motor}, target: 0.4,
         proportional: 60, integral: 90, derivative: 8}
outputs: {q: {joint_position: hinge}, u: {controller: hold}}
simulation: {step: 0.001, duration: 0.3, start: equilibrium}
)";

TEST(SignalsStart, AnArmIsHeldByItsControllerAlone) {
  const Model model = model_of(held_arm);
  const double load = 2.0 * 9.81 * 0.3 * std::cos(0.4);
  const StaticsResult s = statics(model);
  EXPECT_NEAR(s.forces[0].length, 0.4, 1e-9);
  EXPECT_NEAR(s.forces[1].force, load, 1e-6);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t k = 0; k + 2 < r.table.data.size(); k += 3) {
      EXPECT_NEAR(r.table.data[k + 1], 0.4, 1e-8);
      EXPECT_NEAR(r.table.data[k + 2], load, 1e-5);
    }
  }
  // J xdd + (60 - m g l sin) x + 8 xd - i = 0, idot = -90 x
  const double inertia = 0.06 + 2.0 * 0.09, slope = 60.0 - 2.0 * 9.81 * 0.3 * std::sin(0.4);
  MatX A = MatX::Zero(3, 3);
  A(0, 1) = 1.0;
  A.row(1) << -slope / inertia, -8.0 / inertia, 1.0 / inertia;
  A(2, 0) = -90.0;
  const GeneralEigen own = general_eigen(A);
  const LinearSystem linear = linear_system(model);
  ASSERT_EQ(linear.A.rows(), 3);
  for (const LinearMode& mode : linear_modes(linear))
    EXPECT_LT((own.values.array() - mode.lambda).abs().minCoeff(), 1e-9 * 30.0);
}

// From a start at which the value is limited; and where the limit holds the arm back.
TEST(SignalsStart, LimitsDoNotHideAnEquilibrium) {
  std::string text = held_arm;
  text.replace(text.find("target: 0.4"), 11, "target: 1.2, lower: -40, upper: 40");
  const StaticsResult far = statics(model_of(text));
  EXPECT_NEAR(far.forces[0].length, 1.2, 1e-9);
  EXPECT_NEAR(far.forces[1].force, 2.0 * 9.81 * 0.3 * std::cos(1.2), 1e-6);
  EXPECT_TRUE(far.notes.empty());
  text.replace(text.find("1.2, lower: -40, upper: 40"), 26, "0.4, lower: -3, upper: 3");
  const StaticsResult weak = statics(model_of(text));
  EXPECT_NEAR(weak.forces[1].force, 3.0, 1e-9);
  ASSERT_FALSE(weak.notes.empty());
  EXPECT_EQ(weak.notes.back(),
            "pid 'hold' rests at a limit: what it measures may be away from its target");
}

TEST(SignalsStart, AnIntegralThatNeverRestsIsNamed) {
  std::string text = held_arm;
  text.replace(text.find("{length: motor}"), 15, "1");
  EXPECT_EQ(error_of([&] { statics(model_of(text)); }), "no_equilibrium");
}

// A flexible crank in a loop, its slider held by a controller; absolute = relative, and the account
// of energy is closed.
TEST(SignalsLoop, AbsoluteIsRelative) {
  std::string text = flexible_loop;
  text.replace(text.find("spring: 900, damper: 3"), 22, "actuator: {controller: hold}");
  text.insert(text.find("simulation:"), R"(
controllers:
  hold: {type: pid, measured: {length: push}, target: {sine: {amplitude: 0.02, frequency: 3}},
         proportional: 2000, integral: 4000, derivative: 40, filter: 0.005, lower: -30, upper: 30}
outputs: {x: {joint_position: guide}, u: {controller: hold}}
)");
  const Model model = model_of(text);
  std::vector<double> ends[2];
  for (const Coordinates c : both_coordinates) {
    SimulationDescription o = with(model.simulation, c, 5e-4, 0.2);
    o.start = Start::given;
    const RunResult r = completed_run(model, o);
    ends[c == Coordinates::relative].assign(r.table.data.end() - 2, r.table.data.end());
    EXPECT_LT(r.summary.energy.largest_remainder, 2e-3 * r.summary.energy.exchanged);
  }
  EXPECT_NEAR(ends[0][0], ends[1][0], 1e-7);
  EXPECT_NEAR(ends[0][1], ends[1][1], 2e-3);
}

TEST(SignalsLimits, AreExactAndTheIntegralReturns) {
  const Model model = model_of(controlled_box(
      "target: 1, proportional: 60, integral: 30, derivative: 20, filter: 0.02, upper: 3"));
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o{.coordinates = c};
    o.locate_edges = true;
    Simulation s(model, o);
    while (s.time() < 0.3 - 1e-9) ASSERT_TRUE(s.step()) << s.failure();
    EXPECT_NEAR(s.output("u"), 3.0, 1e-12);
    EXPECT_NEAR(s.output("x"), 0.5 * 0.3 * 0.3, 1e-9);
    double largest = 0.0;
    while (s.time() < 8.0 - 1e-9) {
      ASSERT_TRUE(s.step()) << s.failure();
      largest = std::max(largest, s.output("x"));
    }
    EXPECT_NEAR(s.output("x"), 1.0, 5e-3);
    EXPECT_LT(largest, 1.15);  // an integral that winds up overshoots by half
  }
}

// a = 2 (1 - exp(-t/2)): a ring with one state.
TEST(SignalsRing, FollowsTogether) {
  std::string text = controlled_box("proportional: 1");
  text.replace(text.find("controllers: {"), 14, R"(controllers: {
  a: {type: pid, measured: {controller: b}, target: 1, integral: 1},
  b: {type: pid, measured: {controller: a}, proportional: -0.5},
  )");
  text.replace(text.find("u: {controller: hold}"), 21, "u: {controller: a}");
  const Model model = model_of(text);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 0.6));
    EXPECT_NEAR(*(r.table.data.end() - 2), 2.0 * (1.0 - std::exp(-0.3)), 1e-7);
    const LinearSystem s = linear_system(model, {.coordinates = c});
    double found = 1.0;
    for (const LinearMode& mode : linear_modes(s))
      if (std::abs(mode.lambda + 0.5) < std::abs(found + 0.5)) found = mode.lambda.real();
    EXPECT_NEAR(found, -0.5, 1e-9);
  }
}

TEST(SignalsRing, WithoutAStateIsAnError) {
  std::string text = controlled_box("proportional: 1");
  text.replace(text.find("controllers: {"), 14, R"(controllers: {
  a: {type: pid, measured: {controller: b}, proportional: 1},
  b: {type: pid, measured: {controller: a}, proportional: -0.5},
  )");
  EXPECT_EQ(without_folders(error_of([&] { model_of(text); })), "model.yaml:9:3: contradiction");
}

// A loop whose gains cancel has no solution: its value would be that of nothing.
TEST(SignalsRing, WhoseGainsCancelIsRefused) {
  std::string text = controlled_box("target: 0.1, proportional: -1, integral: 1");
  text.replace(text.find("{length: motor}"), 15, "{controller: hold}");
  const Model model = model_of(text);
  EXPECT_EQ(error_of([&] { Simulation s(model, {}); }), "no_convergence");
  EXPECT_EQ(error_of([&] { linear_system(model); }), "no_convergence");
}

// The filter begins at the error, which depends on what it gives: no kick at the start.
TEST(SignalsRing, AFilterBeginsAtTheErrorOfTheRing) {
  std::string text = controlled_box("target: 1, proportional: 0.5, derivative: 0.05, filter: 0.05");
  text.replace(text.find("{length: motor}"), 15, "{force: motor, factor: 0.1}");
  const Simulation s(model_of(text), {});
  EXPECT_NEAR(s.output("u"), 0.5 / 0.95, 1e-12);
}

// At rest the force of a bushing is nothing and its size has no derivative.
TEST(SignalsOfForces, AreNumbersWhereNothingActs) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies: {a: {position: [0, 0, 0], rigid: {mass: 3, inertia: [1, 1, 1]}},
         b: {position: [1, 0, 0], rigid: {mass: 2, inertia: [1, 1, 1]}}}
joints:
  ja: {type: prismatic, child: a, at: [0, 0, 0], axis: x}
  jb: {type: prismatic, child: b, at: [1, 0, 0], axis: x}
forces:
  el: {type: bushing, from: {body: a, at: [0.5, 0, 0]}, to: {body: b, at: [0.5, 0, 0]},
       spring_x: 100}
  m: {type: joint_spring, joint: ja, spring: 100, damper: 1, actuator: {force: el, factor: 0.1}}
outputs: {xa: {joint_position: ja}}
simulation: {step: 0.002, duration: 0.1}
)");
  for (const Coordinates c : both_coordinates) {
    EXPECT_EQ(*(completed_run(model, with(model.simulation, c)).table.data.end() - 1), 0.0);
    EXPECT_TRUE(linear_system(model, {.coordinates = c}).A.allFinite());
  }
}

// The wear of a brake whose clamp is a spring, and a force that follows the force of a spring.
TEST(SignalsOfForces, ActOnOtherForces) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies:
  box: {position: [0, 0, 0], rigid: {mass: 3}}
  shoe: {position: [0, 1, 0], rigid: {mass: 1}}
joints:
  slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, velocity: 2}
  press: {type: prismatic, child: shoe, at: [0, 1, 0], axis: x, position: -0.02}
forces:
  clamp: {type: joint_spring, joint: press, spring: 1000, damper: 60}
  hold: {type: force, body: shoe, at: [0, 1, 0], direction: x, magnitude: {force: clamp}}
  brake: {type: bristle_friction, joint: slide, breakaway: 0.3, stiffness: 1e5, damping: 300,
          normal: {force: clamp, factor: -1}}
outputs: {x: {joint_position: slide}, v: {joint_velocity: slide}, s: {joint_position: press}}
simulation: {step: 0.001, duration: 0.5}
)");
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 0.2));
    const auto row = r.table.data.end() - 4;
    EXPECT_NEAR(row[3], -0.02, 1e-9);                         // the spring is balanced by itself
    EXPECT_NEAR(row[2], 2.0 - 0.3 * 20.0 / 3.0 * 0.2, 2e-4);  // N = 20
  }
}

Model controlled_machine() {
  std::string text = stepped_machine;
  text.insert(text.find("outputs:"), R"(
  motor: {type: joint_spring, joint: spin, actuator: {controller: b}}
  tow: {type: force, body: slider, at: c, direction: x, magnitude: {force: creep, factor: 0.1}}
controllers:
  a: {type: pid, measured: {length: motor}, target: 13, proportional: 3, integral: 4,
      derivative: 0.1, filter: 0.01, lower: -2, upper: 2}
  b: {type: pid, measured: {controller: b, factor: 0.5}, target: {controller: a},
      integral: 30, proportional: 0.1}
)");
  return model_of(text);
}

TEST(SignalsSaved, GoOnWithEqualBits) {
  const Model model = controlled_machine();
  for (const Coordinates c : both_coordinates)
    for (const bool located : {false, true}) {
      SimulationOptions o{.coordinates = c};
      o.locate_edges = located;
      Simulation s(model, o);
      trace(s, 0, 60);
      const SimulationState saved = s.save();
      const std::vector<double> first = trace(s, 60, 120);
      s.restore(saved);
      EXPECT_TRUE(equal_bits(trace(s, 60, 120), first));
    }
}

TEST(SignalsSaved, StepsDoNotAllocate) {
  const Model model = controlled_machine();
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    trace(s, 0, 20);
    const AllocationScope scope;
    for (int k = 0; k < 40; ++k) s.step();
    EXPECT_EQ(scope.count(), 0u);
  }
}

}  // namespace
}  // namespace floatframe::test

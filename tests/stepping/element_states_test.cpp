// Elements with states: order, both formulations, linear systems, starts and saved simulations.
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

const std::string creeping_box = R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, position: 0.1, velocity: 0.4}}
forces:
  s: {type: joint_spring, joint: slide, spring: 40}
  m: {type: maxwell, from: {body: ground, at: [-1, 0, 0]}, to: {body: box, at: [0, 0, 0]},
      branches: [[90, 30], [200, 7]]}
outputs: {x: {joint_position: slide}, f: {force: m}}
simulation: {step: 0.01, duration: 0.6}
)";

/// Of (x, v, z1, z2), with z counted from the natural lengths.
MatX creeping_box_matrix() {
  MatX A = MatX::Zero(4, 4);
  A(0, 1) = 1.0;
  A.row(1) << -(40.0 + 290.0) / 3.0, 0.0, 30.0, 200.0 / 3.0;
  A.row(2) << 3.0, 0.0, -3.0, 0.0;
  A.row(3) << 200.0 / 7.0, 0.0, 0.0, -200.0 / 7.0;
  return A;
}

/// x and the force of the branches, by the exponential of the matrix; the dampers begin at 0.1.
Eigen::Vector2d exact_creep(double t) {
  const GeneralEigen e = general_eigen(creeping_box_matrix());
  Eigen::VectorXcd x(4);
  x << 0.1, 0.4, 0.1, 0.1;
  x = e.vectors.partialPivLu().solve(x).eval();
  x.array() *= (e.values.array() * t).exp();
  const VecX y = (e.vectors * x).real();
  return {y[0], 90.0 * (y[0] - y[2]) + 200.0 * (y[0] - y[3])};
}

class ElementStates : public ::testing::TestWithParam<std::tuple<Coordinates, double>> {};

TEST_P(ElementStates, ConvergeWithOrderTwo) {
  const auto [coordinates, rho] = GetParam();
  const Model model = model_of(creeping_box);
  const Eigen::Vector2d exact = exact_creep(0.6);
  double errors[2][2];
  for (int k = 0; k < 2; ++k) {
    SimulationDescription o = with(model.simulation, coordinates, k == 0 ? 4e-3 : 2e-3, 0.6);
    o.spectral_radius = rho;
    const RunResult r = completed_run(model, o);
    const auto row = r.table.data.end() - 3;
    errors[k][0] = std::abs(row[1] - exact[0]);
    errors[k][1] = std::abs(row[2] - exact[1]);
  }
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(errors[0][i] / errors[1][i]), 2.0, 0.1) << i;
  EXPECT_LT(errors[1][0], 1e-5);
  EXPECT_LT(errors[1][1], 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ElementStates,
                         ::testing::Combine(::testing::ValuesIn(both_coordinates),
                                            ::testing::Values(1.0, 0.8)));

TEST(ElementStatesLinear, PolesAreExact) {
  const Model model = model_of(creeping_box);
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o{.coordinates = c};
    Model still = model;
    still.joints[0].position = still.joints[0].velocity = {0.0};
    const LinearSystem s = linear_system(still, o);
    EXPECT_EQ(s.degrees, 1);
    EXPECT_EQ(s.massless, 0);
    ASSERT_EQ(s.A.rows(), 4);
    EXPECT_EQ(s.states[1], "state 1 of maxwell 'm'");
    EXPECT_EQ(s.states[2], "state 2 of maxwell 'm'");
    const GeneralEigen own = general_eigen(creeping_box_matrix());
    for (const LinearMode& mode : linear_modes(s))
      EXPECT_LT((own.values.array() - mode.lambda).abs().minCoeff(), 1e-9 * 30.0);
  }
}

TEST(ElementStatesStart, EquilibriumLeavesDampersWithoutForce) {
  const Model model = model_of(R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: z}}
forces:
  s: {type: joint_spring, joint: slide, spring: 400}
  m: {type: maxwell, from: {body: ground, at: [0, 0, 1]}, to: {body: box, at: [0, 0, 0]},
      branches: [[9000, 30]]}
outputs: {x: {joint_position: slide}, f: {force: m}}
simulation: {step: 0.001, duration: 0.5, start: equilibrium}
)");
  const StaticsResult s = statics(model);
  EXPECT_NEAR(s.bodies[0].position.z(), -3.0 * 9.81 / 400.0, 1e-12);
  EXPECT_NEAR(s.forces[1].force, 0.0, 1e-9);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    const auto row = r.table.data.end() - 3;
    EXPECT_NEAR(row[1], -3.0 * 9.81 / 400.0, 1e-10);
    EXPECT_NEAR(row[2], 0.0, 1e-7);
  }
}

// From the state of another run, in the other formulation as well.
TEST(ElementStatesStart, StatesAreKept) {
  const Model model = model_of(creeping_box);
  Simulation whole(model, {.step = 1e-3});
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(whole.step()) << whole.failure();
  const auto kept = std::make_shared<SystemState>(whole.state());
  ASSERT_EQ(kept->elements.size(), 1u);
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(whole.step()) << whole.failure();
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o{.coordinates = c, .start = Start::state, .state = kept};
    o.step = 1e-3;
    Simulation rest(model, o);
    for (int k = 0; k < 100; ++k) ASSERT_TRUE(rest.step()) << rest.failure();
    EXPECT_NEAR(rest.output("x"), whole.output("x"), 1e-7);
    EXPECT_NEAR(rest.output("f"), whole.output("f"), 1e-4);
  }
  SystemState wrong = *kept;
  wrong.elements[0].states.conservativeResize(1);
  EXPECT_EQ(error_of([&] {
              Simulation(model,
                         {.start = Start::state, .state = std::make_shared<SystemState>(wrong)});
            }),
            "wrong_count");
}

/// With friction that sticks and slides, and a slider that strikes a wall.
Model striking_machine() {
  std::string text = stepped_machine;
  text.insert(text.find("outputs:"), R"(
  brake: {type: bristle_friction, joint: spin, breakaway: 2, kinetic: 1.5, stribeck: 0.1,
          stiffness: 2000, damping: 3}
  bump: {type: unilateral_spring, from: {body: ground, at: [0.52, 0, 0]}, to: {body: slider, at: c},
         length: 0.03, stiffness: 4000, restitution: 0.7}
)");
  return model_of(text);
}

TEST(ElementStatesSaved, GoOnWithEqualBits) {
  const Model model = striking_machine();
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
      Simulation other(model, o);
      other.restore(SimulationState::from_bytes(saved.to_bytes()));
      EXPECT_TRUE(equal_bits(trace(other, 60, 120), first));
    }
}

TEST(ElementStatesSaved, StepsDoNotAllocate) {
  const Model model = striking_machine();
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    trace(s, 0, 20);
    const AllocationScope scope;
    for (int k = 0; k < 40; ++k) s.step();
    EXPECT_EQ(scope.count(), 0u);
  }
}

// A flexible crank, a rod and a slider: a loop, with an element across it.
TEST(ElementStatesLoop, AbsoluteIsRelative) {
  std::string text = flexible_loop;
  text.insert(text.find("simulation:"), R"(
  m: {type: maxwell, from: {body: ground, at: [0.2, 0, 0.6]}, to: {body: rod, at: [0.55, 0, 0.15]},
      branches: [[4000, 60], [2000, 10]]}
outputs: {x: {joint_position: guide}, f: {force: m}}
)");
  const Model model = model_of(text);
  std::vector<double> ends[2];
  for (const Coordinates c : both_coordinates) {
    SimulationDescription o = with(model.simulation, c, 5e-4, 0.2);
    o.start = Start::given;
    const RunResult r = completed_run(model, o);
    ends[c == Coordinates::relative].assign(r.table.data.end() - 2, r.table.data.end());
    EXPECT_LT(r.summary.energy.largest_remainder, 1e-3 * r.summary.energy.exchanged);
  }
  EXPECT_NEAR(ends[0][0], ends[1][0], 1e-7);
  EXPECT_NEAR(ends[0][1], ends[1][1], 1e-3);
}

}  // namespace
}  // namespace floatframe::test

// Couplings at the start: values that do not satisfy them, counts of freedoms, those that repeat
// each other, equilibrium and linear systems.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Two discs with springs, in the ratio 2: theta_a + 2 theta_b = 0.
std::string discs(const std::string& a, const std::string& b, const std::string& more = "") {
  return R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.5, 0, 0], rigid: {mass: 3, inertia: [0.03, 0.03, 0.05]}}
joints:
  a: {type: revolute, child: one, at: [0, 0, 0], axis: z)" +
         a + R"(}
  b: {type: revolute, child: two, at: [0.5, 0, 0], axis: z)" +
         b + R"(}
couplings:
  mesh: {terms: [{joint: a}, {joint: b, factor: 2}]}
)" + more +
         R"(
outputs:
  a: {joint_position: a}
  b: {joint_position: b}
  va: {joint_velocity: a}
  vb: {joint_velocity: b}
simulation: {step: 1.0e-3, duration: 0}
)";
}

std::vector<double> start_of(const std::string& text, Coordinates c) {
  ModelDescription d = description_of(text);
  d.simulation.coordinates = c;
  const RunResult r = completed_run(d);
  return {r.table.data.begin() + 1, r.table.data.end()};
}

TEST(CoupledStart, CoordinatesWithoutAValueFollow) {
  for (const Coordinates c : both_coordinates)
    for (const char* cut : {"", ", cut: true"}) {
      const auto x = start_of(discs(", position: 15, velocity: -4", cut), c);
      EXPECT_NEAR(x[0], 15.0, 1e-10);
      EXPECT_NEAR(x[1], -7.5, 1e-10) << cut;
      EXPECT_NEAR(x[2], -4.0, 1e-10);
      EXPECT_NEAR(x[3], 2.0, 1e-10);
    }
}

TEST(CoupledStart, ValuesOverTurnsAreTakenAsTheyAre) {
  for (const Coordinates c : both_coordinates) {
    const auto x = start_of(discs(", position: 15", ", position: -7.5"), c);
    EXPECT_EQ(x[0], 15.0);
    EXPECT_NEAR(x[1], -7.5, 1e-14);
  }
}

TEST(CoupledStart, ValuesThatContradictChangeLittleOrAreKept) {
  for (const Coordinates c : both_coordinates) {
    const auto x = start_of(discs(", position: 0.2, keep: true", ", position: 0.1"), c);
    EXPECT_NEAR(x[0], 0.2, 1e-10);
    EXPECT_NEAR(x[1], -0.1, 1e-10);
    const auto y = start_of(discs(", position: 0.2", ", position: 0.1"), c);
    EXPECT_NEAR(y[0] + 2.0 * y[1], 0.0, 1e-10);
    EXPECT_GT(std::abs(y[0]) + std::abs(y[1]), 0.05);
  }
  EXPECT_EQ(error_of([] {
              completed_run(model_of(discs(", position: 0.2, velocity: 1, keep: true",
                                           ", position: 0.1, velocity: 1, keep: true")));
            }),
            "not_assembled");
}

TEST(CoupledStart, TakesOneFreedom) {
  const ModelCounts counts = check(model_of(discs("", "")));
  EXPECT_EQ(counts.relative.constraints, 1);
  EXPECT_EQ(counts.redundant_constraints, 0);
  EXPECT_EQ(counts.degrees_of_freedom, 1);
  EXPECT_EQ(linear_system(model_of(discs("", ""))).degrees, 1);
}

TEST(CoupledStart, OneThatRepeatsAnotherIsNamed) {
  const Model model =
      model_of(discs("", "", "  twin: {terms: [{joint: b}, {joint: a, factor: 0.5}]}"));
  const ModelCounts counts = check(model);
  ASSERT_EQ(counts.start.redundant.size(), 1u);
  EXPECT_EQ(counts.start.redundant[0].owner, "coupling 'twin'");
  EXPECT_EQ(counts.start.redundant[0].direction, "sum of coordinates");
}

// The torque of 3 N m on the first disc against a spring of 8 N m/rad on the second one, and the
// reactions of two couplings that share it.
TEST(CoupledStart, EquilibriumOfASpringBehindGears) {
  const std::string forces = R"(
forces:
  load: {type: torque, body: one, direction: z, magnitude: 3}
  coil: {type: joint_spring, joint: b, spring: 8}
)";
  const StaticsResult s = statics(model_of(discs("", "", forces)));
  ASSERT_EQ(s.forces.size(), 3u);
  EXPECT_NEAR(s.forces[1].length, -0.75, 1e-10);
  EXPECT_EQ(s.forces[2].name, "mesh");
  EXPECT_NEAR(s.forces[2].force, -3.0, 1e-9);
  EXPECT_NEAR(s.joints[0].torque.z(), -3.0, 1e-9);
  EXPECT_NEAR(s.joints[1].torque.z(), -6.0, 1e-9);
  EXPECT_TRUE(s.forces[2].unique);
  const StaticsResult both = statics(
      model_of(discs("", "", "  twin: {terms: [{joint: b, factor: 2}, {joint: a}]}" + forces)));
  ASSERT_EQ(both.forces.size(), 4u);
  EXPECT_NEAR(both.forces[2].force, -1.5, 1e-9);
  EXPECT_NEAR(both.forces[3].force, -1.5, 1e-9);
  EXPECT_FALSE(both.forces[3].unique);
  EXPECT_NEAR(both.joints[1].torque.z(), -6.0, 1e-9);
}

// (J_a + J_b / 4) theta'' + (k_a + k_b / 4) theta = 0
TEST(CoupledStart, PolesOfAGearTrain) {
  const double omega = std::sqrt((3.0 + 8.0 / 4.0) / (0.02 + 0.05 / 4.0));
  for (const Coordinates c : both_coordinates) {
    const LinearSystem s = linear_system(model_of(discs(", position: 12.566370614359172", "", R"(
forces:
  first: {type: joint_spring, joint: a, spring: {linear: {stiffness: 3, free: 12.566370614359172}}}
  coil: {type: joint_spring, joint: b, spring: {linear: {stiffness: 8, free: -6.283185307179586}}}
)")),
                                         {.coordinates = c});
    ASSERT_EQ(s.degrees, 1);
    const auto modes = linear_modes(s);
    ASSERT_EQ(modes.size(), 1u);
    EXPECT_NEAR(std::abs(modes[0].lambda.imag()) / omega, 1.0, 1e-9) << name_of(c);
  }
}

}  // namespace
}  // namespace floatframe::test

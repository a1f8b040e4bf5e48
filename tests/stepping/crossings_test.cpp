// Runs that end where a formula crosses zero, and times of first crossings: against motions that
// the steps make exactly, and against the closed form with the order of the step; undisturbed
// motions, saved and resumed runs, no allocation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A ball that falls from a height: the trapezoidal rule makes its parabola exactly.
std::string falling_ball(double height, const std::string& until) {
  return R"(
bodies: {ball: {rigid: {mass: 2, centre_of_mass: [0, 0, )" +
         std::to_string(height) + R"(], inertia: [1, 1, 1]}}}
outputs:
  z: {position: ball, axis: z}
  v: {velocity: ball, axis: z}
  half: {first_crossing: 'position(ball, z) - 1'}
  up: {first_crossing: 'position(ball, z) - 1', direction: rising}
simulation: {step: 0.01, duration: 2, output_interval: 0.1, until: ')" +
         until + "'}\n";
}

double at_end(const RunResult& r, std::size_t column) {
  return r.table.at(r.table.rows() - 1, column);
}

class Until : public ::testing::TestWithParam<Coordinates> {};

TEST_P(Until, AFallEndsAtTheGround) {
  // Within a step, at the end of one, at its beginning, where an explicit move leads.
  for (const double t : {0.637, 0.64, 0.64005, 0.6400001}) {
    const double height = 0.5 * 9.81 * t * t;
    const Model model = model_of(falling_ball(height, "position(ball, z)"));
    const RunResult r = completed_run(model, with(model.simulation, GetParam()));
    const double exact = std::sqrt(2.0 * (std::stod(std::to_string(height))) / 9.81);
    ASSERT_TRUE(r.summary.crossed_at.has_value()) << t;
    EXPECT_NEAR(*r.summary.crossed_at, exact, 1e-9);
    EXPECT_EQ(at_end(r, 0), *r.summary.crossed_at);
    EXPECT_EQ(r.summary.duration, *r.summary.crossed_at);
    EXPECT_NEAR(at_end(r, 1), 0.0, 1e-8);
    EXPECT_NEAR(at_end(r, 2), -9.81 * exact, 1e-8);
    EXPECT_EQ(r.table.rows(), 8u);
    EXPECT_NEAR(at_end(r, 3), std::sqrt(exact * exact - 2.0 / 9.81), 1e-9);
    EXPECT_TRUE(std::isnan(at_end(r, 4)));
    EXPECT_TRUE(std::isnan(r.table.at(0, 3)));
  }
}

// A value of a sampled element jumps at its instant: within a step, at the end of one, shortly
// behind the beginning of one.
TEST_P(Until, SampledSignalsCrossAtTheirInstants) {
  for (const double step : {0.07, 0.1, 0.02995, 0.001}) {
    const Model model = model_of(fmt::format(R"(
bodies: {{b: {{position: [0, 0, 0], rigid: {{mass: 1}}}}}}
joints: {{z: {{type: prismatic, child: b, at: [0, 0, 0], axis: z}}}}
controllers:
  hold: {{type: zero_order_hold, input: {{polynomial: [0, 1]}}, period: 0.1}}
  late: {{type: zero_order_hold, input: {{polynomial: [0, 1]}}, period: 0.1, delay: 0.04}}
outputs:
  first: {{first_crossing: 'controller(hold) - 0.15'}}
  second: {{first_crossing: 'controller(late) - 0.15'}}
simulation: {{step: {}, duration: 1, until: 'controller(hold) - 0.25'}}
)",
                                             step));
    const RunResult r = completed_run(model, with(model.simulation, GetParam()));
    ASSERT_TRUE(r.summary.crossed_at.has_value()) << step;
    EXPECT_NEAR(*r.summary.crossed_at, 0.3, 1e-14) << step;
    EXPECT_NEAR(at_end(r, 0), 0.3, 1e-14) << step;
    EXPECT_NEAR(at_end(r, 1), 0.2, 1e-14) << step;
    EXPECT_NEAR(at_end(r, 2), 0.24, 1e-14) << step;
  }
}

TEST_P(Until, WithoutACrossingTheDurationEndsIt) {
  const Model model = model_of(falling_ball(1.5, "position(ball, z) + 100"));
  const RunResult r = completed_run(model, with(model.simulation, GetParam()));
  EXPECT_FALSE(r.summary.crossed_at.has_value());
  EXPECT_EQ(at_end(r, 0), 2.0);
  EXPECT_TRUE(contains(until_text(r.summary), "did not cross zero"));
}

// From a corner of a load in the step; time alone; a start at zero is no crossing.
TEST_P(Until, EndsBehindCornersAndFromAStartAtZero) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies: {cart: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {slide: {type: prismatic, child: cart, at: [0, 0, 0], axis: x}}
forces:
  push: {type: force, body: cart, direction: x, magnitude: {steps: [[0, 8], [0.504, -2]]}}
outputs: {x: {joint_position: slide}, v: {joint_velocity: slide}}
simulation: {step: 0.01, duration: 5, until: 'rate(slide)'}
)");
  const RunResult r = completed_run(model, with(model.simulation, GetParam()));
  // 4 m/s2 for 0.504 s, then -1 m/s2.
  ASSERT_TRUE(r.summary.crossed_at.has_value());
  EXPECT_NEAR(*r.summary.crossed_at, 5.0 * 0.504, 1e-9);
  EXPECT_NEAR(at_end(r, 1), 10.0 * 0.504 * 0.504, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Both, Until, ::testing::ValuesIn(both_coordinates),
                         [](const auto& c) { return name_of(c.param); });

std::string swinging(const std::string& rest, const std::string& until = "") {
  return R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, position: 0.3}}
forces: {s: {type: joint_spring, joint: slide, spring: 40}}
outputs:
  x: {joint_position: slide}
)" + rest +
         "simulation: {step: 0.02, duration: 2" +
         (until.empty() ? "" : ", until: '" + until + "'") + "}\n";
}
const std::string crossings = R"(
  first: {first_crossing: 'angle(slide)'}
  rising: {first_crossing: 'angle(slide)', direction: rising}
  falling: {first_crossing: 'rate(slide)', direction: falling}
)";

TEST(FirstCrossing, ConvergesWithTheStepAndLeavesTheMotionAsItIs) {
  const Model plain = model_of(swinging("")), model = model_of(swinging(crossings));
  const RunResult a = completed_run(plain), b = completed_run(model);
  ASSERT_EQ(a.table.rows(), b.table.rows());
  for (std::size_t k = 0; k < a.table.rows(); ++k)
    EXPECT_EQ(a.table.at(k, 1), b.table.at(k, 1)) << k;
  EXPECT_EQ(a.summary.iterations, b.summary.iterations);
  const double w = std::sqrt(40.0 / 3.0), pi = std::acos(-1.0);
  SimulationDescription half = model.simulation;
  half.step *= 0.5;
  const RunResult fine = completed_run(model, half);
  const double exact[] = {0.5 * pi / w, 1.5 * pi / w, pi / w};
  // The rate falls through zero at a full period only; at half of one it rises.
  for (const std::size_t k : {0u, 1u}) {
    const double coarse = std::abs(at_end(b, 2 + k) - exact[k]);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_NEAR(coarse / std::abs(at_end(fine, 2 + k) - exact[k]), 4.0, 0.1);
  }
  EXPECT_NEAR(at_end(b, 4), 2.0 * exact[2], 5e-3);
  const RunResult ended = completed_run(model_of(swinging(crossings, "angle(slide)")));
  EXPECT_NEAR(*ended.summary.crossed_at, at_end(b, 2), 2e-10);
  EXPECT_NEAR(at_end(ended, 2), at_end(b, 2), 2e-10);
}

TEST(FirstCrossing, SurvivesCheckpointsAndSavedStates) {
  const Model model = model_of(swinging(crossings, "angle(slide) + 0.29"));
  const RunResult whole = completed_run(model);
  ASSERT_TRUE(whole.summary.crossed_at.has_value());
  std::vector<RunCheckpoint> kept;
  RunOptions options;
  options.checkpoint_every = 0.2;
  options.checkpoint = [&](const RunCheckpoint& c) { kept.push_back(c); };
  completed_run(model, model.simulation, options);
  ASSERT_GT(kept.size(), 2u);
  for (const RunCheckpoint& c : kept) {
    RunOptions rest;
    rest.resume = &c;
    const RunResult r = completed_run(model, model.simulation, rest);
    EXPECT_EQ(r.summary.crossed_at, whole.summary.crossed_at);
    for (const std::size_t k : {1u, 2u}) EXPECT_EQ(at_end(r, k), at_end(whole, k));
  }
  Simulation s(model);
  for (int k = 0; k < 30; ++k) ASSERT_TRUE(s.step());
  Simulation other(model);
  other.restore(SimulationState::from_bytes(s.save().to_bytes()));
  for (int k = 0; k < 60; ++k) ASSERT_TRUE(s.step() && other.step());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(std::memcmp(&s.outputs()[k], &other.outputs()[k], sizeof(double)), 0) << k;
  EXPECT_NEAR(s.output("first"), at_end(whole, 2), 2e-10);
}

TEST(FirstCrossing, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = model_of(swinging(crossings));
  Simulation s(model);
  for (int k = 0; k < 5; ++k) s.step();
  const AllocationScope scope;
  for (int k = 0; k < 60; ++k) s.step();
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_FALSE(std::isnan(s.output("first")));
}

TEST(Crossings, RefersToWhatThereIs) {
  const auto error = [](const std::string& text) {
    return without_folders(error_of([&] { model_of(text); }));
  };
  EXPECT_EQ(error(swinging("", "angle(slid)")), "model.yaml:8:46: not_found");
  EXPECT_EQ(error(swinging("  t: {first_crossing: 'x +'}\n")),
            "model.yaml:8:23: outputs.t.first_crossing: wrong_value");
  EXPECT_EQ(error(swinging("  t: {first_crossing: 'x', direction: up}\n")),
            "model.yaml:8:39: outputs.t.direction: wrong_value");
  EXPECT_EQ(error(swinging("  t: {first_crossing: 'x'}\n  u: {formula: 't'}\n", "u")),
            "model.yaml:10:46: unsupported");
}

}  // namespace
}  // namespace floatframe::test

// Blocks of controllers: poles and motions against closed forms, order, limits, saved simulations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

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

using std::numbers::pi;
using Complex = std::complex<double>;

/// A box of 3 kg that a block pushes.
std::string block_box(const std::string& block, const std::string& more = "") {
  return R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}}
forces: {motor: {type: joint_spring, joint: slide, actuator: {controller: b}}}
controllers:
  b: {)" +
         block + "}\n" + more + R"(
outputs: {u: {controller: b}, x: {joint_position: slide}, v: {joint_velocity: slide}}
simulation: {step: 0.01, duration: 0.5}
)";
}

/// Coefficients of descending powers of the polynomial with these roots.
Eigen::VectorXcd with_roots(const std::vector<Complex>& roots) {
  Eigen::VectorXcd p = Eigen::VectorXcd::Ones(1);
  for (const Complex root : roots) {
    Eigen::VectorXcd next = Eigen::VectorXcd::Zero(p.size() + 1);
    next.head(p.size()) = p;
    next.tail(p.size()) -= root * p;
    p = next;
  }
  return p;
}
std::string listed(const VecX& x) {
  std::string s;
  for (const double value : x) s += fmt::format("{}{:.17g}", s.empty() ? "" : ", ", value);
  return "[" + s + "]";
}

/// The largest distance of the poles from the nearest one of the model, relative to their sizes.
double pole_error(const Model& model, const std::vector<Complex>& poles) {
  double worst = 0.0;
  for (const Coordinates c : both_coordinates) {
    const std::vector<LinearMode> modes = linear_modes(linear_system(model, {.coordinates = c}));
    for (const Complex pole : poles) {
      if (pole.imag() < 0.0) continue;
      double nearest = 1e300;
      for (const LinearMode& mode : modes)
        nearest = std::min(nearest, std::abs(mode.lambda - pole));
      worst = std::max(worst, nearest / std::abs(pole));
    }
  }
  return worst;
}

/// The values of the block at the end, with steps h and h/2; the order of their errors.
double order_of_block(const Model& model, double exact, Coordinates c, double rho, double h,
                      double end) {
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    SimulationDescription o = with(model.simulation, c, k == 0 ? h : 0.5 * h, end);
    o.spectral_radius = rho;
    errors[k] = std::abs(*(completed_run(model, o).table.data.end() - 3) - exact);
  }
  EXPECT_LT(errors[1], 1e-3 * std::abs(exact));
  return std::log2(errors[0] / errors[1]);
}

class Blocks : public ::testing::TestWithParam<std::tuple<Coordinates, double>> {};

TEST_P(Blocks, OfSecondOrderConverge) {
  const auto [c, rho] = GetParam();
  const double w = 2.0 * pi * 1.5, z = 0.3, wd = w * std::sqrt(1.0 - z * z), t = 0.4;
  const double exact =
      1.0 - std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
  const Model filter =
      model_of(block_box("type: filter, input: 1, frequency: 1.5, damping: 0.3, initial: zero"));
  EXPECT_NEAR(order_of_block(filter, exact, c, rho, 4e-3, t), 2.0, 0.15);
  const Model function = model_of(block_box(
      "type: transfer_function, input: 1, initial: zero, numerator: [0, " +
      fmt::format("{:.17g}], denominator: [1, {:.17g}, {:.17g}]", w * w, 2.0 * z * w, w * w)));
  EXPECT_NEAR(order_of_block(function, exact, c, rho, 4e-3, t), 2.0, 0.15);
}

// By the exponential of the matrix, with feedthrough.
TEST_P(Blocks, OfSeveralInputsConverge) {
  const auto [c, rho] = GetParam();
  MatX A{{-1.0, 4.0}, {-5.0, -2.0}}, B{{1.0, 2.0}, {-3.0, 0.5}};
  const VecX u = Vec2(1.5, -2.0);
  const GeneralEigen e = general_eigen(A);
  const VecX rest = lu_solve(A, B * u);
  Eigen::VectorXcd x = e.vectors.partialPivLu().solve(rest.cast<Complex>());
  x.array() *= (0.5 * e.values.array()).exp();
  const double exact = Vec2(2.0, -1.0).dot(VecX((e.vectors * x).real() - rest)) + 0.7 * u[1];
  const Model model = model_of(block_box(
      "type: state_space, inputs: [1.5, -2], A: [[-1, 4], [-5, -2]], B: [[1, 2], [-3, 0.5]], "
      "C: [2, -1], D: [0, 0.7], initial: zero"));
  EXPECT_NEAR(order_of_block(model, exact, c, rho, 4e-3, 0.5), 2.0, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Blocks,
                         ::testing::Combine(::testing::ValuesIn(both_coordinates),
                                            ::testing::Values(1.0, 0.8)));

TEST(BlocksLinear, PolesAreThoseOfTheDenominator) {
  const std::vector<Complex> spread{{-1.0, 2.0},   {-1.0, -2.0},   {-10.0, 0.0},
                                    {-30.0, 40.0}, {-30.0, -40.0}, {-2000.0, 0.0}};
  std::vector<Complex> butterworth;  // of order 8, at 50 Hz
  for (int k = 0; k < 8; ++k)
    butterworth.push_back(std::polar(100.0 * pi, pi * (2.0 * k + 9.0) / 16.0));
  for (const auto& poles : {spread, butterworth}) {
    const VecX a = with_roots(poles).real();
    const Model model = model_of(block_box(
        "type: transfer_function, input: {length: motor, factor: 0}, numerator: 1, denominator: " +
        listed(a)));
    const double error = pole_error(model, poles);
    EXPECT_LT(error, 1e-9);
    fmt::print("[ figure ] pole_error_{} {:.1e}\n", poles.size(), error);
  }
}

TEST(BlocksLinear, PolesOfFiltersAreExact) {
  const double w = 2.0 * pi * 30.0;
  EXPECT_LT(pole_error(model_of(block_box("type: filter, input: 0, time: 0.02")), {-50.0}), 1e-12);
  EXPECT_LT(pole_error(model_of(block_box("type: filter, input: 0, frequency: 30")), {-w}), 1e-12);
  EXPECT_LT(pole_error(model_of(block_box("type: filter, input: 0, frequency: 30, damping: 0.6")),
                       {{-0.6 * w, 0.8 * w}}),
            1e-12);
  EXPECT_LT(pole_error(model_of(block_box("type: rate_limiter, input: 0, rising: 3, time: 0.01")),
                       {-100.0}),
            1e-12);
  EXPECT_LT(pole_error(model_of(block_box("type: state_space, inputs: 0, A: [[-3, 4], [-4, -3]], "
                                          "B: [0, 1], C: [1, 0]")),
                       {{-3.0, 4.0}}),
            1e-12);
}

// A box on a spring that is a lead controller, k (s + 8) / (s + 40).
TEST(BlocksLinear, CloseALoop) {
  const Model model = model_of(
      block_box("type: transfer_function, input: {length: motor, factor: -600}, numerator: [1, 8], "
                "denominator: [1, 40]"));
  // 3 s^2 (s + 40) + 600 (s + 8) = 0
  MatX A{{-40.0, -200.0, -1600.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const GeneralEigen e = general_eigen(A);
  EXPECT_LT(pole_error(model, {e.values[0], e.values[1], e.values[2]}), 1e-9);
}

TEST(BlocksStart, AreAtRestForTheirInputs) {
  const auto first = [](const std::string& block) {
    return Simulation(model_of(block_box(block)), {}).output("u");
  };
  EXPECT_NEAR(first("type: filter, input: 3, time: 0.1"), 3.0, 1e-14);
  EXPECT_EQ(first("type: filter, input: 3, time: 0.1, initial: zero"), 0.0);
  EXPECT_NEAR(first("type: transfer_function, input: 3, numerator: [2, 5], denominator: [1, 4, 2]"),
              7.5, 1e-13);
  EXPECT_EQ(first("type: transfer_function, input: 3, numerator: 5, denominator: [1, 4, 0]"), 0.0);
  EXPECT_NEAR(first("type: state_space, inputs: [3, 1], A: -2, B: [[4, 2]], C: 1, D: [1, 0]"), 10.0,
              1e-13);
  EXPECT_EQ(first("type: integrator, input: 3, initial: 0.4"), 0.4);
  EXPECT_EQ(first("type: rate_limiter, input: 3, rising: 1"), 3.0);
  const std::string relay = "type: hysteresis, lower: -1, upper: 1, below: -4, above: 6, input: ";
  EXPECT_EQ(first(relay + "2"), 6.0);
  EXPECT_EQ(first(relay + "-1"), -4.0);
  EXPECT_EQ(first(relay + "0"), -4.0);
  EXPECT_EQ(first(relay + "0, initial: above"), 6.0);
}

Simulation located(const Model& model, Coordinates c, double step = 0.01) {
  SimulationOptions o{.coordinates = c};
  o.locate_edges = true;
  o.step = step;
  return Simulation(model, o);
}
void go(Simulation& s, double end) {
  while (s.time() < end - 1e-9) ASSERT_TRUE(s.step()) << s.failure();
}

// The integral of 2 sin(w t): at its limit until the sine turns.
TEST(BlocksLimits, AnIntegralLeavesItsLimitAtOnce) {
  const double w = 2.0 * pi, upper = 0.3;
  const Model model = model_of(block_box(
      "type: integrator, input: {sine: {amplitude: 2, frequency: 1}}, upper: 0.3, lower: -1"));
  for (const Coordinates c : both_coordinates) {
    Simulation s = located(model, c);
    go(s, 0.2);
    EXPECT_NEAR(s.output("u"), 2.0 / w * (1.0 - std::cos(0.2 * w)), 2e-4);
    go(s, 0.45);
    EXPECT_EQ(s.output("u"), upper);
    go(s, 0.8);
    EXPECT_NEAR(s.output("u"), upper - 2.0 / w * (1.0 + std::cos(0.8 * w)), 2e-4);
    EXPECT_EQ(s.counters().edges, 2);
    Simulation plain(model, {.coordinates = c});
    go(plain, 0.45);
    EXPECT_EQ(plain.output("u"), upper);
    go(plain, 0.8);
    EXPECT_NEAR(plain.output("u"), s.output("u"), 5e-3);
  }
}

// A sum of terms, limited as a whole.
TEST(BlocksLimits, ALimiterClipsASum) {
  const Model model =
      model_of(block_box("type: limiter, upper: 3, lower: -3, input: {polynomial: [0.5, 20], "
                         "controller: c, factor: 2}",
                         "  c: {type: pid, measured: {length: motor}, proportional: 20}\n"));
  Simulation s = located(model, Coordinates::relative);
  EXPECT_EQ(s.output("u"), 0.5);
  go(s, 0.3);
  EXPECT_EQ(s.output("u"), 3.0);
  EXPECT_EQ(s.counters().edges, 1);
}

TEST(BlocksLimits, ARateIsExactAndLagsOtherwise) {
  const Model steps = model_of(
      block_box("type: rate_limiter, input: {table: [[0, 0], [0.1, 0], [0.1, 1], [9, 1]]}, "
                "rising: 2, falling: 1, time: 0.01"));
  const Model ramp =
      model_of(block_box("type: rate_limiter, input: {polynomial: [0, 1]}, rising: 2, time: 0.01"));
  for (const Coordinates c : both_coordinates) {
    Simulation s = located(steps, c);
    go(s, 0.4);
    EXPECT_NEAR(s.output("u"), 2.0 * 0.3, 1e-9);
    go(s, 1.0);
    EXPECT_NEAR(s.output("u"), 1.0, 1e-9);
    Simulation r = located(ramp, c);
    go(r, 0.5);
    EXPECT_NEAR(r.output("u"), 0.5 - 0.01, 1e-9);
  }
}

// It pushes in one direction while a sine rises from half its amplitude until it has fallen as far
// below zero.
TEST(BlocksLimits, ARelaySwitchesAtItsThresholds) {
  const Model model = model_of(
      block_box("type: hysteresis, input: {sine: {amplitude: 2, frequency: 1}}, lower: -1, "
                "upper: 1, below: 0, above: 6"));
  for (const Coordinates c : both_coordinates) {
    Simulation s = located(model, c);
    go(s, 0.08);
    EXPECT_EQ(s.output("u"), 0.0);
    go(s, 0.3);
    EXPECT_EQ(s.output("u"), 6.0);
    EXPECT_NEAR(s.output("v"), 2.0 * (0.3 - 1.0 / 12.0), 1e-6);
    go(s, 1.0);
    EXPECT_EQ(s.output("u"), 0.0);
    EXPECT_NEAR(s.output("v"), 1.0, 1e-6);
    EXPECT_EQ(s.counters().edges, 2);
    Simulation plain(model, {.coordinates = c});
    go(plain, 1.0);
    EXPECT_EQ(plain.output("u"), 0.0);
    EXPECT_NEAR(plain.output("v"), 1.0, 0.05);
  }
}

// F = -(1 + y), T ydot = F / 2 - y
TEST(BlocksRing, FollowTogetherWithAForce) {
  std::string text = block_box(
      "type: filter, input: {force: motor, factor: 0.5}, time: 0.1, "
      "initial: zero");
  text.replace(text.find("{controller: b}"), 15, "{polynomial: [1], controller: b}");
  const Model model = model_of(text);
  EXPECT_LT(pole_error(model, {-15.0}), 1e-9);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 0.2));
    EXPECT_NEAR(*(r.table.data.end() - 3), -(1.0 - std::exp(-0.2 * 15.0)) / 3.0, 1e-5);
  }
}

/// An arm in gravity on a spring, with a controller of a constant.
std::string limited_arm(const std::string& controller) {
  return R"(
bodies: {arm: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}}
joints: {hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: [0, -1, 0]}}
forces: {motor: {type: joint_spring, joint: hinge, spring: 80, actuator: {controller: hold}}}
controllers: {hold: {)" +
         controller + R"(}}
simulation: {step: 0.001, duration: 0.3, start: equilibrium}
)";
}

// What it measures does not depend on the motion: it rests at a limit, or nowhere.
TEST(BlocksStart, AnIntegralOfAConstantRestsAtItsLimit) {
  for (const std::string controller :
       {"type: pid, measured: 1, target: 0.4, proportional: 6, integral: 90, lower: -5, upper: 9",
        "type: integrator, input: -0.02, lower: -5"}) {
    const StaticsResult s = statics(model_of(limited_arm(controller)));
    EXPECT_NEAR(s.forces[1].force, -5.0, 1e-9) << controller;
    ASSERT_FALSE(s.notes.empty());
    EXPECT_NE(s.notes.back().find("rests at a limit"), std::string::npos);
  }
  EXPECT_EQ(
      error_of([] { statics(model_of(limited_arm("type: integrator, input: 1, lower: -5"))); }),
      "no_equilibrium");
}

// A pole at 0 is an integral, which statics bring to where its input is zero.
TEST(BlocksStart, APoleAtZeroHoldsTheArm) {
  std::string text = limited_arm(
      "type: transfer_function, input: {polynomial: [0.3], length: motor, factor: -1}, "
      "numerator: [40, 90], denominator: [0.01, 1, 0]");
  text.replace(text.find("spring: 80"), 10, "damper: 8 ");
  const StaticsResult s = statics(model_of(text));
  EXPECT_NEAR(s.forces[0].length, 0.3, 1e-9);
  EXPECT_NEAR(s.forces[1].force, 2.0 * 9.81 * 0.3 * std::cos(0.3), 1e-6);
}

Model machine_of_blocks() {
  std::string text = stepped_machine;
  text.insert(text.find("outputs:"), R"(
  motor: {type: joint_spring, joint: spin, actuator: {controller: limited}}
  tow: {type: force, body: slider, at: c, direction: x, magnitude: {controller: relay}}
controllers:
  gap: {type: transfer_function, input: {polynomial: [13], length: motor, factor: -1},
        numerator: [3, 8], denominator: [0.001, 0.1, 2]}
  sum: {type: state_space, inputs: [{controller: gap}, {controller: slow}, {input: push}],
        A: [[-20, 3], [0, -9]], B: [[1, 2, 0], [0, 1, 0.1]], C: [4, 1], D: [0.2, 0, 0]}
  slow: {type: filter, input: {controller: rate}, frequency: 8, damping: 0.7}
  rate: {type: rate_limiter, input: {controller: sum, factor: 0.3}, rising: 3, falling: 4}
  total: {type: integrator, input: {controller: sum}, lower: -0.05, upper: 0.05}
  limited: {type: limiter, input: {controller: total, factor: 10}, upper: 0.4}
  relay: {type: hysteresis, input: {rate: motor}, lower: -0.1, upper: 0.1, above: 2}
)");
  return model_of(text);
}

TEST(BlocksSaved, GoOnWithEqualBits) {
  const Model model = machine_of_blocks();
  for (const Coordinates c : both_coordinates)
    for (const bool edges : {false, true}) {
      SimulationOptions o{.coordinates = c};
      o.locate_edges = edges;
      Simulation s(model, o);
      trace(s, 0, 60);
      const SimulationState saved = s.save();
      const std::vector<double> first = trace(s, 60, 120);
      s.restore(saved);
      EXPECT_TRUE(equal_bits(trace(s, 60, 120), first));
    }
}

TEST(BlocksSaved, StepsDoNotAllocate) {
  const Model model = machine_of_blocks();
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

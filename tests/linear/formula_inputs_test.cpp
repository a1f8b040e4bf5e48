// Inputs that formulas make something else of: the linear system has the derivatives of the
// formulas themselves, however steep they are beside the masses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "floatframe/linear/linear_ports.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string slide(double mass, double u, const std::string& formula, const std::string& more) {
  return fmt::format(R"(
gravity: [0, 0, 0]
bodies: {{b: {{position: [0, 0, 0], rigid: {{mass: {}}}}}}}
joints: {{z: {{type: prismatic, child: b, at: [0, 0, 0], axis: z}}}}
inputs: {{u: {{initial: {}}}}}
forces: {{f: {{type: joint_spring, joint: z, actuator: {{formula: '{}'}}}}}}
simulation: {{step: 0.001, duration: 1}}
{})",
                     mass, u, formula, more);
}

struct Slope {
  double mass, u;
  const char* formula;
  double exact;
};

TEST(FormulaInputs, HaveTheDerivativesOfTheFormulas) {
  const Slope cases[] = {{1e5, 0.0, "5 * sin(u)", 5.0},
                         {1e5, 0.0, "200 * tanh(u / 0.1)", 2000.0},
                         {1.0, 1e-4, "sqrt(u)", 50.0},
                         {1e5, 0.3, "exp(-u * u)", -0.6 * std::exp(-0.09)},
                         {1e-6, 2.0, "7 * u", 7.0},
                         {1e6, 1e-9, "1e4 * tanh(u / 1e-9)", 1e13 / std::pow(std::cosh(1.0), 2)}};
  for (const Slope& x : cases)
    for (const Coordinates c : both_coordinates) {
      const Model model =
          model_of(slide(x.mass, x.u, x.formula, "outputs: {a: {acceleration: b, axis: z}}"));
      const LinearModel linear = linear_model(model, {}, {.coordinates = c});
      const auto column = linear.B[0].col(0);
      EXPECT_NEAR(column.sum() * x.mass, x.exact, 1e-10 * std::abs(x.exact)) << x.formula;
      EXPECT_NEAR(column.cwiseAbs().sum() * x.mass, std::abs(x.exact), 1e-10 * std::abs(x.exact));
      EXPECT_NEAR(linear.D[0](0, 0) * x.mass, x.exact, 1e-8 * std::abs(x.exact)) << x.formula;
    }
}

const char* const through_signals = R"(
bodies:
  b: {position: [0, 0, 0], rigid: {mass: 1000}}
  c: {position: [1, 0, 0], rigid: {mass: 1000}}
joints:
  z: {type: prismatic, child: b, at: [0, 0, 0], axis: z}
  x: {type: prismatic, child: c, at: [1, 0, 0], axis: z, motion: {polynomial: [0]}}
inputs: {u: {initial: 0.02}}
controllers:
  one: {type: formula, formula: 'sin(50 * u)'}
  two: {type: formula, formula: 'exp(controller(one)) + u'}
  lag: {type: filter, time: 0.1, input: {controller: one}}
forces:
  f: {type: joint_spring, joint: z, spring: 30, actuator: {formula: 'controller(two)^2'},
      target: {formula: 'tanh(100 * u)'}}
  push: {type: force, body: c, at: [1, 0, 0], direction: [0, 0, 1],
         magnitude: {formula: '1e3 * sin(20 * u)'}}
outputs:
  force: {force: f}
  held: {motion_force: x}
  read: {formula: 'sin(force(f)) + cos(30 * u) + 3 * joint_position(z)'}
simulation: {step: 0.001, duration: 1}
)";

// Through other formulas, the state of a controller, the target of a spring; as reactions and in
// formulas of outputs.
TEST(FormulaInputs, ThroughSignalsAndInOutputs) {
  for (const Coordinates c : both_coordinates) {
    const LinearModel linear = linear_model(model_of(through_signals), {}, {.coordinates = c});
    const double u = 0.02, one = std::sin(50 * u), done = 50 * std::cos(50 * u);
    const double two = std::exp(one) + u, dtwo = std::exp(one) * done + 1.0;
    const double dtarget = 100.0 / std::pow(std::cosh(100.0 * u), 2);
    const double force = -two * two - 30.0 * std::tanh(100.0 * u),  // against the coordinate
        slope = 2.0 * two * dtwo + 30.0 * dtarget;
    EXPECT_NEAR(linear.output_values[0], force, 1e-12 * std::abs(force));
    EXPECT_NEAR(linear.D[0](0, 0), -slope, 1e-9 * slope);
    EXPECT_NEAR(std::abs(linear.D[0](1, 0)), 2e4 * std::cos(20 * u), 1e-4);
    EXPECT_NEAR(linear.D[0](2, 0), -std::cos(force) * slope - 30.0 * std::sin(30.0 * u),
                1e-9 * slope);
    std::vector<double> expected{slope / 1000.0, done / 0.1}, found;
    for (const double x : linear.B[0].col(0))
      if (std::abs(x) > 1e-12) found.push_back(x);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(found.size(), 2u);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(found[k], expected[k], 1e-9 * expected[k]);
  }
}

}  // namespace
}  // namespace floatframe::test

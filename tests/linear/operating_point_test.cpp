// Places to linearise at: words, times, and what is not one.
#include "floatframe/linear/operating_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/run/run.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

// J = m l^2 + I, w^2 = m g l cos(angle) / J at rest at an angle, to be held there by a spring.
const char* const hung = R"(
bodies: {rod: {rigid: {mass: 2, centre_of_mass: [0, 0, -0.5], inertia: [0.2, 0.2, 0.01]}}}
joints: {pin: {type: revolute, child: rod, at: [0, 0, 0], axis: y, position: 0.6, velocity: 1.5}}
simulation: {step: 0.001, duration: 1}
)";

double frequency_at(const Model& model, const std::string& at) {
  const auto modes = linear_modes(linear_system(at_operating_point(model, at)));
  return 2.0 * std::numbers::pi * modes.back().frequency();
}

TEST(OperatingPoint, EquilibriumOfAPendulumThatStartsAway) {
  const Model model = model_of(hung);
  EXPECT_NEAR(frequency_at(model, "equilibrium"), std::sqrt(2 * 9.81 * 0.5 / 0.7), 1e-8);
  EXPECT_NEAR(frequency_at(model, "start"), std::sqrt(2 * 9.81 * 0.5 * std::cos(0.6) / 0.7), 1e-8);
  EXPECT_EQ(frequency_at(model, ""), frequency_at(model, "start"));
}

TEST(OperatingPoint, TimeIsWhereARunComesTo) {
  const Model model = model_of(hung);
  Simulation s(model);
  for (int k = 0; k < 250; ++k) ASSERT_TRUE(s.step());
  ASSERT_TRUE(s.step(0.0004));
  const double angle = s.state().joints.at(0).position.at(0);
  EXPECT_GT(std::abs(angle - 0.6), 0.05);
  EXPECT_NEAR(frequency_at(model, "0.2504"), std::sqrt(2 * 9.81 * 0.5 * std::cos(angle) / 0.7),
              1e-7);
}

// An offset from the equilibrium is made once, before the run to the time.
TEST(OperatingPoint, OffsetIsMadeOnce) {
  const Model model = model_of(R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: z}}
forces: {s: {type: joint_spring, joint: slide, spring: 40}}
simulation:
  step: 0.001
  duration: 1
  start: {equilibrium: true, offset: {box: [0, 0, 0.5]}}
)");
  const Model there = at_operating_point(model, "0");
  Simulation s(there);
  EXPECT_NEAR(s.state().joints.at(0).position.at(0), 0.5 - 3 * 9.81 / 40, 1e-9);
}

TEST(OperatingPoint, BadPlaces) {
  const Model model = model_of(hung);
  for (const char* at : {"-1", "abc", "nan", "1e999", "1.5s", "Equilibrium"})
    EXPECT_EQ(error_of([&] { at_operating_point(model, at); }), "out_of_range") << at;
  Model moved = at_operating_point(model, "0.1");
  EXPECT_EQ(error_of([&] { at_operating_point(moved, "0.05"); }), "out_of_range");
}

TEST(OperatingPoint, TimesThatNoRunReaches) {
  const Model model = model_of(hung);
  for (const char* at : {"1e7", "1e12", "1e99"})
    EXPECT_EQ(error_of([&] { at_operating_point(model, at); }), "too_large") << at;
}

}  // namespace
}  // namespace floatframe::test

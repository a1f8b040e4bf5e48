// What formulas read of the last accepted instant, at starts, in linear systems and in equilibria.
#include <gtest/gtest.h>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/contains.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A box of 3 kg that slides along x with 1 m/s, and a force on it.
Model weighed_box(const std::string& force) {
  return model_of(R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, velocity: 1}}
measures:
  box: {acceleration: {body: box}}
  N: {joint_force: slide}
forces:
  push: {type: joint_spring, joint: slide, actuator: {formula: ')" +
                  force + R"('}}
outputs: {a: {acceleration: {body: box}, axis: x}, f: {force: push}}
simulation: {step: 0.001, duration: 0.1}
)");
}

// a = (6 - a) / 3
TEST(SamplesAtTheStart, AreConsistentWithTheForces) {
  const Model model = weighed_box("6 - box.x");
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    EXPECT_NEAR(s.output("a"), 1.5, 1e-9);
    EXPECT_NEAR(s.output("f"), -4.5, 1e-9);
    s.step();
    EXPECT_NEAR(s.output("a"), 1.5, 1e-6);
  }
}

// A friction that knows the reaction brakes from the first instant.
TEST(SamplesAtTheStart, KnowReactions) {
  const Model model = weighed_box("-0.2 * N.z * tanh(rate(slide) / 0.1)");
  for (const Coordinates c : both_coordinates)
    EXPECT_NEAR(Simulation(model, {.coordinates = c}).output("a"), -0.2 * 9.81 * std::tanh(10.0),
                1e-9);
}

// 6 - 6 a against 3 a: each round would double the acceleration.
TEST(SamplesAtTheStart, SayThatTheyDoNotSettle) {
  const Simulation s(weighed_box("6 - 6 * box.x"), {});
  EXPECT_TRUE(contains(s.start_report().notes, "'push/actuator'"));
}

// The pole is -mu g / w for a speed of zero.
TEST(SamplesInLinearSystems, AreThoseOfTheOperatingPoint) {
  Model model = weighed_box("-0.2 * N.z * tanh(rate(slide) / 0.1)");
  model.joints[0].velocity = {0.0};
  for (const Coordinates c : both_coordinates) {
    const std::vector<LinearMode> modes = linear_modes(linear_system(model, {.coordinates = c}));
    EXPECT_NEAR(modes.back().lambda.real(), -0.2 * 9.81 / 0.1, 1e-6);
  }
}

TEST(SamplesInEquilibria, AreZeroAndSaidToBe) {
  const StaticsResult s = statics(weighed_box("-40 * angle(slide) + 0.1 * N.z"));
  EXPECT_NEAR(s.forces[0].force, 0.0, 1e-9);
  EXPECT_TRUE(contains(s.notes, "'push/actuator'"));
}

}  // namespace
}  // namespace floatframe::test

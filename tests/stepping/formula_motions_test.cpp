// Motions by formulas that jump are refused, those with jumps of the velocity named.
#include <gtest/gtest.h>

#include "floatframe/run/run.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string driven(const std::string& motion, const std::string& rest = "") {
  return R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}, c: {position: [1, 0, 0], rigid: {mass: 1}}}
joints:
  z: {type: prismatic, child: b, at: [0, 0, 0], axis: z, motion: )" +
         motion + R"(}
  y: {type: prismatic, child: c, at: [1, 0, 0], axis: z}
simulation: {step: 0.001, duration: 0.5}
)" + rest;
}

std::string errors_of_motion(const std::string& motion, const std::string& rest = "") {
  return error_of([&] { model_of(driven(motion, rest)); });
}

TEST(FormulaMotions, DoNotJump) {
  for (const char* const text : {"floor(5 * t)", "if(t < 0.2, 0, 1)", "round(10 * t) * 0.1"})
    EXPECT_TRUE(contains(errors_of_motion(std::string("{formula: '") + text + "'}"),
                         "joints.z.motion: contradiction"))
        << text;
  EXPECT_TRUE(contains(
      sentences_of([] { model_of(driven("{formula: 'sign(t - 0.123)'}")); }),
      "joints.z.motion: found a jump by 1 at t = 0.123 s, expected a function without jumps: a "
      "motion cannot jump"));
  EXPECT_TRUE(contains(errors_of_motion("0",
                                        "couplings: {g: {terms: [{joint: z}, {joint: y}], value: "
                                        "{formula: 'floor(4 * t)'}}}"),
                       "couplings.g.value: contradiction"));
}

// Beyond the duration of the file, which a run may exceed. What is stepped has no end.
TEST(FormulaMotions, DoNotJumpInTheRun) {
  const Model model = model_of(driven("{formula: 'if(t < 0.7, t, t + 1)'}"));
  SimulationDescription options = model.simulation;
  EXPECT_EQ(run(model, options).summary.status, "completed");
  options.duration = 2.0;
  EXPECT_EQ(error_of([&] { run(model, options); }), "contradiction");
  EXPECT_TRUE(contains(Simulation(model).start_report().notes, " = 0.7 "));
}

TEST(FormulaMotions, JumpsOfTheVelocityAreNoted) {
  const Model model = model_of(driven("{formula: '0.1 * abs(t - 0.2) + sin(9 * t)'}"));
  EXPECT_TRUE(contains(Simulation(model).start_report().notes,
                       "the motion of joint 'z' jumps in its velocity, by 0.2 m/s at t = 0.2 s"));
}

}  // namespace
}  // namespace floatframe::test

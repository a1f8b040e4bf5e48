// Formulas without a value: of controllers, also those that nothing reads, of holds and delays they
// end a run; of outputs they are a warning. Each with its formula and time.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/run/range_warnings.hpp"
#include "floatframe/run/run.hpp"
#include "support/completed_run.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

RunResult run_with_fault(const std::string& rest, Coordinates coordinates) {
  const Model model = model_of(R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z}}
simulation: {step: 0.0078125, duration: 0.3}
)" + rest);
  return run(model, with(model.simulation, coordinates));
}

class FormulaFaults : public ::testing::TestWithParam<Coordinates> {
 protected:
  /// The run ends at 1/8 s with this in its message, and the results up to there.
  void ends(const std::string& controller, const std::string& why) const {
    const std::string text =
        "outputs: {x: {joint_position: z}}\ncontrollers: {c: " + controller + "}\n";
    const RunResult r = run_with_fault(text, GetParam());
    EXPECT_EQ(r.summary.status, "failed") << controller;
    EXPECT_NE(r.summary.message.find(why), std::string::npos) << r.summary.message;
    EXPECT_NE(r.summary.message.find("step failed at t = 0.12"), std::string::npos)
        << r.summary.message;
    EXPECT_GE(r.table.rows(), 16u) << controller;
  }
};

TEST_P(FormulaFaults, EndARun) {
  const std::string division = "division by zero in '(1 / (t - 0.125))'";
  ends("{type: formula, formula: '1 / (t - 0.125) + 0 * angle(z)'}", division);
  ends("{type: zero_order_hold, input: {formula: '1 / (t - 0.125)'}, period: 0.125}", division);
  ends("{type: zero_order_hold, input: {formula: '1 / (t - 0.125) + 0 * angle(z)'}, period: 0.125}",
       division);
  ends("{type: delay, input: {formula: 'sqrt(0.125 - t)'}, time: 0.04}",
       "'sqrt((0.125 - t))' is not defined for");
  ends("{type: delay, input: {formula: 'sqrt(0.125 - t) + 0 * angle(z)'}, time: 0.04}",
       "'sqrt((0.125 - t))' is not defined for");
  ends("{type: integrator, input: {formula: 'sqrt(0.125 - t)'}, initial: 0}",
       "'sqrt((0.125 - t))' is not defined for");
  ends("{type: formula, formula: 'exp(5678 * t) + 0 * angle(z)'}", "' is not a finite number");
}

// An instant of a sample within a step.
TEST_P(FormulaFaults, EndARunWithinAStep) {
  const RunResult r = run_with_fault(
      "controllers: {c: {type: zero_order_hold, input: {formula: 'sqrt(0.1 - t)'}, period: 0.035}}",
      GetParam());
  EXPECT_EQ(r.summary.status, "failed");
  EXPECT_NE(
      r.summary.message.find("step failed at t = 0.105 s: zero_order_hold 'c': 'sqrt((0.1 - t))'"),
      std::string::npos)
      << r.summary.message;
}

TEST_P(FormulaFaults, NameTheFormulaThatOthersFollow) {
  const RunResult r = run_with_fault(R"(
forces: {n: {type: joint_spring, joint: z, actuator: {controller: b}}}
controllers:
  b: {type: formula, formula: '2 * controller(a)'}
  a: {type: formula, formula: 'sqrt(0.1 - t) + 0 * angle(z)'}
)",
                                     GetParam());
  EXPECT_NE(r.summary.message.find("formula 'a': 'sqrt((0.1 - t))' is not defined"),
            std::string::npos)
      << r.summary.message;
}

TEST_P(FormulaFaults, OfOutputsAreAWarning) {
  RunResult r = run_with_fault(R"(
outputs:
  x: {joint_position: z}
  y: {formula: '1 / (0.125 - t)'}
  w: {formula: 'sqrt(0.2 - t)'}
  e: {formula: 'exp(1e4 * t)'}
  good: {formula: 'if(t < 0.1, 1 / (0.2 - t), 0)'}
)",
                               GetParam());
  EXPECT_EQ(r.summary.status, "completed") << r.summary.message;
  ASSERT_EQ(r.summary.warnings.size(), 1u);
  EXPECT_EQ(r.summary.warnings[0].limit, RangeLimit::formula);
  EXPECT_EQ(
      r.summary.warnings[0].sentence,
      "output 'y' has no value: division by zero in '(1 / (0.125 - t))' at t = 0.125 s (and 2 "
      "more)");
  EXPECT_TRUE(std::isnan(r.table.at(16, 2)));
  EXPECT_FALSE(std::isnan(r.table.at(17, 2)));
  for (std::size_t i = 0; i < r.table.rows(); ++i) EXPECT_FALSE(std::isnan(r.table.at(i, 5)));
  make_strict(r.summary);
  EXPECT_EQ(r.summary.status, "failed");
}

TEST_P(FormulaFaults, OfCrossingsAreAWarning) {
  const RunResult r =
      run_with_fault("outputs: {first: {first_crossing: 'sqrt(0.2 - t) - 9'}}\n", GetParam());
  ASSERT_EQ(r.summary.warnings.size(), 1u);
  EXPECT_NE(r.summary.warnings[0].sentence.find("output 'first' has no value: 'sqrt((0.2 - t))'"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Both, FormulaFaults, ::testing::ValuesIn(both_coordinates),
                         [](const auto& x) { return name_of(x.param); });

}  // namespace
}  // namespace floatframe::test

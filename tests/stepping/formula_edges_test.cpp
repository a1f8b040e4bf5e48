// Edges of formulas, located: roots and powers that end at them, against the rebound of Hertz;
// friction that sticks on one; those of laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/completed_run.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A ball of 1 kg on a guide along x.
std::string ball_on_guide(const std::string& joint, const std::string& rest) {
  return R"(
gravity: [0, 0, 0]
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: x, )" +
         joint + R"(}}
outputs: {x: {joint_position: z}, v: {joint_velocity: z}}
)" + rest;
}

class FormulaEdges : public ::testing::TestWithParam<Coordinates> {
 protected:
  RunResult located(const std::string& text, double step, double duration) const {
    const Model model = model_of(text);
    SimulationDescription o = with(model.simulation, GetParam(), step, duration);
    o.locate_edges = true;
    return completed_run(model, o);
  }
};

// m x'' = k (-x)^1.5 from x = 0 at -1 m/s: it is back there after
//   T = 2 d I, d = (5 m/(4 k))^0.4, I = integral of du/sqrt(1 - u^2.5) over (0, 1)
// at 1 m/s. Beyond the edge a trial step leaves the range of the root or power.
TEST_P(FormulaEdges, PowersAndRootsEndAtThem) {
  constexpr double start = 0.0503, end = 0.1;
  const double I = std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9);
  const double back = end - start - 2.0 * std::pow(1.25e-6, 0.4) * I;
  const auto error = [&](const std::string& force, double step) {
    const RunResult r = located(ball_on_guide("position: 0.0503, velocity: -1", force), step, end);
    EXPECT_EQ(r.summary.edges, 2) << force;
    EXPECT_EQ(r.summary.substeps, 0) << force;
    return std::abs(r.table.data[r.table.data.size() - 2] - back);
  };
  for (const std::string formula :
       {"1e6 * max(0, -angle(z)) ^ 1.5", "if(angle(z) < 0, 1e6 * (-angle(z)) ^ 1.5, 0)",
        "1e6 * sqrt(max(0, -angle(z))) ^ 3", "1e6 * clip(-angle(z), 0, 1) ^ 1.5",
        "1e6 * ((abs(angle(z)) - angle(z)) / 2) ^ 1.5", "1e6 * max(0, -angle(z)) ^ (1.5 + 0 * t)"})
    for (const bool apart : {false, true}) {
      std::string force = "forces: {n: {type: joint_spring, joint: z, actuator: {";
      force += apart ? "controller: c}}}\ncontrollers: {c: {type: formula, formula: '" + formula +
                           "'}}\n"
                     : "formula: '" + formula + "'}}}\n";
      const double coarse = error(force, 1e-3), fine = error(force, 5e-4);
      EXPECT_LT(coarse, 7e-5) << formula;
      EXPECT_GT(coarse, 3.0 * fine) << formula;
    }
}

// What has nothing to do with an edge still ends the run.
TEST_P(FormulaEdges, HideNoFault) {
  const Model model = model_of(ball_on_guide(
      "velocity: 0.3",
      "forces: {n: {type: joint_spring, joint: z, actuator: {formula: 'max(0, angle(z) - 0.01) + "
      "sqrt(0.05 - t)'}}}\n"));
  SimulationDescription o = with(model.simulation, GetParam(), 1e-3, 0.1);
  o.locate_edges = true;
  const RunResult r = run(model, o);
  EXPECT_EQ(r.summary.status, "failed");
  EXPECT_NE(r.summary.message.find("'sqrt((0.05 - t))' is not defined"), std::string::npos)
      << r.summary.message;
  EXPECT_NEAR(r.summary.duration, 0.05, 1e-5);
}

// m x'' = -x - 5 sign(x') stops where v^2/2 = 5 x + x^2/2 and sticks there, on an edge: the rest of
// each such step is made without the key.
TEST_P(FormulaEdges, FrictionThatSticksIsFinishedWithout) {
  const RunResult r = located(
      ball_on_guide("velocity: 0.3",
                    "forces: {n: {type: joint_spring, joint: z, spring: 1, actuator: {formula: "
                    "'-5 * sign(rate(z))'}}}\n"),
      1e-3, 0.3);
  EXPECT_NEAR(r.table.data[r.table.data.size() - 2], std::sqrt(25.09) - 5.0, 3e-5);
  EXPECT_GT(r.summary.edges_passed, 100);
  EXPECT_LT(r.summary.edges, 17 * 300);
  EXPECT_LT(r.summary.substeps, 40 * 300);
  const auto is_edges = [](const RangeWarning& w) { return w.limit == RangeLimit::edges; };
  EXPECT_EQ(std::ranges::count_if(r.summary.warnings, is_edges), 1);
}

// A fall of 0.05 m at 9.81 m/s2 onto a constant push: accelerations are constant between edges, and
// located steps are exact.
TEST_P(FormulaEdges, OfLawsAreLocated) {
  constexpr double g = 9.81, up = 100.0, height = 0.05, end = 0.2;
  const double speed = std::sqrt(2.0 * g * height), since = end - speed / g - 2.0 * speed / up;
  const double x = speed * since - 0.5 * g * since * since;
  for (const char* law : {"if(x < 0, -100, 9.81)", "9.81 - 54.905 * (1 - sign(x))"}) {
    const RunResult r = located(
        ball_on_guide("position: 0.05", std::string("forces: {n: {type: force_law, joint: z, "
                                                    "law: {formula: '") +
                                            law + "'}}}\n"),
        1e-3, end);
    EXPECT_EQ(r.summary.edges, 2) << law;
    EXPECT_NEAR(r.table.data[r.table.data.size() - 2], x, 1e-7) << law;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, FormulaEdges, ::testing::ValuesIn(both_coordinates),
                         [](const auto& x) { return name_of(x.param); });

}  // namespace
}  // namespace floatframe::test

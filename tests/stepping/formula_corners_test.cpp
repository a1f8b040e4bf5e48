// Corners of formulas of the time: against the same functions as tables and steps, whose corners
// are known, and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "support/completed_run.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

class FormulaCorners : public ::testing::TestWithParam<Coordinates> {
 protected:
  RunResult run_with(const std::string& magnitude, bool locate_edges = false) const {
    const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z}}
outputs: {x: {joint_position: z}, v: {joint_velocity: z}}
forces: {f: {type: force, body: b, direction: z, magnitude: {)" +
                                 magnitude + "}}}\n");
    SimulationDescription o = with(model.simulation, GetParam(), 0.01, 0.5);
    o.locate_edges = locate_edges;
    return completed_run(model, o);
  }
};

TEST_P(FormulaCorners, AreThoseOfTables) {
  for (const auto& [formula, table, corners] :
       {std::tuple{"if(t < 0.303, 1, -1)", "steps: [[0, 1], [0.303, -1]]", 1},
        std::tuple{"1 - 2 * floor(t / 0.303)", "steps: [[0, 1], [0.303, -1]]", 1},
        std::tuple{"-sign(t - 0.303)", "steps: [[0, 1], [0.303, -1]]", 1},
        std::tuple{"clip(t - 0.1037, 0, 0.0551)",
                   "table: [[0, 0], [0.1037, 0], [0.1588, 0.0551], [1, 0.0551]]", 2},
        std::tuple{"max(0, 0.4 - t)", "table: [[0, 0.4], [0.4, 0], [1, 0]]", 1}})
    for (const bool located : {false, true}) {
      const RunResult a = run_with("formula: '" + std::string(formula) + "'", located);
      const RunResult b = run_with(table, located);
      EXPECT_EQ(a.summary.corners, corners) << formula;
      ASSERT_EQ(a.table.data.size(), b.table.data.size());
      for (std::size_t k = 0; k < a.table.data.size(); ++k)
        EXPECT_NEAR(a.table.data[k], b.table.data[k], 1e-12) << formula;
    }
}

TEST_P(FormulaCorners, StepsBetweenThemAreExact) {
  const RunResult r = run_with("formula: 'if(t < 0.303, 1, -1)'");
  const double v = 0.303, rest = 0.5 - 0.303, x = 0.5 * v * v + v * rest - 0.5 * rest * rest;
  EXPECT_NEAR(r.table.data[r.table.data.size() - 2], x, 1e-12);
}

// More corners than a step is divided at: it samples them.
TEST_P(FormulaCorners, OfAFastSignalAreSampled) {
  const RunResult r = run_with("formula: 'sign(sin(1e5 * t + 1))'");
  EXPECT_LE(r.summary.corners, 17 * 50);
}

TEST_P(FormulaCorners, OfMotions) {
  const auto run_of_motion = [&](const std::string& formula) {
    const Model model = model_of(R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 2}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: x, motion: {formula: ')" +
                                 formula + R"('}}}
outputs: {x: {joint_position: z}, f: {motion_force: z}}
)");
    return completed_run(model, with(model.simulation, GetParam(), 0.01, 0.2));
  };
  const RunResult smooth = run_of_motion("if(t < 0.1037, 0, (t - 0.1037) ^ 2)");
  EXPECT_EQ(smooth.summary.corners, 1);
  EXPECT_NEAR(std::abs(smooth.table.data.back()), 4.0, 1e-6);
  EXPECT_TRUE(smooth.summary.start.notes.empty());
  const RunResult jumps = run_of_motion("max(0, t - 0.1037)");
  EXPECT_EQ(jumps.summary.corners, 0);
  ASSERT_EQ(jumps.summary.start.notes.size(), 1u);
  EXPECT_NE(jumps.summary.start.notes[0].find("jumps in its velocity, by 1 m/s at t = 0.1037 s"),
            std::string::npos)
      << jumps.summary.start.notes[0];
}

INSTANTIATE_TEST_SUITE_P(Both, FormulaCorners, ::testing::ValuesIn(both_coordinates),
                         [](const auto& x) { return name_of(x.param); });

}  // namespace
}  // namespace floatframe::test

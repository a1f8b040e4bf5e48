// N parallelograms in a row that fold flat (IFToMM benchmark A02): where all bars lie on one line
// the loop constraints are dependent, and the mechanism could go on as an antiparallelogram. The
// cranks stay parallel: with rods of 1 kg and 1 m and the angle theta from the vertical,
//   theta'' = g ((N + 1)/2 + N) / ((N + 1)/3 + N) sin theta,
// a pendulum, integrated by itself in small steps. Start upright with 1 rad/s.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double gravity = 9.81;

/// `thin`: the bars have no inertia about their own axes.
std::string windows_text(int n, bool thin = false) {
  std::string bodies, joints;
  const std::string own = thin ? "0" : "0.0833333333";
  const std::string crank = "inertia: [0.0833333333, " + own + ", 0.0833333333]";
  const std::string bar = "inertia: [" + own + ", 0.0833333333, 0.0833333333]";
  for (int i = 0; i <= n; ++i) {
    bodies += fmt::format("  crank_{}: {{rigid: {{mass: 1, centre_of_mass: [{}, 0.5, 0], {}}}}}\n",
                          i, i, crank);
    joints += fmt::format(
        "  a_{}: {{type: revolute, child: crank_{}, at: [{}, 0, 0], axis: z, velocity: -1}}\n", i,
        i, i);
  }
  for (int i = 1; i <= n; ++i) {
    bodies += fmt::format("  bar_{}: {{rigid: {{mass: 1, centre_of_mass: [{}, 1, 0], {}}}}}\n", i,
                          i - 0.5, bar);
    joints += fmt::format(
        "  b_{}: {{type: revolute, parent: crank_{}, child: bar_{}, at: [{}, 1, 0], axis: z, "
        "velocity: 1}}\n",
        i, i - 1, i, i - 1);
    joints += fmt::format(
        "  c_{}: {{type: revolute, parent: bar_{}, child: crank_{}, at: [{}, 1, 0], axis: z, cut: "
        "true}}\n",
        i, i, i, i);
  }
  return fmt::format("gravity: [0, -{}, 0]\nbodies:\n{}joints:\n{}", gravity, bodies, joints) +
         fmt::format("outputs: {{end: {{position: {{body: crank_{}, at: [{}, 1, 0]}}}}}}\n", n, n);
}

/// Largest distance of the end of the last crank from where the pendulum has it [m].
double largest_error(int n, const RunResult& r) {
  const double k = gravity * ((n + 1) / 2.0 + n) / ((n + 1) / 3.0 + n);
  double theta = 0.0, rate = 1.0, t = 0.0, worst = 0.0;
  constexpr double h = 1e-4;
  for (std::size_t row = 0; row < r.table.rows(); ++row) {
    for (; t < r.table.at(row, 0) - 0.5 * h; t += h) {  // Runge and Kutta, fourth order
      const auto f = [&](double x) { return k * std::sin(x); };
      const double v1 = rate, a1 = f(theta);
      const double v2 = rate + 0.5 * h * a1, a2 = f(theta + 0.5 * h * v1);
      const double v3 = rate + 0.5 * h * a2, a3 = f(theta + 0.5 * h * v2);
      const double v4 = rate + h * a3, a4 = f(theta + h * v3);
      theta += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    worst = std::max(worst, std::hypot(r.table.at(row, 1) - n - std::sin(theta),
                                       r.table.at(row, 2) - std::cos(theta)));
  }
  return worst;
}

void expect_one_branch(const RunResult& r, const std::string& part) {
  std::size_t branches = 0;
  for (const RangeWarning& w : r.summary.warnings) {
    if (w.limit != RangeLimit::branch) continue;
    ++branches;
    std::printf("[ figure ] %s\n", w.sentence.c_str());
    EXPECT_TRUE(contains(w.sentence, part));
  }
  EXPECT_EQ(branches, 1u);
}

struct Fold {
  int windows;
  Coordinates coordinates;
  double step, duration, error;
};

class Folding : public ::testing::TestWithParam<Fold> {};

TEST_P(Folding, PassesSingularPositions) {
  const Fold& p = GetParam();
  const Model model = model_of(windows_text(p.windows));
  SimulationDescription o = with(model.simulation, p.coordinates, p.step, p.duration);
  o.tolerance = 1e-9;
  const RunResult r = completed_run(model, o);
  const double error = largest_error(p.windows, r);
  std::printf(
      "[ figure ] folding: %d windows, %s, step %g, %g s: largest error [m] %.2g, %ld of %ld steps "
      "halved\n",
      p.windows, name_of(p.coordinates).c_str(), p.step, p.duration, error, r.summary.substeps,
      r.summary.steps);
  EXPECT_LT(error, p.error);
  // It says where it passed.
  expect_one_branch(r, "constraints of joint '");
}

// Forty windows fold for the first time at about 0.7 s.
INSTANTIATE_TEST_SUITE_P(Rows, Folding,
                         ::testing::Values(Fold{2, Coordinates::relative, 5e-3, 10.0, 1e-3},
                                           Fold{2, Coordinates::relative, 1e-3, 10.0, 1e-3},
                                           Fold{2, Coordinates::absolute, 5e-3, 10.0, 1e-2},
                                           Fold{2, Coordinates::absolute, 1e-3, 10.0, 1e-3},
                                           Fold{40, Coordinates::relative, 5e-3, 10.0, 1e-3},
                                           Fold{40, Coordinates::relative, 1e-3, 10.0, 1e-3},
                                           Fold{40, Coordinates::absolute, 5e-3, 10.0, 1e-2},
                                           Fold{40, Coordinates::absolute, 1e-3, 3.0, 1e-3}));

TEST(FoldingThinBars, PassingIsReportedInBothFormulations) {
  const Model model = model_of(windows_text(2, true));
  for (const Coordinates coordinates : both_coordinates) {
    SimulationDescription o = with(model.simulation, coordinates, 1e-3, 1.0);
    o.tolerance = 1e-9;
    const RunResult r = completed_run(model, o);
    expect_one_branch(r, "t = 0.714 s");
  }
}

}  // namespace
}  // namespace floatframe::test

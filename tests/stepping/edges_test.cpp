// Steps that are divided where forces jump: a wheel on stairs against a reference, order with and
// without, energy, the same bits again, saved and resumed, no allocation.
#include <gtest/gtest.h>

#include "floatframe/run/run.hpp"
#include "support/allocation_counter.hpp"
#include "support/figures.hpp"
#include "support/quarter_car.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

constexpr double interval = 0.02, duration = 0.8;

class Edges : public ::testing::TestWithParam<Coordinates> {
 protected:
  SimulationDescription options(const Model& model, double step, bool locate) const {
    SimulationDescription o = with(model.simulation, GetParam(), step, duration);
    o.output_interval = interval;
    o.locate_edges = locate;
    return o;
  }
};

double largest_height_error(const ResultTable& table,
                            const std::vector<std::array<double, 2>>& reference) {
  EXPECT_EQ(table.rows(), reference.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(table.rows(), reference.size()); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      worst = std::max(worst, std::abs(table.at(i, k + 1) - reference[i][k]));
  return worst;
}

// Where in a step an edge lies is chance: errors are those of several starts.
TEST_P(Edges, LocatedTheErrorFallsWithTheSquareOfTheStep) {
  constexpr int starts = 6;
  const int count = static_cast<int>(std::lround(duration / interval));
  for (const bool locate : {false, true}) {
    double previous = 0.0, first = 0.0, last = 0.0;
    for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4}) {
      double sum = 0.0;
      for (int start = 0; start < starts; ++start) {
        const double begin = 0.5 + 0.00137 * start;
        const Model model = model_of(quarter_car(begin, "step: 0.001"));
        const RunResult r = completed_run(model, options(model, h, locate));
        EXPECT_EQ(r.table.rows(), static_cast<std::size_t>(count + 1)) << "rows of the grid only";
        if (locate) {
          EXPECT_GE(r.summary.edges, 10);
          EXPECT_EQ(r.summary.edges_passed, 0);
        } else {
          EXPECT_EQ(r.summary.edges, 0);
        }
        const double e =
            largest_height_error(r.table, QuarterCarReference(begin).positions(interval, count));
        sum += e * e;
      }
      const double error = std::sqrt(sum / starts);
      figure(std::string(locate ? "located" : "not located") + ", step " + std::to_string(h) +
                 " s: error [m]",
             error);
      if (previous > 0.0) figure("  order", std::log2(previous / error));
      if (previous > 0.0 && locate) {
        EXPECT_GT(std::log2(previous / error), 1.8);
        EXPECT_LT(std::log2(previous / error), 2.2);
      }
      if (first == 0.0) first = error;
      previous = last = error;
    }
    if (!locate) {
      EXPECT_LT(std::log2(first / last) / 3.0, 1.5) << "order without";
    }
  }
}

TEST_P(Edges, TheEnergyBalanceClosesWithTheSquareOfTheStep) {
  const Model model = model_of(quarter_car(0.503, "step: 0.001"));
  double previous = 0.0;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const EnergySummary e = run(model, options(model, h, true)).summary.energy;
    const double rest = std::abs(e.largest_remainder);
    figure("largest remainder of the energy [J]", rest);
    EXPECT_LT(rest, 1e-2 * e.exchanged);
    if (previous > 0.0) {
      EXPECT_GT(previous / rest, 3.0);
      EXPECT_LT(previous / rest, 5.0);
    }
    previous = rest;
  }
}

TEST_P(Edges, StatesAndCheckpointsGoOnWithEqualBits) {
  const Model model = model_of(quarter_car(0.503, "step: 0.001"));
  const SimulationOptions o{.step = 1e-3, .coordinates = GetParam(), .locate_edges = true};
  const auto rows = [](Simulation& s, int steps) {
    std::vector<double> all;
    for (int k = 0; k < steps; ++k) {
      EXPECT_TRUE(s.step()) << s.failure();
      all.push_back(s.time());
      all.insert(all.end(), s.outputs().begin(), s.outputs().end());
      all.push_back(static_cast<double>(s.counters().edges));
      all.push_back(static_cast<double>(s.counters().iterations));
    }
    return all;
  };
  Simulation whole(model, o);
  // Between any two steps near the first edges, at 0.1 s, and at touch.
  for (const int until : {95, 101, 110, 190}) {
    Simulation s(model, o);
    rows(s, until);
    const std::vector<std::byte> bytes = s.save().to_bytes();
    const std::vector<double> first = rows(s, 250);
    EXPECT_GT(s.counters().edges, 5);
    whole.restore(SimulationState::from_bytes(bytes));
    EXPECT_EQ(whole.save().to_bytes(), bytes);
    EXPECT_TRUE(equal_bits(rows(whole, 250), first)) << until;
  }
  const SimulationDescription d = options(model, 1e-3, true);
  const RunResult r = run(model, d);
  RunCheckpoint kept;
  RunOptions keeping;
  keeping.checkpoint_every = 0.317;
  keeping.checkpoint = [&kept](const RunCheckpoint& c) {
    if (kept.bytes.empty()) kept = c;
  };
  run(model, d, keeping);
  ASSERT_FALSE(kept.bytes.empty());
  RunOptions resuming;
  resuming.resume = &kept;
  const RunResult again = run(model, d, resuming);
  EXPECT_EQ(again.summary.energy.remainder, r.summary.energy.remainder);
  EXPECT_EQ(again.summary.energy.total_end, r.summary.energy.total_end);
  EXPECT_EQ(again.summary.edges, r.summary.edges);
}

TEST_P(Edges, NoStepAllocates) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = model_of(quarter_car(0.503, "step: 0.001"));
  const SimulationOptions o{.step = 2e-3, .coordinates = GetParam(), .locate_edges = true};
  Simulation s(model, o);
  s.step();
  const AllocationScope scope;
  for (int k = 1; k < 400; ++k) ASSERT_TRUE(s.step());
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_GE(s.counters().edges, 10);
}

// At rest on the very edge of a step nothing is located again and again.
TEST_P(Edges, AWheelAtRestOnAnEdgeStaysThere) {
  std::string text = quarter_car(0.5, "step: 0.002, duration: 1");
  const std::string moving = "motion: {polynomial: [0, 5]}";
  text.replace(text.find(moving), moving.size(), "motion: {polynomial: [0.5]}");
  const Model model = model_of(text);
  const RunResult r = completed_run(model, options(model, 2e-3, true));
  EXPECT_LE(r.summary.edges, 60);
  EXPECT_EQ(r.summary.edges_passed, 0);
}

// Without an edge on its way a run is what it is without.
TEST_P(Edges, WithoutEdgesNothingChanges) {
  const Model model = model_of(R"(
bodies: {stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 1], inertia: [1, 1, 1]}}}
joints: {swing: {type: revolute, child: stone, at: [0, 0, 0], axis: y, position: 0.4}}
forces: {coil: {type: joint_spring, joint: swing, spring: 30, damper: 0.1}}
outputs: {angle: {joint_position: swing}}
simulation: {step: 0.001}
)");
  const RunResult with = run(model, options(model, 1e-3, true));
  const RunResult without = run(model, options(model, 1e-3, false));
  EXPECT_TRUE(equal_bits(with.table.data, without.table.data));
  EXPECT_EQ(with.summary.edges, 0);
}

INSTANTIATE_TEST_SUITE_P(Both, Edges, ::testing::ValuesIn(both_coordinates),
                         [](const auto& x) { return name_of(x.param); });

}  // namespace
}  // namespace floatframe::test

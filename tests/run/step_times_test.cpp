// Step times in a summary: bins that follow each other and hold every step.
#include "floatframe/run/step_times.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "floatframe/run/run.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

void expect_bins(const StepTimes& t) {
  ASSERT_EQ(t.edges.size(), t.counts.size() + 1);
  EXPECT_EQ(std::accumulate(t.counts.begin(), t.counts.end(), std::uint64_t{0}), t.steps);
  EXPECT_GT(t.counts.front(), 0u);
  EXPECT_GT(t.counts.back(), 0u);
  for (std::size_t k = 1; k < t.edges.size(); ++k) {
    ASSERT_LT(t.edges[k - 1], t.edges[k]);
    if (t.edges[k - 1] > 1e-7) {
      EXPECT_LE(t.edges[k] / t.edges[k - 1], 1.126) << k;
    }
  }
}

TEST(StepTimes, OfKnownValues) {
  Histogram h;
  for (int k = 0; k < 99; ++k) h.add(200'000 + 100 * k);
  h.add(5'000'000);
  const StepTimes t = step_times(h);
  expect_bins(t);
  EXPECT_EQ(t.steps, 100u);
  EXPECT_NEAR(t.median, 205e-6, 0.04 * 205e-6);
  EXPECT_NEAR(t.percent_99, 210e-6, 0.04 * 210e-6);
  EXPECT_EQ(t.largest, 5e-3);
  EXPECT_LE(t.edges.front(), 200e-6);
  EXPECT_GT(t.edges.back(), 5e-3);
  EXPECT_EQ(step_times(Histogram()).steps, 0u);
  EXPECT_TRUE(step_times(Histogram()).edges.empty());
}

TEST(StepTimes, RunsCountEveryStep) {
  const Model model = model_of(stepped_machine);
  const RunSummary whole = run(model, model.simulation).summary;
  expect_bins(whole.step_times);
  EXPECT_EQ(whole.step_times.steps, static_cast<std::uint64_t>(whole.steps));
  EXPECT_LE(whole.step_times.median, whole.step_times.largest);
  // Of a run that goes on, the steps before count too.
  std::vector<RunCheckpoint> points;
  RunOptions options;
  options.rows = [](const std::vector<Column>&, std::span<const double>) {};
  options.checkpoint_every = 0.13;
  options.checkpoint = [&](const RunCheckpoint& c) { points.push_back(c); };
  run(model, model.simulation, options);
  ASSERT_FALSE(points.empty());
  options.resume = &points.front();
  const RunSummary resumed = run(model, model.simulation, options).summary;
  expect_bins(resumed.step_times);
  EXPECT_EQ(resumed.step_times.steps, whole.step_times.steps);
}

}  // namespace
}  // namespace floatframe::test

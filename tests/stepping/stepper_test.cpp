// The grid of times, and that all loops over steps start alike and make the same ones: a run, a
// simulation, real time, a second system at the same start.
#include "floatframe/stepping/stepper.hpp"

#include <gtest/gtest.h>

#include "floatframe/realtime/realtime.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

TEST(TimeGrid, StepsEndOnTheGrid) {
  TimeGrid grid(2.0, 0.1, TimeGrid::endless);
  EXPECT_EQ(grid.steps(), std::numeric_limits<long>::max());
  for (int k = 1; k <= 1000; ++k) {
    const PlannedStep s = grid.next();
    EXPECT_EQ(s.size, 0.1);
    EXPECT_NEAR(s.to, 2.0 + 0.1 * k, 1e-15 * k);
    EXPECT_TRUE(s.whole && s.on_grid);
    grid.made(s);
  }
  EXPECT_EQ(grid.since_base(), 1000);
}

TEST(TimeGrid, OnlyTheLastStepMayBeAPart) {
  TimeGrid grid(0.5, 0.02, 0.05);
  ASSERT_EQ(grid.steps(), 3);
  for (int k = 1; k <= 3; ++k) {
    const PlannedStep s = grid.next();
    EXPECT_EQ(s.whole, k < 3);
    EXPECT_NEAR(s.size, k < 3 ? 0.02 : 0.01, 1e-15);
    if (k == 3) {
      EXPECT_EQ(s.to, 0.55);
    }
    grid.made(s);
  }
}

TEST(TimeGrid, RoundingMakesNoPart) {
  // 3 x 0.1 is more than 0.3, 3 x 0.7 less than 2.1.
  for (const double step : {0.1, 0.7, 1e-3, 1.0 / 3.0})
    for (const int n : {1, 3, 7, 1000}) {
      const double duration = std::round(1e4 * n * step) / 1e4;
      if (std::abs(duration - n * step) > 1e-9 * step) continue;
      TimeGrid grid(0.0, step, duration);
      ASSERT_EQ(grid.steps(), n);
      for (int k = 1; k <= n; ++k) {
        const PlannedStep s = grid.next();
        EXPECT_TRUE(s.whole) << k << " of " << n << ", " << step;
        EXPECT_EQ(s.size, step);
        EXPECT_LE(s.to, duration);
        grid.made(s);
      }
    }
  EXPECT_EQ(TimeGrid(0.0, 0.1, 0.0).steps(), 0);
}

// A bit of a late time is more than 1e-9 of a step.
TEST(TimeGrid, RoundingOfLateTimesMakesNoPart) {
  struct Late {
    double base, step, duration;
    long steps;
  };
  for (const Late& x : {Late{0.0, 0.0003, 2400.0399, 8000133}, Late{0.0, 1e-6, 60.000084, 60000084},
                        Late{0.0, 1e-6, 100.000021, 100000021}, Late{1e6, 1e-3, 1.00000001e-3, 1},
                        Late{-1e6, 1e-3, 5.00000001e-3, 5}, Late{1234567.8, 1e-3, 0.25, 250}}) {
    TimeGrid grid(x.base, x.step, x.duration);
    ASSERT_EQ(grid.steps(), x.steps) << x.base << ", " << x.step;
    for (long k = std::max(0L, x.steps - 1000); k < x.steps; ++k) {
      grid.restore(x.base, k);
      const PlannedStep s = grid.next();
      EXPECT_TRUE(s.whole) << k << " of " << x.steps << ", " << x.step;
      EXPECT_EQ(s.size, x.step);
      EXPECT_LE(s.to, x.base + x.duration);
    }
  }
  // A part that is more than rounding remains one.
  TimeGrid grid(1e6, 1e-3, 2.5e-3);
  ASSERT_EQ(grid.steps(), 3);
  grid.restore(1e6, 2);
  EXPECT_NEAR(grid.next().size, 0.5e-3, 1e-9);
}

TEST(TimeGrid, AStepOfAnotherSizeBeginsItAnew) {
  TimeGrid grid(0.0, 0.1, TimeGrid::endless);
  grid.made(grid.of_size(0.1, 0.0));
  EXPECT_EQ(grid.since_base(), 1);
  const PlannedStep s = grid.of_size(0.04, 0.1);
  EXPECT_FALSE(s.on_grid || s.whole);
  EXPECT_EQ(s.to, 0.1 + 0.04);
  grid.made(s);
  EXPECT_EQ(grid.next().to, 0.1 + 0.04 + 0.1);
  EXPECT_EQ(grid.next().size, 0.1);
}

constexpr int last = 25;

SimulationDescription description_of(const Model& m, Coordinates coordinates) {
  SimulationDescription d = with(m.simulation, coordinates);
  d.duration = last * d.step;
  return d;
}

const Model& machine() {
  static const Model m = model_of(stepped_machine);
  return m;
}

/// Rows of time and outputs after each step.
std::vector<double> rows_of(Stepper& steps) {
  const std::size_t width = steps.model().outputs.size() + 1;
  std::vector<double> rows(width * last);
  for (int k = 0; k < last; ++k) {
    EXPECT_TRUE(steps.advance()) << steps.failure();
    steps.sample(rows.data() + static_cast<std::ptrdiff_t>(k * width));
  }
  return rows;
}

void check_starts(Coordinates coordinates) {
  const SimulationDescription d = description_of(machine(), coordinates);
  Stepper first(machine(), d, {.duration = d.duration});
  const std::vector<double> rows = rows_of(first);
  EXPECT_EQ(first.counters().steps, last);
  EXPECT_EQ(first.state().t, first.begin() + d.duration);

  // Of a system that has moved on.
  Stepper second(first, d.duration);
  EXPECT_EQ(second.state().t, first.begin());
  EXPECT_TRUE(equal_bits(rows_of(second), rows)) << "a second system";

  const StepCounters before = first.counters();
  first.restart();
  EXPECT_EQ(first.counters().steps, 0);
  EXPECT_EQ(first.counters().iterations, 0);
  EXPECT_TRUE(equal_bits(rows_of(first), rows)) << "restarted";
  EXPECT_EQ(first.counters().iterations, before.iterations);

  const RunResult r = completed_run(machine(), d);
  const auto width = static_cast<std::ptrdiff_t>(r.table.columns.size());
  EXPECT_TRUE(equal_bits({r.table.data.begin() + width, r.table.data.end()}, rows)) << "a run";
  EXPECT_EQ(r.summary.iterations, before.iterations);
}

TEST(Stepper, StartsAgainWithTheSameBits) {
  for (const Coordinates c : both_coordinates) check_starts(c);
}

/// Outputs that come as they are sent.
class Rows final : public SignalPort {
 public:
  bool receive(InputBuffer&) noexcept override { return false; }
  void send(std::uint64_t, double time, std::span<const double> outputs, bool) noexcept override {
    values.push_back(time);
    values.insert(values.end(), outputs.begin(), outputs.end());
  }
  std::vector<double> values;
};

TEST(Stepper, AllLoopsMakeTheSameSteps) {
  for (const Coordinates coordinates : both_coordinates) {
    SimulationDescription d = description_of(machine(), coordinates);
    d.duration = (last - 0.4) * d.step;  // the last step is a part of one
    d.min_step = d.step / 8;             // as in real time
    const RunResult r = completed_run(machine(), d);
    ASSERT_EQ(r.table.rows(), last + 1u);
    const std::size_t width = r.table.columns.size();

    for (const bool paced : {false, true}) {
      Rows port;
      const RealTimeOptions options{.paced = paced};
      const RealTimeReport report = run_real_time(machine(), d, options, &port);
      EXPECT_EQ(report.status, "completed") << report.message;
      EXPECT_EQ(report.steps, last);
      EXPECT_EQ(report.time, d.duration);
      EXPECT_TRUE(equal_bits(port.values, r.table.data)) << "real time";
    }

    // They know no end: one step less.
    Simulation s(machine(), {.coordinates = coordinates, .min_step = d.min_step});
    for (int k = 1; k < last; ++k) {
      ASSERT_TRUE(s.step()) << s.failure();
      const auto expected = r.table.data.begin() + static_cast<std::ptrdiff_t>(k * width);
      const std::vector<double> of_run(expected, expected + static_cast<std::ptrdiff_t>(width));
      ASSERT_TRUE(
          equal_bits({s.outputs().begin(), s.outputs().end()}, {of_run.begin() + 1, of_run.end()}))
          << "simulation, step " << k;
    }
  }
}

void check_allocations(Coordinates coordinates) {
  const SimulationDescription d = description_of(machine(), coordinates);
  Stepper steps(machine(), d);
  std::vector<double> row(machine().outputs.size() + 1);
  ASSERT_TRUE(steps.advance());
  const AllocationScope scope;
  bool good = true;
  double sum = 0.0;
  for (int k = 0; k < last && good; ++k) {
    good = steps.advance() && steps.advance(steps.grid().of_size(0.7 * d.step, steps.state().t));
    steps.sample(row.data());
    sum += steps.energies().total();
  }
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_TRUE(good) << steps.failure();
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(Stepper, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  for (const Coordinates c : both_coordinates) check_allocations(c);
}

}  // namespace
}  // namespace floatframe::test

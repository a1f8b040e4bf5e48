// States leave a run as its rows do: without them it is the same, and from a checkpoint they go on.
#include <gtest/gtest.h>

#include "floatframe/simulation/simulation.hpp"
#include "floatframe/simulation/state_layout.hpp"
#include "simulation/stepping_models.hpp"
#include "support/allocation_counter.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

const Model& recorded_model() {
  static const Model m = model_of(stepped_machine);
  return m;
}

struct Kept {
  std::vector<double> rows, states;
};

RunOptions keeping(Kept& kept) {
  RunOptions options;
  options.rows = [&kept](const std::vector<Column>&, std::span<const double> numbers) {
    kept.rows.insert(kept.rows.end(), numbers.begin(), numbers.end());
  };
  options.states = [&kept](const StateLayout&, std::span<const double> numbers) {
    kept.states.insert(kept.states.end(), numbers.begin(), numbers.end());
  };
  return options;
}

class RunStates : public ::testing::TestWithParam<Coordinates> {
 protected:
  SimulationDescription options() const {
    SimulationDescription o = recorded_model().simulation;
    o.coordinates = GetParam();
    o.output_interval = 3.0 * o.step;
    o.record.every = 2;
    return o;
  }
};

TEST_P(RunStates, ARunThatIsRecordedIsTheSame) {
  Kept kept;
  run(recorded_model(), options(), keeping(kept));
  EXPECT_TRUE(equal_bits(kept.rows, run(recorded_model(), options()).table.data));
  const std::size_t columns = recorded_model().outputs.size() + 1,
                    rows = kept.rows.size() / columns;
  ASSERT_EQ(rows, 68u) << "200 steps by threes, and the last";
  // Every second row, and the last: their times are those of the rows.
  const std::size_t states = 35;
  ASSERT_EQ(kept.states.size() % states, 0u);
  const std::size_t width = kept.states.size() / states;
  for (std::size_t k = 0; k < states; ++k)
    EXPECT_EQ(kept.states[k * width], kept.rows[std::min(2 * k, rows - 1) * columns]) << k;
}

TEST_P(RunStates, ResumedRunsGoOnWithEqualStates) {
  Kept whole, kept;
  run(recorded_model(), options(), keeping(whole));
  struct Point {
    RunCheckpoint checkpoint;
    Kept before;
  };
  std::vector<Point> points;
  RunOptions with = keeping(kept);
  with.checkpoint_every = 0.13;
  with.checkpoint = [&](const RunCheckpoint& c) { points.push_back({c, kept}); };
  run(recorded_model(), options(), with);
  ASSERT_EQ(points.size(), 3u);
  for (Point& p : points) {
    Kept resumed = p.before;
    RunOptions rest = keeping(resumed);
    rest.resume = &p.checkpoint;
    run(recorded_model(), options(), rest);
    EXPECT_TRUE(equal_bits(resumed.states, whole.states)) << p.checkpoint.time;
    EXPECT_TRUE(equal_bits(resumed.rows, whole.rows)) << p.checkpoint.time;
    SimulationDescription other = options();
    other.record.accelerations = false;
    EXPECT_EQ(error_of([&] { run(recorded_model(), other, rest); }),
              "the checkpoint was made with another value of states recorded: found every 2, this "
              "run has every 2, without accelerations");
  }
}

TEST_P(RunStates, MemoryDoesNotGrowWithTheLength) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const auto allocations = [&](double duration) {
    SimulationDescription o = options();
    o.duration = duration;
    RunOptions counted;
    counted.rows = [](const std::vector<Column>&, std::span<const double>) {};
    counted.states = [](const StateLayout&, std::span<const double>) {};
    const AllocationScope scope;
    run(recorded_model(), o, counted);
    return scope.count();
  };
  EXPECT_LE(allocations(4.0), allocations(0.4) + 100);
}

INSTANTIATE_TEST_SUITE_P(All, RunStates,
                         ::testing::Values(Coordinates::relative, Coordinates::absolute));

}  // namespace
}  // namespace floatframe::test

// Rows leave a run while it goes on, a run is stopped between two steps, and one that was
// interrupted goes on from a checkpoint with equal bits.
#include <gtest/gtest.h>

#include <functional>

#include "floatframe/core/output_error.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/results/summary_json.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

struct StreamKind {
  Coordinates coordinates;
  InertiaMethod inertia;
  bool substeps;
};

const Model& streamed_model() {
  static const Model m = model_of(stepped_machine);
  return m;
}

SimulationDescription streamed_options(const StreamKind& kind) {
  SimulationDescription o = streamed_model().simulation;
  o.coordinates = kind.coordinates;
  o.inertia = kind.inertia;
  o.output_interval = 3.0 * o.step;
  if (kind.substeps) {
    o.max_iterations = 2;
    o.tolerance = 1e-11;
  }
  return o;
}

/// All but the time it took.
std::string summary_text_of(RunSummary s) {
  s.cpu = s.real_time_factor = 1.0;
  s.step_times = {};
  return summary_json(s);
}

RunOptions collecting(std::vector<double>& rows) {
  RunOptions options;
  options.rows = [&rows](const std::vector<Column>&, std::span<const double> numbers) {
    rows.insert(rows.end(), numbers.begin(), numbers.end());
  };
  return options;
}

class RunStream : public ::testing::TestWithParam<StreamKind> {};

TEST_P(RunStream, RowsAreThoseOfTheTable) {
  const SimulationDescription o = streamed_options(GetParam());
  const RunResult whole = run(streamed_model(), o);
  std::vector<double> rows;
  RunOptions options = collecting(rows);
  const RunResult streamed = run(streamed_model(), o, options);
  EXPECT_TRUE(equal_bits(rows, whole.table.data));
  EXPECT_EQ(streamed.table.rows(), 0u);
  EXPECT_EQ(streamed.table.columns.size(), whole.table.columns.size());
  EXPECT_EQ(summary_text_of(streamed.summary), summary_text_of(whole.summary));
}

TEST_P(RunStream, ResumedRunsGoOnWithEqualBits) {
  const SimulationDescription o = streamed_options(GetParam());
  RunOptions plain;
  plain.keep_state = true;
  const RunResult whole = completed_run(streamed_model(), o, plain);
  if (GetParam().substeps) {
    EXPECT_GT(whole.summary.substeps, 0);
  }

  struct Kept {
    RunCheckpoint checkpoint;
    std::size_t numbers;
  };
  std::vector<Kept> kept;
  std::vector<double> rows;
  RunOptions options = collecting(rows);
  options.keep_state = true;
  options.checkpoint_every = 0.05;
  options.checkpoint = [&](const RunCheckpoint& c) { kept.push_back({c, rows.size()}); };
  const RunResult with = run(streamed_model(), o, options);
  EXPECT_TRUE(equal_bits(rows, whole.table.data)) << "checkpoints change nothing";
  EXPECT_EQ(summary_text_of(with.summary), summary_text_of(whole.summary));
  ASSERT_EQ(kept.size(), 7u) << "of 0.4 s: none at its end";

  for (const Kept& k : kept) {
    std::vector<double> resumed(whole.table.data.begin(),
                                whole.table.data.begin() + static_cast<std::ptrdiff_t>(k.numbers));
    RunOptions rest = collecting(resumed);
    rest.keep_state = true;
    rest.resume = &k.checkpoint;
    const RunResult r = run(streamed_model(), o, rest);
    EXPECT_TRUE(equal_bits(resumed, whole.table.data)) << k.checkpoint.time;
    EXPECT_EQ(summary_text_of(r.summary), summary_text_of(whole.summary)) << k.checkpoint.time;
    EXPECT_EQ(state_json(*r.state), state_json(*whole.state)) << k.checkpoint.time;
  }
}

TEST_P(RunStream, AStoppedRunContinues) {
  const SimulationDescription o = streamed_options(GetParam());
  const RunResult whole = run(streamed_model(), o);
  std::atomic<bool> stop{false};
  std::optional<RunCheckpoint> last;
  std::vector<double> rows;
  RunOptions options = collecting(rows);
  options.stop = &stop;
  options.progress = [&](double fraction) { stop = fraction > 0.63; };
  options.checkpoint_every = 1.0;  // longer than the run: only the stop makes one
  options.checkpoint = [&](const RunCheckpoint& c) { last = c; };
  const RunResult stopped = run(streamed_model(), o, options);
  EXPECT_EQ(stopped.summary.status, "interrupted");
  EXPECT_EQ(stopped.summary.steps, 128);
  EXPECT_EQ(stopped.summary.message, "interrupted at t = 0.256 s of 0.4 s");
  ASSERT_TRUE(last);
  EXPECT_EQ(last->time, 0.256);
  RunOptions rest = collecting(rows);
  rest.resume = &*last;
  const RunResult r = run(streamed_model(), o, rest);
  EXPECT_TRUE(equal_bits(rows, whole.table.data));
  EXPECT_EQ(summary_text_of(r.summary), summary_text_of(whole.summary));
}

INSTANTIATE_TEST_SUITE_P(
    All, RunStream,
    ::testing::Values(StreamKind{Coordinates::relative, InertiaMethod::preprocessing, false},
                      StreamKind{Coordinates::relative, InertiaMethod::projection, false},
                      StreamKind{Coordinates::absolute, InertiaMethod::preprocessing, false},
                      StreamKind{Coordinates::absolute, InertiaMethod::projection, false},
                      StreamKind{Coordinates::relative, InertiaMethod::preprocessing, true},
                      StreamKind{Coordinates::absolute, InertiaMethod::preprocessing, true}));

TEST(RunStream, MemoryDoesNotGrowWithTheLength) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const auto allocations = [](double duration) {
    SimulationDescription o = streamed_model().simulation;
    o.duration = duration;
    std::size_t largest = 0, numbers = 0;
    RunOptions options;
    options.rows = [&](const std::vector<Column>&, std::span<const double> block) {
      largest = std::max(largest, block.size());
      numbers += block.size();
    };
    const AllocationScope scope;
    const RunResult r = run(streamed_model(), o, options);
    const std::size_t count = scope.count();
    EXPECT_EQ(numbers, (static_cast<std::size_t>(r.summary.steps) + 1) * r.table.columns.size());
    EXPECT_LE(largest, 8192u);
    EXPECT_EQ(r.table.data.capacity(), 0u);
    return count;
  };
  // Steps do not allocate, nor does what is between them: many more of them take no more.
  EXPECT_LE(allocations(4.0), allocations(0.4) + 100);
}

TEST(RunStream, WhatCannotBeWrittenEndsTheRun) {
  int calls = 0;
  RunOptions options;
  options.rows = [&](const std::vector<Column>&, std::span<const double>) {
    if (++calls == 2) throw OutputError("the file 'x' cannot be written: No space left on device");
  };
  RunResult r = run(streamed_model(), streamed_model().simulation, options);
  EXPECT_EQ(r.summary.status, "failed");
  EXPECT_EQ(r.summary.message.substr(0, 7), "at t = ");
  EXPECT_TRUE(contains(r.summary.message, " s the file 'x' cannot be written: No space"));
  EXPECT_EQ(calls, 2);

  std::vector<double> rows;
  options = collecting(rows);
  options.checkpoint_every = 0.1;
  options.checkpoint = [](const RunCheckpoint&) { throw OutputError("the file 'c' is too long"); };
  r = run(streamed_model(), streamed_model().simulation, options);
  EXPECT_EQ(r.summary.message, "at t = 0.1 s the file 'c' is too long");
  EXPECT_EQ(r.summary.steps, 50);
  EXPECT_EQ(rows.size(), 51 * r.table.columns.size()) << "the rows before are kept";
}

RunCheckpoint a_checkpoint(const SimulationDescription& o) {
  RunCheckpoint kept;
  RunOptions options;
  options.checkpoint_every = 0.2;
  options.checkpoint = [&](const RunCheckpoint& c) { kept = c; };
  run(streamed_model(), o, options);
  return kept;
}

TEST(RunStream, CheckpointsOfOtherRunsAreRefused) {
  const SimulationDescription o = streamed_model().simulation;
  const RunCheckpoint kept = a_checkpoint(o);
  ASSERT_EQ(kept.time, 0.2);
  const auto refused = [&](const Model& model,
                           const std::function<void(SimulationDescription&, RunOptions&)>& change) {
    SimulationDescription other = o;
    RunOptions options;
    options.resume = &kept;
    change(other, options);
    return error_of([&] { run(model, other, options); });
  };
  EXPECT_EQ(refused(streamed_model(), [](auto&, auto&) {}), "no error");
  EXPECT_EQ(refused(streamed_model(), [](auto& s, auto&) { s.step = 1e-3; }), "mismatch");
  EXPECT_EQ(refused(streamed_model(), [](auto& s, auto&) { s.duration = 0.5; }), "mismatch");
  EXPECT_EQ(refused(streamed_model(), [](auto& s, auto&) { s.tolerance = 1e-8; }), "mismatch");
  EXPECT_EQ(
      refused(streamed_model(), [](auto& s, auto&) { s.coordinates = Coordinates::absolute; }),
      "mismatch");
  EXPECT_EQ(
      refused(streamed_model(), [](auto& s, auto&) { s.inertia = InertiaMethod::projection; }),
      "mismatch");
  EXPECT_EQ(refused(streamed_model(), [](auto&, auto& r) { r.keep_state = true; }), "mismatch");
  Model other = streamed_model();
  other.gravity.z() = -9.82;
  EXPECT_EQ(refused(other, [](auto&, auto&) {}), "mismatch");
}

/// Bytes that end early, go on, or hold what cannot be: refused, or the run ends with a status.
TEST(RunStream, DamagedCheckpoints) {
  SimulationDescription o = streamed_model().simulation;
  o.duration = 0.21;
  o.min_step = 5e-4;
  const RunCheckpoint kept = a_checkpoint(o);
  const auto result = [&](const RunCheckpoint& c) {
    RunOptions options;
    options.resume = &c;
    return error_of([&] { run(streamed_model(), o, options); });
  };
  EXPECT_EQ(result(kept), "no error");
  for (std::size_t n = 0; n < kept.bytes.size(); n += 97) {
    RunCheckpoint part = kept;
    part.bytes.resize(n);
    EXPECT_NE(result(part), "no error") << n;
  }
  RunCheckpoint more = kept;
  more.bytes.resize(kept.bytes.size() + 8);
  EXPECT_EQ(result(more), "damaged");
  int errors = 0, runs = 0;
  for (std::size_t at = 0; at + 8 <= kept.bytes.size(); at += 8 * 13) {
    for (const std::uint64_t word : {0x7ff8000000000000u, 0xffffffffffffffffu, 1ul}) {
      RunCheckpoint forged = kept;
      for (std::size_t k = 0; k < 8; ++k)
        forged.bytes[at + k] = static_cast<std::byte>(word >> (8 * k));
      (result(forged) == "no error" ? runs : errors) += 1;
    }
  }
  EXPECT_GT(errors, 20);
  EXPECT_GT(runs, 20);
}

}  // namespace
}  // namespace floatframe::test

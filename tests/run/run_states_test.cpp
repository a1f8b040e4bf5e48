// States leave a run as its rows do: without them it is the same, and from a checkpoint they go on.
#include <gtest/gtest.h>

#include "floatframe/run/run.hpp"
#include "floatframe/run/state_layout.hpp"
#include "support/allocation_counter.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"

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
    EXPECT_EQ(error_of([&] { run(recorded_model(), other, rest); }), "mismatch");
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

/// Columns of the health of a run and its rows.
struct Health {
  std::vector<HealthColumn> columns;
  std::vector<std::vector<double>> rows;
  double at(std::size_t row, const std::string& name) const {
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == name) return rows[row][k];
    ADD_FAILURE() << name;
    return std::nan("");
  }
  double sum(const std::string& name) const {
    double total = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) total += at(k, name);
    return total;
  }
  double largest(const std::string& name) const {
    double most = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) most = std::max(most, std::abs(at(k, name)));
    return most;
  }
};

RunOptions keeping_health(Health& health) {
  RunOptions options;
  options.rows = [](const std::vector<Column>&, std::span<const double>) {};
  options.states = [&health](const StateLayout& layout, std::span<const double> numbers) {
    health.columns = layout.health;
    const StateLayout::Group* group = layout.find(health_group);
    ASSERT_NE(group, nullptr);
    const auto width = static_cast<std::size_t>(layout.columns);
    for (std::size_t at = 0; at < numbers.size(); at += width) {
      const auto row = numbers.subspan(at + static_cast<std::size_t>(group->first),
                                       static_cast<std::size_t>(group->count));
      health.rows.emplace_back(row.begin(), row.end());
    }
  };
  return options;
}

TEST_P(RunStates, HealthAddsUpToTheSummary) {
  Health h;
  const RunSummary s = run(recorded_model(), options(), keeping_health(h)).summary;
  ASSERT_EQ(h.rows.size(), 35u);
  for (std::size_t k = 0; k < h.columns.size(); ++k) ASSERT_EQ(h.rows[3].size(), h.columns.size());
  EXPECT_EQ(h.sum("steps"), static_cast<double>(s.steps));
  EXPECT_EQ(h.sum("substeps"), static_cast<double>(s.substeps));
  EXPECT_EQ(h.sum("iterations"), static_cast<double>(s.iterations));
  EXPECT_EQ(h.sum("factorizations"), static_cast<double>(s.factorizations));
  EXPECT_EQ(h.at(1, "steps"), 6.0);
  EXPECT_GT(h.largest("position_violation"), 0.0);
  EXPECT_EQ(h.largest("position_violation"), s.max_position_violation);
  EXPECT_EQ(h.largest("velocity_violation"), s.max_velocity_violation);
  const EnergySummary& e = s.energy;
  const std::size_t last = h.rows.size() - 1;
  for (const std::size_t row : {std::size_t{0}, last}) {
    const double potential = h.at(row, "gravity") + h.at(row, "springs") + h.at(row, "tyres");
    const double size = 1e-12 * (1.0 + std::abs(e.total_end));
    EXPECT_NEAR(h.at(row, "kinetic"), row ? e.kinetic_end : e.kinetic_start, size);
    EXPECT_NEAR(potential, row ? e.potential_end : e.potential_start, size);
    EXPECT_NEAR(h.at(row, "elastic"), row ? e.elastic_end : e.elastic_start, size);
  }
  for (std::size_t k = 0; k < EnergyFlows::size(); ++k)
    EXPECT_EQ(h.at(last, std::string("work_of_") + energy_flow_names[k]), e.work.value[k]) << k;
  EXPECT_NEAR(h.at(last, "remainder"), e.remainder, 1e-12 * e.exchanged);
  EXPECT_NEAR(h.at(0, "remainder"), 0.0, 1e-12 * e.exchanged);
}

TEST_P(RunStates, WithoutAWatchThereIsNoHealth) {
  RunOptions o;
  int calls = 0;
  o.rows = [](const std::vector<Column>&, std::span<const double>) {};
  o.states = [&](const StateLayout& layout, std::span<const double>) {
    ++calls;
    EXPECT_TRUE(layout.health.empty());
    EXPECT_EQ(layout.find(health_group), nullptr);
  };
  o.watch = false;
  run(recorded_model(), options(), o);
  EXPECT_GT(calls, 0);
}

TEST_P(RunStates, BodiesDeformByTheirModes) {
  // A cantilever of one mode in a slowly growing load: what its tip does is what its node is
  // displaced by.
  const Model model = model_of(R"(
points: {p: [0, 0, 0], tip: [1, 0, 0]}
bodies:
  beam:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 4, section: {rectangle: [0.02, 0.01]}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [z]}]
      normal_modes: 1
joints: {root: {type: weld, child: beam, at: p}}
forces: {load: {type: force, body: beam, at: tip, direction: z, magnitude: {polynomial: [0, 200]}}}
outputs: {t: {position: {body: beam, node: tip}}}
gravity: [0, 0, 0]
simulation: {step: 1.0e-3, duration: 0.1}
)");
  const SimulationDescription o = with(model.simulation, GetParam());
  Health h;
  const ResultTable table = run(model, o).table;
  run(model, o, keeping_health(h));
  ASSERT_EQ(h.rows.size(), table.rows());
  ASSERT_EQ(h.columns.back().body, "beam");
  EXPECT_NEAR(h.columns.back().size, 1.0, 0.05);
  const std::size_t z = 3;
  double most = 0.0;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    // Modes move the tip along z alone, and no node further.
    EXPECT_NEAR(h.at(k, "beam.displacement"), std::abs(table.at(k, z)), 1e-9) << k;
    EXPECT_LE(h.at(k, "beam.displacement"), 2.0 * h.at(k, "beam.largest_mode") + 1e-15) << k;
    most = std::max(most, std::abs(table.at(k, z)));
  }
  EXPECT_GT(most, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, RunStates, ::testing::ValuesIn(both_coordinates));

}  // namespace
}  // namespace floatframe::test

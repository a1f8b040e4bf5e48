// The bodies of a run at its instants: those of the recorded motion, and the file in memory is that
// on disk.
#include "floatframe/export/run_scene.hpp"

#include <gtest/gtest.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/page/kept_run.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

class RunScenes : public ::testing::Test {
 protected:
  const Model model = model_of(recorded_machine);
  const TemporaryFolder folder;
  const KeptRun kept = run_and_keep(model, model.simulation);
};

TEST_F(RunScenes, StatesInMemoryAreThoseOfTheFile) {
  save_run(model, kept, folder.path().string());
  const StateHistory file((folder.path() / "states.ffr").string());
  const StateHistory memory = StateHistory::of_bytes(states_of_run(model, kept), "memory");
  ASSERT_EQ(memory.instants(), file.instants());
  std::vector<double> a(file.header().columns), b(a.size());
  for (std::size_t k = 0; k < file.instants(); ++k) {
    file.instant(k, a);
    memory.instant(k, b);
    EXPECT_EQ(a, b);
  }
  EXPECT_EQ(memory.status(), "completed");
  EXPECT_EQ(memory.header().model_hash, file.header().model_hash);
}

TEST_F(RunScenes, FindTheNearestInstant) {
  const RunScene scene(model, StateHistory::of_bytes(states_of_run(model, kept), "memory"));
  const auto& times = kept.result.table;
  ASSERT_EQ(scene.instants(), times.rows());
  const double step = model.simulation.step;
  EXPECT_EQ(scene.nearest(-1.0), 0u);
  EXPECT_EQ(scene.nearest(1e9), scene.instants() - 1);
  EXPECT_EQ(scene.nearest(7.3 * step), 7u);
  EXPECT_EQ(scene.nearest(7.7 * step), 8u);
}

TEST_F(RunScenes, BodiesAreWhereTheMotionHasThem) {
  RunScene scene(model, StateHistory::of_bytes(states_of_run(model, kept), "memory"));
  const VtkGrid first = scene.at(0);
  for (const std::size_t k : {std::size_t{40}, std::size_t{0}}) {
    const VtkGrid& grid = scene.at(k);
    EXPECT_EQ(grid.connectivity, first.connectivity);
    EXPECT_NEAR(grid.time, k == 0 ? 0.0 : 0.08, 1e-12);
    const auto& displacement = std::get<std::vector<double>>(grid.point_data[0].values);
    ASSERT_EQ(displacement.size(), grid.points.size());
    // The displacement is that from the design, which does not depend on the instant.
    const auto& from = std::get<std::vector<double>>(first.point_data[0].values);
    for (std::size_t i = 0; i < displacement.size(); ++i)
      EXPECT_NEAR(grid.points[i] - displacement[i], first.points[i] - from[i], 1e-9);
  }
}

TEST_F(RunScenes, RefuseStatesOfAnotherModel) {
  const std::string states = states_of_run(model, kept);
  Model other = model;
  other.gravity.x() += 1.0;
  EXPECT_THROW(RunScene(other, StateHistory::of_bytes(states, "memory")), InputError);
}

}  // namespace
}  // namespace floatframe::test

// The front suspension of the Iltis on its rack against a kinematic solution in closed form
// (tests/data/vehicle/iltis.md), over travel and rack: where the wheel centre is, steer, camber.
#include <gtest/gtest.h>

#include "floatframe/model_file/load_model.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/trajectory_models.hpp"

namespace floatframe::test {
namespace {

TEST(IltisKinematics, OverTravelAndRack) {
  const std::string folder = std::string(FLOATFRAME_TEST_DATA) + "/vehicle/";
  const trajectories::Csv reference = trajectories::read_csv(folder + "iltis_kinematics.csv");
  const Model model = load_model(folder + "iltis_kinematics.yaml");
  const std::pair<const char*, const char*> columns[] = {{"x", "centre.x"},
                                                         {"y", "centre.y"},
                                                         {"z", "centre.z"},
                                                         {"steer", "steer"},
                                                         {"camber", "camber"}};
  for (const Coordinates coordinates : both_coordinates) {
    SimulationDescription s = model.simulation;
    s.coordinates = coordinates;
    const RunResult r = completed_run(model, s);
    ASSERT_EQ(r.table.rows(), reference.rows.size());
    for (const auto& [theirs, ours] : columns) {
      const std::size_t j = reference.column(theirs), k = column(r.table, ours);
      double worst = 0.0;
      for (std::size_t i = 0; i < reference.rows.size(); ++i)
        worst = std::max(worst, std::abs(r.table.at(i, k) - reference.rows[i][j]));
      figure(std::string("kinematics of the Iltis, ") + theirs + ", " + name_of(coordinates),
             worst);
      EXPECT_LT(worst, 1e-11) << theirs;
    }
  }
}

}  // namespace
}  // namespace floatframe::test

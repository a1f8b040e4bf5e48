// The example of an excavator: its cylinders follow lengths by inverse kinematics, so that the
// teeth follow a straight line; what its boom bends leaves them below.
#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/model_file/load_model.hpp"
#include "support/completed_run.hpp"

namespace floatframe::test {
namespace {

struct GradingRun {
  RunResult result;
  /// Least and largest value of an output.
  std::pair<double, double> range(const std::string& name) const {
    const ResultTable& table = result.table;
    std::size_t c = 0;
    while (table.columns[c].name != name) ++c;
    double low = table.at(0, c), high = low;
    for (std::size_t k = 0; k < table.rows(); ++k) {
      low = std::min(low, table.at(k, c));
      high = std::max(high, table.at(k, c));
    }
    return {low, high};
  }
};

GradingRun grading(const std::string& flexible, Coordinates coordinates) {
  const Model model =
      load_model(FLOATFRAME_EXAMPLES "/excavator/excavator.yaml", {{"flexible", flexible}});
  SimulationDescription o = model.simulation;
  o.coordinates = coordinates;
  o.duration = 5.0;
  return {completed_run(model, o)};
}

TEST(Excavator, TeethFollowTheGrade) {
  for (const Coordinates c : both_coordinates) {
    const GradingRun rigid = grading("false", c);
    for (const char* output : {"off_grade", "off_reach"}) {  // [mm]
      EXPECT_GT(rigid.range(output).first, -1e-5);
      EXPECT_LT(rigid.range(output).second, 1e-5);
    }
    const EnergySummary& e = rigid.result.summary.energy;
    EXPECT_LT(std::abs(e.largest_remainder), 1e-4 * e.exchanged);
  }
  const GradingRun flexible = grading("true", Coordinates::relative);
  EXPECT_GT(flexible.range("off_grade").first, -6.0);
  EXPECT_LT(flexible.range("off_grade").second, -0.5);
}

}  // namespace
}  // namespace floatframe::test

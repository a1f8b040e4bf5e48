// The examples whose controllers are formulas: the teeth of an excavator follow a straight line by
// inverse kinematics of its cylinders, a crane damps the sway of its load, a washing machine spins
// up through its resonance.
#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/model_file/load_model.hpp"
#include "support/completed_run.hpp"

namespace floatframe::test {
namespace {

struct MachineRun {
  RunResult result;
  /// Least and largest value of an output between two times.
  std::pair<double, double> range(const std::string& name, double from = 0.0,
                                  double to = 1e9) const {
    const ResultTable& table = result.table;
    std::size_t c = 0;
    while (table.columns[c].name != name) ++c;
    double low = 1e300, high = -1e300;
    for (std::size_t k = 0; k < table.rows(); ++k) {
      if (table.at(k, 0) < from || table.at(k, 0) > to) continue;
      low = std::min(low, table.at(k, c));
      high = std::max(high, table.at(k, c));
    }
    return {low, high};
  }
  /// Half of the range between two times.
  double amplitude(const std::string& name, double from, double to) const {
    const auto [low, high] = range(name, from, to);
    return 0.5 * (high - low);
  }
};

MachineRun machine_run(const std::string& example, Coordinates coordinates,
                       const std::vector<ParameterOverride>& set = {}, double duration = 40.0) {
  const Model model = load_model(FLOATFRAME_EXAMPLES "/" + example + "/" + example + ".yaml", set);
  SimulationDescription o = model.simulation;
  o.coordinates = coordinates;
  o.duration = duration;
  return {completed_run(model, o)};
}

TEST(ExampleMachines, TeethOfTheExcavatorFollowTheGrade) {
  for (const Coordinates c : both_coordinates) {
    const MachineRun rigid = machine_run("excavator", c, {{"flexible", "false"}}, 5.0);
    for (const char* output : {"off_grade", "off_reach"}) {  // [mm]
      EXPECT_GT(rigid.range(output).first, -1e-5);
      EXPECT_LT(rigid.range(output).second, 1e-5);
    }
    const EnergySummary& e = rigid.result.summary.energy;
    EXPECT_LT(std::abs(e.largest_remainder), 1e-4 * e.exchanged);
  }
  const MachineRun flexible =
      machine_run("excavator", Coordinates::relative, {{"flexible", "true"}}, 5.0);
  EXPECT_GT(flexible.range("off_grade").first, -6.0);
  EXPECT_LT(flexible.range("off_grade").second, -0.5);
}

TEST(ExampleMachines, TheCraneDampsTheSwayOfItsLoad) {
  for (const Coordinates c : both_coordinates) {
    const MachineRun damped = machine_run("crane", c),
                     free = machine_run("crane", c, {{"anti_sway", "0"}});
    EXPECT_LT(damped.amplitude("sway", 30.0, 40.0), 1e-3);  // [m]
    EXPECT_GT(free.amplitude("sway", 30.0, 40.0), 0.25);
    EXPECT_NEAR(damped.range("angle", 40.0).first, 1.57 * 180.0 / std::numbers::pi, 0.05);
    EXPECT_LT(damped.range("torque").second, 150.0);
    // The weight on the rope, at rest.
    EXPECT_NEAR(damped.range("rope", 40.0).first, 2.0 * 9.81, 0.1);
  }
}

// Far above its resonance the tub circles about the centre of mass of all, at m e/M; 2 % of that
// are the springs' at 120 rad/s.
TEST(ExampleMachines, TheWashingMachineSpinsUpThroughItsResonance) {
  const double above = 1.5 * 200.0 / (28.0 + 9.0 + 1.5);  // [mm]
  for (const Coordinates c : both_coordinates) {
    const MachineRun machine = machine_run("washing_machine", c);
    EXPECT_NEAR(machine.amplitude("x", 35.0, 40.0), above, 0.03 * above);
    EXPECT_NEAR(machine.amplitude("z", 35.0, 40.0), above, 0.03 * above);
    EXPECT_GT(machine.amplitude("x", 14.0, 18.0), 2.5 * above);
    EXPECT_LT(machine.amplitude("x", 5.0, 12.0), 0.6 * above);
    EXPECT_NEAR(machine.range("speed", 35.0).first, 120.0 * 30.0 / std::numbers::pi, 3.0);
    EXPECT_LT(machine.range("torque").second, 12.0);
  }
}

}  // namespace
}  // namespace floatframe::test

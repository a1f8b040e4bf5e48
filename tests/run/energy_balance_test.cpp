// The energy balance of runs: the work of every kind of force, of motors and of dissipation
// explains the change of energy up to an error that falls with the square of the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "support/figures.hpp"

namespace floatframe::test {
namespace {

struct Balanced {
  const char* file;
  std::vector<ParameterOverride> set;
  std::vector<EnergyFlow> flows;  ///< that do work in this model, and no others
  double step;                    ///< the first one, halved twice
  const char* name;
};

class Balance : public ::testing::TestWithParam<Balanced> {};

TEST_P(Balance, ClosesWithTheSquareOfTheStep) {
  const Balanced& x = GetParam();
  const ModelDescription d = read_model(x.file, x.set);
  const Model model = build_model(d);
  for (const Coordinates coordinates : both_coordinates) {
    SimulationDescription s = with(d.simulation, coordinates);
    double previous = 0.0;
    for (int k = 0; k < 3; ++k) {
      s.step = x.step / std::pow(2.0, k);
      const RunResult r = completed_run(model, s);
      const EnergySummary& e = r.summary.energy;
      ASSERT_TRUE(e.balanced);
      EXPECT_NEAR(e.remainder, e.total_end - e.total_start - e.work.total(), 1e-9 * e.exchanged);
      for (std::size_t f = 0; f < EnergyFlows::size(); ++f) {
        const bool works =
            std::find(x.flows.begin(), x.flows.end(), static_cast<EnergyFlow>(f)) != x.flows.end();
        if (works)
          EXPECT_GT(std::abs(e.work.value[f]), 1e-4 * e.exchanged) << energy_flow_names[f];
        else
          EXPECT_EQ(e.work.value[f], 0.0) << energy_flow_names[f];
      }
      const double part = std::abs(e.largest_remainder) / e.exchanged;
      figure(std::string(x.name) + " remainder", part);
      EXPECT_LT(part, 2e-3);
      if (previous > 0.0 && previous > 1e-10) {
        EXPECT_GT(previous / part, 3.4) << s.step;
        EXPECT_LT(previous / part, 4.6) << s.step;
      }
      previous = part;
    }
  }
}

#define RANGE(name) FLOATFRAME_TEST_DATA "/range/" name ".yaml"

INSTANTIATE_TEST_SUITE_P(
    Models, Balance,
    ::testing::Values(
        Balanced{RANGE("driven_arm"), {}, {EnergyFlow::motions}, 0.004, "driven_arm"},
        Balanced{RANGE("springs"),
                 {},
                 {EnergyFlow::loads, EnergyFlow::actuators, EnergyFlow::dampers},
                 0.004,
                 "springs"},
        Balanced{RANGE("tyre"), {}, {EnergyFlow::tyres}, 0.004, "vertical_tyre"},
        Balanced{RANGE("tyre"), {{"law", "radial"}}, {EnergyFlow::tyres}, 0.004, "radial_tyre"},
        Balanced{RANGE("cantilever"),
                 {{"load", "10"}},
                 {EnergyFlow::loads, EnergyFlow::modal_damping},
                 0.0005,
                 "cantilever"}),
    [](const auto& c) { return std::string(c.param.name); });

// A tyre that drops off a step of the road loses at once what its spring held, and that is work of
// the road, not an error of the step.
TEST(EnergyBalance, RoadsWithSteps) {
  for (const Coordinates coordinates : both_coordinates) {
    ModelDescription stairs =
        read_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml", {{"flexible", "false"},
                                                             {"step", "0.001"},
                                                             {"spectral_radius", "1"},
                                                             {"tolerance", "1e-9"}});
    stairs.simulation.coordinates = coordinates;
    const EnergySummary e = run(build_model(stairs), stairs.simulation).summary.energy;
    figure("stairs remainder", e.largest_remainder / e.exchanged);
    EXPECT_LT(std::abs(e.largest_remainder), 0.02 * e.exchanged);
    EXPECT_LT(e.work[EnergyFlow::dampers], -1000.0);
  }
}

// Below a spectral radius of 1 the remainder is what the integrator takes out of fast vibrations.
TEST(EnergyBalance, NumericalDissipationIsWhatRemains) {
  ModelDescription d = read_model(FLOATFRAME_EXAMPLES "/flexible_pendulum/flexible_pendulum.yaml");
  d.simulation.step = 0.005;
  const Model model = build_model(d);
  const EnergySummary kept = run(model, d.simulation).summary.energy;
  d.simulation.spectral_radius = 0.4;
  const EnergySummary damped = run(model, d.simulation).summary.energy;
  EXPECT_LT(std::abs(kept.remainder), 2e-4 * kept.exchanged);
  EXPECT_LT(damped.remainder, -2e-3 * damped.exchanged);
  figure("dissipated", damped.remainder / damped.exchanged);
}

TEST(EnergyBalance, OutputsRecordedSeldomChangeNothing) {
  for (const char* file : {RANGE("springs"), RANGE("driven_arm")})
    for (const Coordinates coordinates : both_coordinates) {
      ModelDescription d = read_model(file);
      d.simulation.coordinates = coordinates;
      const Model model = build_model(d);
      const EnergySummary all = run(model, d.simulation).summary.energy;
      d.simulation.output_interval = 50 * d.simulation.step;
      const EnergySummary few = run(model, d.simulation).summary.energy;
      EXPECT_NEAR(few.remainder, all.remainder, 1e-9 * all.exchanged);
      for (std::size_t f = 0; f < EnergyFlows::size(); ++f)
        EXPECT_NEAR(few.work.value[f], all.work.value[f], 1e-9 * all.exchanged);
    }
}

}  // namespace
}  // namespace floatframe::test

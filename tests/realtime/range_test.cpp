// Paced runs out of the range of the method: the same sentences as plain runs have, and the same
// results as without looking.
#include <gtest/gtest.h>

#include "floatframe/run/run.hpp"
#include "realtime/recorder.hpp"
#include "support/contains.hpp"
#include "support/coordinates.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

ModelDescription described(const char* name, Coordinates coordinates, double step = 0.0) {
  ModelDescription d = read_model(std::string(FLOATFRAME_TEST_DATA "/range/") + name + ".yaml");
  d.simulation.coordinates = coordinates;
  if (step > 0.0) d.simulation.step = step;
  return d;
}

std::vector<RangeWarning> paced_warnings(const ModelDescription& d, SignalPort* port) {
  const RealTimeReport r = run_real_time(build_model(d), d.simulation, unpaced(), port);
  EXPECT_EQ(r.status, "completed") << r.message;
  return r.warnings;
}

/// Those of a plain run but for the energy balance.
std::vector<RangeWarning> plain_warnings(const ModelDescription& d) {
  std::vector<RangeWarning> out;
  for (const RangeWarning& w : run(build_model(d), d.simulation).summary.warnings)
    if (w.limit != RangeLimit::balance) out.push_back(w);
  return out;
}

TEST(RealTimeRange, SentencesOfAPlainRun) {
  for (const auto coordinates : both_coordinates)
    for (const auto& [name, step, count] :
         {std::tuple{"cantilever", 0.0, 2u}, {"spinning_beam", 0.0, 1u}, {"pendulum", 0.5, 1u}}) {
      const ModelDescription d = described(name, coordinates, step);
      const std::vector<RangeWarning> expected = plain_warnings(d);
      EXPECT_GE(expected.size(), count) << name;
      Recorder port;
      EXPECT_EQ(paced_warnings(d, &port), expected) << name;
    }
}

TEST(RealTimeRange, WithoutOutputs) {
  // Nothing of the end of a step is known where nobody takes outputs and nothing is constrained:
  // some steps are looked at.
  for (const auto coordinates : both_coordinates)
    for (const auto& [name, step] : {std::pair{"cantilever", 0.0}, {"pendulum", 0.5}}) {
      ModelDescription d = described(name, coordinates, step);
      d.simulation.duration *= 10.0;
      std::vector<RangeLimit> kinds[2];
      for (const RangeWarning& w : plain_warnings(d)) kinds[0].push_back(w.limit);
      for (const RangeWarning& w : paced_warnings(d, nullptr)) kinds[1].push_back(w.limit);
      EXPECT_EQ(kinds[1], kinds[0]) << name;
    }
}

TEST(RealTimeRange, SinesThatTheStepDoesNotResolve) {
  const TemporaryFolder folder;
  const ModelDescription d = read_model(folder.write(
      "model.yaml",
      "floatframe: 1\ngravity: [0, 0, 0]\n"
      "bodies: {p: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 2, 3]}}}\n"
      "joints: {j: {type: prismatic, child: p, at: [0, 0, 0], axis: x}}\n"
      "forces: {s: {type: force, body: p, direction: x,"
      " magnitude: {sine: {amplitude: 1000, frequency: 1000}}}}\n"
      "simulation: {step: 0.001, duration: 0.1}\n"));
  const std::vector<RangeWarning> warnings = paced_warnings(d, nullptr);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].limit, RangeLimit::sine);
  EXPECT_TRUE(contains(warnings[0].sentence, "its sine of 1000 Hz"));
}

TEST(RealTimeRange, LookingChangesNoResult) {
  for (const auto coordinates : both_coordinates)
    for (const bool outputs : {false, true}) {
      const ModelDescription d = described("cantilever", coordinates);
      Recorder ports[2];
      RealTimeReport reports[2];
      for (const int watched : {0, 1}) {
        RealTimeOptions options = unpaced();
        options.watch = watched == 1;
        reports[watched] = run_real_time(build_model(d), d.simulation, options,
                                         outputs ? &ports[watched] : nullptr);
      }
      EXPECT_EQ(reports[0].warnings.size(), 0u);
      EXPECT_EQ(reports[1].warnings.size(), 2u);
      EXPECT_EQ(reports[0].outputs, reports[1].outputs);
      EXPECT_EQ(reports[0].iterations, reports[1].iterations);
      EXPECT_EQ(ports[0].rows, ports[1].rows);
    }
}

}  // namespace
}  // namespace floatframe::test

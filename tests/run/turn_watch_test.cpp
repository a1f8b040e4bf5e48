// Rotations that force elements measure: a bushing that turns past half a turn says so, one that
// stays below or only damps the angular velocity does not; joint springs count turns unless a step
// goes through half of one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A disc on a hinge or ball that turns at 4 rad/s, and an element about its axis.
ModelDescription turning_disc(const std::string& force, const std::string& velocity = "4") {
  return test::description_of(
      "gravity: [0, 0, 0]\npoints: {o: [0, 0, 0]}\n"
      "bodies: {m: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}}\n"
      "joints: {r: {type: revolute, child: m, at: o, axis: z, velocity: " +
      velocity + "}}\nforces: {b: " + force +
      "}\noutputs: {q: {joint_position: r}, w: {joint_velocity: r}}\n"
      "simulation: {step: 0.001, duration: 3}\n");
}
const std::string ends = "{type: bushing, from: {body: ground, at: o}, to: {body: m, at: o}, ";

RunSummary run_of(const ModelDescription& d, Coordinates coordinates) {
  const SimulationDescription s = with(d.simulation, coordinates);
  return run(build_model(d), s).summary;
}

TEST(HalfTurn, OfABushingIsReportedWithItsInstant) {
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = run_of(read_model(FLOATFRAME_TEST_DATA "/range/bushing_turns.yaml"), c);
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_EQ(s.warnings[0].limit, RangeLimit::half_turn);
    // 4 sin(t) = pi: at 0.9033 s, and the step after it.
    EXPECT_EQ(s.warnings[0].sentence.substr(0, 57),
              "bushing 'b' has turned past half a turn at t = 0.904 s: t");
    EXPECT_NEAR(std::asin(std::numbers::pi / 4.0), 0.9033, 1e-4);
  }
}

// 3 rad/s reach 3 rad at most.
TEST(HalfTurn, IsNotReached) {
  for (const Coordinates c : both_coordinates)
    EXPECT_TRUE(run_of(turning_disc(ends + "spring_rz: 1}", "3.1"), c).warnings.empty());
}

TEST(HalfTurn, OfOtherLawsMeansNothing) {
  for (const char* laws :
       {"spring_x: 100, damper_y: 3}", "damper_rz: 0.1, rotation_rate: angular_velocity}",
        "spring_z: 5, damper_rx: 0.1, damper_rz: 0.1, rotation_rate: "
        "angular_velocity}"})
    EXPECT_TRUE(run_of(turning_disc(ends + laws), Coordinates::relative).warnings.empty()) << laws;
  // Rates of the rotation vector have the limit, and so do springs beside viscous dampers.
  for (const char* laws :
       {"damper_rz: 0.1}", "spring_rz: 0.01, damper_rz: 0.1, rotation_rate: angular_velocity}"}) {
    const RunSummary s = run_of(turning_disc(ends + laws), Coordinates::absolute);
    ASSERT_EQ(s.warnings.size(), 1u) << laws;
    EXPECT_EQ(s.warnings[0].limit, RangeLimit::half_turn);
  }
}

// About any axis, both bodies moving.
TEST(HalfTurn, BetweenTwoBodiesThatMove) {
  const ModelDescription d = test::description_of(R"(
gravity: [0, 0, 0]
points: {o: [0, 0, 0]}
bodies:
  a: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}
  b: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}
joints:
  a: {type: spherical, child: a, at: o, velocity: [2, 1, 0]}
  b: {type: spherical, child: b, at: o, velocity: [-2, -1, 3]}
forces:
  mount: {type: bushing, from: {body: a, at: o}, to: {body: b, at: o},
          spring_rx: 0.01, spring_ry: 0.01, spring_rz: 0.01}
simulation: {step: 0.001, duration: 1}
)");
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = run_of(d, c);
    ASSERT_EQ(s.warnings.size(), 1u);
    // R_a^T R_b of both turns is half a turn at 0.602 s; the springs hardly slow it.
    const std::string& said = s.warnings[0].sentence;
    EXPECT_NEAR(std::stod(said.substr(said.find("at t = ") + 7)), 0.602, 0.002) << said;
  }
}

TEST(HalfTurn, OfAJointSpringCountsInOneStepOnly) {
  ModelDescription d = turning_disc("{type: joint_spring, joint: r, spring: 1}");
  EXPECT_TRUE(run_of(d, Coordinates::relative).warnings.empty());
  d = turning_disc("{type: joint_spring, joint: r, spring: 1e-3}", "400");
  d.simulation.step = 0.01;
  d.simulation.duration = 0.2;
  for (const Coordinates c : both_coordinates) {
    bool said = false;
    for (const RangeWarning& w : run_of(d, c).warnings)
      if (w.limit == RangeLimit::half_turn) {
        said = true;
        EXPECT_EQ(w.sentence.substr(0, 85),
                  "joint_spring 'b' turns by more than half a turn in one step of 0.01 s at t = "
                  "0.01 s (");
      }
    EXPECT_TRUE(said);
  }
}

}  // namespace
}  // namespace floatframe::test

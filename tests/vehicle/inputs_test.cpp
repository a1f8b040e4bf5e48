// Inputs of a vehicle that do nothing, or the opposite, are found at the start; brakes that help
// the drive, and a stop in a straight line against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/vehicle/input_probe.hpp"
#include "floatframe/vehicle/manoeuvre_report.hpp"
#include "floatframe/vehicle/manoeuvres.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

ModelDescription input_model(const std::vector<ParameterOverride>& values = {}) {
  return load_description(std::string(FLOATFRAME_TEST_DATA) + "/vehicle/single_track.yaml", values);
}

VehicleSetup input_setup(ModelDescription d, double speed) {
  return vehicle_setup(std::move(d), "step-steer", {.steering = true, .drive = true}, speed);
}

/// What the start says of the inputs after a change of the roles.
std::string probe_says(const std::function<void(ModelDescription&)>& change) {
  ModelDescription d = input_model();
  change(d);
  VehicleRun run(input_setup(std::move(d), 20.0));
  return sentences_of([&] { require_inputs_that_act(run); });
}

TEST(InputProbe, NamesInputsThatDoNothing) {
  EXPECT_EQ(probe_says([](ModelDescription&) {}), "no error");
  EXPECT_TRUE(contains(probe_says([](auto& d) { d.vehicle->steering->input = "drive"; }),
                       "vehicle.steering: found an input 'drive' that turns no wheel"));
  const std::string drive = probe_says([](auto& d) { d.vehicle->drive->input = "steer"; });
  EXPECT_TRUE(contains(drive, "vehicle.drive: found an input 'steer' that moves nothing")) << drive;
  // The reference has wheels of the radius 0.3 m and forces as tyres.
  EXPECT_TRUE(contains(drive, "of the type force), or a force on the chassis with the ratio 3.333"))
      << drive;
}

TEST(InputProbe, NamesInputsOfTheWrongSign) {
  EXPECT_TRUE(contains(probe_says([](auto& d) { d.vehicle->steering->ratio = -16.0; }),
                       "'steer' that steers to the right, expected the other sign of its ratio"));
  EXPECT_TRUE(contains(probe_says([](auto& d) { d.vehicle->drive->ratio = -1.0; }),
                       "'drive' that drives backwards"));
}

TEST(InputProbe, LeavesTheRunAsItWas) {
  VehicleRun probed(input_setup(input_model(), 20.0)), other(input_setup(input_model(), 20.0));
  require_inputs_that_act(probed);
  for (VehicleRun* run : {&probed, &other})
    for (int k = 0; k < 20; ++k) run->step(0.01, 300.0);
  EXPECT_EQ(probed.now().view.yaw_rate, other.now().view.yaw_rate);
  EXPECT_EQ(probed.now().view.speed, other.now().view.speed);
}

TEST(TrimmedStart, HasTheSpeedAskedForOrSaysWhyNot) {
  VehicleRun held(input_setup(input_model({{"hold", "1e5"}}), 10.0));
  try {
    step_steer(held, {.speed = 10.0});
    ADD_FAILURE();
  } catch (const RunError& e) {
    EXPECT_EQ(e.code(), ErrorCode::not_steady);
    EXPECT_TRUE(contains(e.what(), "expected 10 m/s: the force of its drive is at its limit"));
  }
}

/// The single-track model with a brake: a force [N] against the motion on the chassis.
ModelDescription braked_model() {
  ModelDescription d = input_model();
  InputDescription brake;
  brake.name = "brake";
  brake.low = 0.0;
  brake.high = 1e4;
  d.inputs.push_back(brake);
  ElementDescription force = *std::ranges::find(d.forces, "drive", &ElementDescription::name);
  force.name = "brake";
  auto& push = std::get<AppliedForce>(force.kind);
  push.magnitude = SignalDescription{};
  push.magnitude.input = "brake";
  push.direction = -Vec3::UnitX();
  d.forces.push_back(force);
  d.vehicle->brake = VehicleInput{.input = "brake", .ratio = 1.0 / 0.3, .origin = {}};
  return d;
}

// m v' = -F with F = m a h(t/T), h = 10 s^3 - 15 s^4 + 6 s^5: h integrated once over the rise gives
// T/2, twice T^2/7. So after the rise
//   v = v_0 - a (t - T/2),   s = v_0 t - a ((t - T/2)^2/2 + T^2/7 - T^2/8)
// and the vehicle stands at t = v_0/a + T/2.
TEST(StraightStop, IsThatOfAConstantForce) {
  VehicleNeeds needs{.steering = true, .drive = true, .brake = true};
  VehicleRun run(vehicle_setup(braked_model(), "straight-stop", needs, 20.0));
  EXPECT_NEAR(run.highest_braking(), 1e4, 1e-9);
  EXPECT_NEAR(run.lowest_force(), -2e4, 1e-9);
  const double a = 9000.0 / 1500.0, T = 0.2, v = 20.0;
  const StraightStopResult r = straight_stop(run, {.speed = v, .torque = 2700.0, .rise = T});
  EXPECT_NEAR(r.speed, v, 1e-3);
  EXPECT_EQ(r.torque, 2700.0);
  EXPECT_NEAR(r.duration, v / a + 0.5 * T, 5e-3);
  EXPECT_NEAR(r.distance, v * (v / a + 0.5 * T) - a * (0.5 * v * v / (a * a) + T * T / 56.0), 3e-2);
  EXPECT_NEAR(r.deceleration, a, 1e-3 * a);
  EXPECT_LT(r.offset, 1e-6);
  EXPECT_TRUE(contains(manoeuvre_report("car", r).text, "UN R13-H"));
}

// Below the lower limit of the drive the brake does the rest: the force is that of both.
TEST(StraightStop, BrakesHelpTheDrive) {
  VehicleRun run(input_setup(braked_model(), 20.0));
  for (int k = 0; k < 100; ++k) run.step(0.0, -15000.0);
  EXPECT_NEAR(run.now().view.speed, 20.0 - 10.0 * 0.1, 2e-2);
}

}  // namespace
}  // namespace floatframe::test

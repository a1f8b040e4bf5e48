// What has a role in the section `vehicle` must be able to play it; roads of manoeuvres are flat.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/vehicle/flat_road.hpp"
#include "floatframe/vehicle/vehicle_setup.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

const char* const roles_axle = R"(
bodies:
  chassis: {position: [0, 0, 0.3], rigid: {mass: 500, inertia: [100, 100, 100]}}
  left_hub: {position: [0, 0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
  left_rim: {position: [0, 0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
  right_hub: {position: [0, -0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
  right_rim: {position: [0, -0.7, 0.3], rigid: {mass: 20, inertia: [1, 1, 1]}}
joints:
  left_arm: {type: revolute, parent: chassis, child: left_hub, at: [0, 0.2, 0.3], axis: x}
  left_spin: {type: revolute, parent: left_hub, child: left_rim, at: [0, 0.7, 0.3], axis: y}
  right_arm: {type: revolute, parent: chassis, child: right_hub, at: [0, -0.2, 0.3], axis: x}
  right_spin: {type: revolute, parent: right_hub, child: right_rim, at: [0, -0.7, 0.3], axis: y}
roads:
  road: {profile: [[0, 0]]}
forces:
  spring: {type: spring_damper, from: {body: chassis, at: [0, 0.5, 0.8]},
    to: {body: left_hub, at: [0, 0.5, 0.3]}, spring: 20000}
  left_tyre: {type: linear_tyre, body: left_rim, road: road, radius: 0.3, stiffness: 2e5,
    slip_stiffness: 5e4, cornering_stiffness: 5e4, friction: 1, relaxation_x: 0.2,
    relaxation_y: 0.4}
  right_tyre: {type: linear_tyre, body: right_rim, road: road, radius: 0.3, stiffness: 2e5,
    slip_stiffness: 5e4, cornering_stiffness: 5e4, friction: 1, relaxation_x: 0.2,
    relaxation_y: 0.4}
vehicle:
  chassis: chassis
  axles:
    only:
      left: {wheel: left_rim, tyre: left_tyre, spin: left_spin}
      right: {wheel: right_rim, tyre: right_tyre, spin: right_spin}
)";

/// With the last place of `from` in the text replaced.
std::string roles_text(const std::string& from, const std::string& to) {
  std::string text = roles_axle;
  const auto at = text.rfind(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string roles_say(const std::string& from, const std::string& to) {
  return sentences_of([&] { build_model(description_of(roles_text(from, to))); });
}

TEST(VehicleRoles, AreThoseOfTheirKinds) {
  EXPECT_EQ(roles_say("wheel: left_rim", "wheel: left_rim"), "no error");
  // The carrier may stand for the wheel that turns on it.
  EXPECT_EQ(roles_say("wheel: left_rim", "wheel: left_hub"), "no error");
  EXPECT_TRUE(contains(roles_say("tyre: left_tyre", "tyre: spring"),
                       "vehicle.axles.only.left.tyre: found the spring_damper 'spring', expected a "
                       "tyre on a road"));
  EXPECT_TRUE(contains(roles_say("wheel: left_rim", "wheel: chassis"),
                       "vehicle.axles.only.left.tyre: found the linear_tyre 'left_tyre' on the "
                       "body 'left_rim', expected one on the wheel 'chassis'"));
  EXPECT_TRUE(contains(roles_say("spin: left_spin", "spin: left_arm"),
                       "vehicle.axles.only.left.spin: found the joint 'left_arm' between "
                       "'chassis' and 'left_hub', expected the one about which 'left_rim' turns"));
}

TEST(VehicleRoles, PointTheWayOfTheVehicle) {
  EXPECT_TRUE(contains(
      roles_say("left: {wheel: left_rim, tyre: left_tyre, spin: left_spin}\n      right: {wheel:",
                "right: {wheel: left_rim, tyre: left_tyre, spin: left_spin}\n      left: {wheel:"),
      "vehicle.axles.only.left: found the wheel 'right_rim' at y = -0.7 m, to the right of "
      "'left_rim' at y = 0.7 m"));
  EXPECT_TRUE(contains(roles_say("body: right_rim,", "body: right_rim, axis: -y,"),
                       "vehicle.axles.only.right.tyre: found the linear_tyre 'right_tyre' with an "
                       "axis to the right"));
  EXPECT_TRUE(contains(roles_say("at: [0, -0.7, 0.3], axis: y", "at: [0, -0.7, 0.3], axis: x"),
                       "vehicle.axles.only.right.spin: found the joint 'right_spin' with an axis "
                       "90 deg off that of the tyre"));
  // A spin joint that points to the right turns the other way round, which the start knows.
  EXPECT_EQ(roles_say("at: [0, -0.7, 0.3], axis: y", "at: [0, -0.7, 0.3], axis: -y"), "no error");
}

/// What a manoeuvre says of a road.
std::string road_says(const std::string& road, bool patches = false) {
  const ModelDescription d =
      description_of(roles_text("road: {profile: [[0, 0]]}", "road: " + road));
  return sentences_of([&] { require_flat_roads(d, "step-steer", patches); });
}

TEST(FlatRoad, IsAskedForItsHeights) {
  EXPECT_EQ(road_says("{profile: [[0, 0]]}"), "no error");
  EXPECT_EQ(road_says("{height: 0 * x}"), "no error");
  EXPECT_EQ(road_says("{friction: 0.3}"), "no error");
  for (const char* road : {"{profile: [[0, 0], [10, 0], [11, 0.1]]}", "{height: 0.01 * sin(y)}",
                           "{tracks: {class: B, length: 300, width: 1.43, seed: 3, start: 5}}",
                           "{bumps: [{start: 20.2, length: 0.5, height: 0.02}]}"})
    EXPECT_TRUE(contains(road_says(road), "roads.road: found heights between")) << road;
  const char* const ice = "{patches: [{x: [10, 100], y: [-5, 0], friction: 0.2}]}";
  EXPECT_TRUE(contains(road_says(ice), "roads.road: found patches of friction"));
  EXPECT_EQ(road_says(ice, true), "no error");
}

}  // namespace
}  // namespace floatframe::test

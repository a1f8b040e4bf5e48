// Prescribed coordinates of joints that have several: in the tree, reversed and cut, in both
// formulations; the force of the motion makes the same motion as an actuator; driven lengths of
// rods.
#include <gtest/gtest.h>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

enum class DrivePlace { tree, reversed, cut };

using DriveParameters = std::tuple<std::pair<JointType, int>, DrivePlace, Coordinates>;

class DrivenCoordinate : public ::testing::TestWithParam<DriveParameters> {};

TimeFunction driven_by() {
  TimeFunction f;
  f.pieces = PiecewisePolynomial::polynomial({0.2, 0.8});
  f.sines = {{.amplitude = 0.3, .frequency = 2.0, .phase = 0.7}};
  return f;
}

TEST_P(DrivenCoordinate, FollowsTheFunction) {
  const auto [driven, place, coordinates] = GetParam();
  const auto [type, component] = driven;
  RandomSystem s(31);
  s.add_body("base", 0);
  s.add_body("arm", 2);
  s.add_body("tail", 0);
  const bool reversed = place == DrivePlace::reversed;
  s.add_joint("hang", JointType::spherical, ground_name, 0, "base", 0);
  JointDescription& drive =
      s.add_joint("drive", type, reversed ? "arm" : "base", 1, reversed ? "base" : "arm", 2);
  drive.motions = {{component, driven_by()}};
  drive.cut = place == DrivePlace::cut;
  s.add_joint("ball", JointType::spherical, "arm", 3, "tail", 0);
  s.d.outputs = {make_output("q", OutputType::joint_position, "drive"),
                 make_output("v", OutputType::joint_velocity, "drive")};
  for (OutputDescription& out : s.d.outputs) out.component = component;
  SimulationDescription& o = s.d.simulation;
  o.coordinates = coordinates;
  o.step = 1e-3;
  o.duration = 0.2;
  o.tolerance = 1e-12;
  o.position_tolerance = 1e-13;
  const RunResult r = completed_run(s.d);
  const TimeFunction f = driven_by();
  double worst = 0.0;
  for (std::size_t k = 0; k < r.table.rows(); ++k) {
    const PiecewisePolynomial::Value v = evaluate(f, r.table.at(k, 0));
    worst = std::max(worst, std::abs(r.table.at(k, 1) - v.f));
    ASSERT_NEAR(r.table.at(k, 2), v.df, 1e-7) << "t = " << r.table.at(k, 0);
  }
  EXPECT_LT(worst, 1e-12);
}

std::vector<std::pair<JointType, int>> drivable() {
  std::vector<std::pair<JointType, int>> all;
  for (const JointType type : joint_types)
    for (int k = 0; k < joint_velocities(type); ++k)
      if (joint_velocities(type) > 1 && !is_of_rotation_vector(type, k)) all.push_back({type, k});
  return all;
}

std::string drive_name(const ::testing::TestParamInfo<DriveParameters>& c) {
  const char* places[] = {"tree", "reversed", "cut"};
  const auto [type, component] = std::get<0>(c.param);
  return std::string(joint_type_name(type)) + std::to_string(component + 1) + "_" +
         places[static_cast<int>(std::get<1>(c.param))] + "_" + name_of(std::get<2>(c.param));
}

INSTANTIATE_TEST_SUITE_P(
    EveryCoordinate, DrivenCoordinate,
    ::testing::Combine(::testing::ValuesIn(drivable()),
                       ::testing::Values(DrivePlace::tree, DrivePlace::reversed, DrivePlace::cut),
                       ::testing::ValuesIn(both_coordinates)),
    drive_name);

/// Both coordinates of a screw-like drive, all three of a plate, one body each.
const std::string machine = R"(
bodies:
  drill: {rigid: {mass: 3, centre_of_mass: [0.1, 0, 1], inertia: [0.2, 0.3, 0.4]}}
  plate: {rigid: {mass: 2, centre_of_mass: [2, 0.1, 0], inertia: [0.2, 0.1, 0.3]}}
joints:
  spindle:
    type: cylindrical
    child: drill
    at: [0, 0, 1]
    axis: z
    motion: {displacement: {formula: '0.1 * sin(3 * t)'}, angle: {velocity: 20}}
  table:
    type: planar
    child: plate
    at: [2, 0, 0]
    axis: z
    axis_2: x
    motion:
      first displacement: {sine: {amplitude: 0.1, frequency: 2}}
      angle: {polynomial: [0, 3]}
outputs:
  lift: {motion_force: spindle, coordinate: 1}
  torque: {motion_force: spindle, coordinate: 2}
  power: {motion_power: spindle, coordinate: 1}
  push: {motion_force: table, coordinate: 1}
  slide: {joint_position: table, coordinate: 2}
  turn: {joint_position: spindle, coordinate: 2}
simulation: {step: 0.001, duration: 1}
)";

TEST(CoordinateMotions, TakeTheForcesOfTheirMotion) {
  const Model model = model_of(machine);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t k = 0; k < r.table.rows(); k += 50) {
      const double t = r.table.at(k, 0);
      // m (zdd + g); a constant rate of turning needs no torque.
      const double lift = 3.0 * (9.81 - 0.9 * std::sin(3.0 * t));
      EXPECT_NEAR(r.table.at(k, 1), lift, 1e-6);
      EXPECT_NEAR(r.table.at(k, 2), 0.0, 1e-6);
      EXPECT_NEAR(r.table.at(k, 3), lift * 0.3 * std::cos(3.0 * t), 1e-6);
      EXPECT_NEAR(r.table.at(k, 6), 20.0 * t, 1e-9);  // more than three turns
    }
  }
}

// A driven universal joint, and the same joint with torques that the motion took, as the actuators
// of two hinges of a massless cross.
TEST(CoordinateMotions, AreThoseOfTheirTorques) {
  const std::string body = R"(
  wheel: {rigid: {mass: 3, centre_of_mass: [0.1, 0.2, 0.1], inertia: [0.2, 0.3, 0.4]}}
)";
  const Model driven = model_of("bodies:" + body + R"(
joints:
  cross:
    type: universal
    child: wheel
    at: [0, 0, 0]
    axis: z
    axis_2: [1, 0, 0.2]
    motion:
      angle about axis: {polynomial: [0, 0, 1]}
      angle about axis_2: {sine: {amplitude: 0.4, frequency: 1}}
outputs:
  a: {motion_force: cross, coordinate: 1}
  b: {motion_force: cross, coordinate: 2}
  x: {position: {body: wheel, at: [0.1, 0.2, 0.1]}}
simulation: {step: 0.001, duration: 1}
)");
  const Model hinges = model_of("bodies:" + body + R"(
  link: {rigid: {mass: 0, centre_of_mass: [0, 0, 0]}}
joints:
  first: {type: revolute, child: link, at: [0, 0, 0], axis: z, motion: {polynomial: [0, 0, 1]}}
  second:
    type: revolute
    parent: link
    child: wheel
    at: [0, 0, 0]
    axis: [1, 0, 0.2]
    motion: {sine: {amplitude: 0.4, frequency: 1}}
outputs:
  a: {motion_force: first}
  b: {motion_force: second}
  x: {position: {body: wheel, at: [0.1, 0.2, 0.1]}}
simulation: {step: 0.001, duration: 1}
)");
  for (const Coordinates c : both_coordinates) {
    const RunResult a = completed_run(driven, with(driven.simulation, c));
    const RunResult b = completed_run(hinges, with(hinges.simulation, c));
    for (std::size_t k = 0; k < a.table.rows(); k += 20)
      for (std::size_t column = 1; column < 6; ++column)
        ASSERT_NEAR(a.table.at(k, column), b.table.at(k, column), 1e-6) << k << " " << column;
  }
}

/// An arm on a hinge, held by a rod whose length is driven; or by a stiff cylinder.
std::string arm(const std::string& held, const std::string& outputs) {
  return R"(
points: {pin: [0, 0, 0], eye: [0.5, 0, 0.1], foot: [0.2, 0, -0.6]}
bodies: {arm: {rigid: {mass: 20, centre_of_mass: [0.6, 0, 0], inertia: [0.1, 4, 4]}}}
joints: {hinge: {type: revolute, child: arm, at: pin, axis: y}}
parameters: {drawn: '${sqrt(0.3^2 + 0.7^2)}'}
)" + held +
         "outputs:\n  distance: {distance: {from: {body: ground, at: foot}, to: {body: arm, at: "
         "eye}}}\n" +
         outputs + "simulation: {step: 0.001, duration: 1}\n";
}

TEST(DrivenRods, HaveTheLengthOfTheirMotion) {
  const Model model = model_of(arm(
      "rods: {lift: {from: {body: ground, at: foot}, to: {body: arm, at: eye}, motion: {formula: "
      "'drawn + 0.1 * sin(4 * t)^2'}}}\n",
      "  force: {rod_force: lift}\n  angle: {joint_position: hinge}\n  about: {joint_torque: "
      "hinge, "
      "axis: y}\n"));
  for (const Coordinates c : both_coordinates) {
    SimulationDescription o = with(model.simulation, c);
    o.position_tolerance = 1e-13;
    o.tolerance = 1e-12;
    const RunResult r = completed_run(model, o);
    const double drawn = std::sqrt(0.58);
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double wave = std::sin(4.0 * r.table.at(k, 0));
      ASSERT_NEAR(r.table.at(k, 1), drawn + 0.1 * wave * wave, 1e-12);
    }
    // At rest at the start but for its acceleration 2 * 0.1 * 16 of the length: the moment of the
    // weight and of the inertia J = 4 + 20 0.6^2 about the pin, with the arm h of the force.
    const double h = (0.5 * 0.7 - 0.1 * 0.3) / drawn;  // |eye x n|
    const double moment = 20.0 * 9.81 * 0.6 + (4.0 + 20.0 * 0.36) * 3.2 / h;
    EXPECT_NEAR(r.table.at(0, 2), -moment / h, 1e-6);
  }
}

TEST(Cylinders, PullToTheirTarget) {
  const std::string cylinder =
      "forces: {lift: {type: spring_damper, from: {body: ground, at: foot}, to: {body: arm, at: "
      "eye}, spring: 2e7, damper: 4e5, target: {formula: 'drawn + 0.1 * sin(4 * t)^2'}, "
      "target_rate: {formula: '0.4 * sin(8 * t)'}}}\n";
  const Model model = model_of(arm(cylinder, "  force: {force: lift}\n"));
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t k = 100; k < r.table.rows(); ++k) {
      const double t = r.table.at(k, 0), wave = std::sin(4.0 * t);
      const double target = std::sqrt(0.58) + 0.1 * wave * wave;
      // k (length - target) is the force, as far as the damper is at rest relative to the target.
      ASSERT_NEAR(r.table.at(k, 1), target, 2e-4);
      if (std::abs(std::sin(8.0 * t)) < 0.01) {
        EXPECT_NEAR(2e7 * (r.table.at(k, 1) - target), r.table.at(k, 2), 40.0);
      }
    }
  }
}

TEST(CoordinateMotions, WhatCannotBeDrivenIsOneError) {
  const auto error = [](const std::string& joint, const std::string& rest = "") {
    return without_folders(error_of([&] {
      model_of(
          "bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n"
          "joints: {j: {child: b, at: [0, 0, 0], " +
          joint + "}}\n" + rest);
    }));
  };
  EXPECT_EQ(error("type: spherical, motion: {rotation vector x: 1}"),
            "model.yaml:3:84: joints.j.motion.rotation vector x: unsupported");
  EXPECT_EQ(error("type: free, motion: {displacement x: 1, rotation vector z: 1}"),
            "model.yaml:3:98: joints.j.motion.rotation vector z: unsupported");
  EXPECT_EQ(error("type: cylindrical, axis: z, motion: 3"),
            "model.yaml:3:75: joints.j.motion: wrong_value");
  EXPECT_EQ(error("type: cylindrical, axis: z, motion: {angles: 3}"),
            "model.yaml:3:76: joints.j.motion.angles: unknown_key");
  EXPECT_EQ(error("type: planar, axis: z, axis_2: x, motion: {angle: 3, second displacement: 1}",
                  "outputs: {f: {motion_force: j}}\n"),
            "model.yaml:4:11: outputs.f: missing");
  const Model free = model_of(
      "bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n"
      "joints: {j: {type: free, child: b, motion: {displacement z: {polynomial: [0, 2]}}}}\n"
      "outputs: {z: {position: b, axis: z}, f: {motion_force: j}}\n");
  const RunResult r = completed_run(free);
  EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 2.0, 1e-9);
  EXPECT_NEAR(r.table.at(r.table.rows() - 1, 2), 9.81, 1e-9);
}

}  // namespace
}  // namespace floatframe::test

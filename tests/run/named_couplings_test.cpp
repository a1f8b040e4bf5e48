// Gears, planetary gears, differentials, racks, screws, belts and mimics by name: the factors of
// their sums, and speeds and torques against closed forms, in both formulations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double pi = std::numbers::pi;

/// Wheels a, b on z and c on -z, a slide and a nut.
const std::string workshop = R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.3, 0, 0], rigid: {mass: 1, inertia: [0.03, 0.03, 0.05]}}
  three: {position: [0.6, 0, 0], rigid: {mass: 1, inertia: [0.04, 0.04, 0.07]}}
  box: {position: [0, 1, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
  nut: {position: [1, 1, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  a: {type: revolute, child: one, at: [0, 0, 0], axis: z}
  b: {type: revolute, child: two, at: [0.3, 0, 0], axis: z}
  c: {type: revolute, child: three, at: [0.6, 0, 0], axis: -z}
  x: {type: prismatic, child: box, at: [0, 1, 0], axis: x}
  nut: {type: cylindrical, child: nut, at: [1, 1, 0], axis: z}
simulation: {step: 1.0e-3, duration: 1}
)";

std::vector<double> factors_of(const std::string& coupling) {
  const Model model = model_of(workshop + "couplings: {tie: {type: " + coupling + "}}\n");
  std::vector<ConstraintPart> parts;
  append_element_parts(model, 0, parts);
  std::vector<double> factors;
  for (const ConstraintPart& part : parts) factors.push_back(part.c);
  return factors;
}

TEST(NamedCouplings, AreSumsWithTheseFactors) {
  using Factors = std::vector<double>;
  const std::pair<const char*, Factors> cases[] = {
      {"gear, driver: a, driven: b, teeth: [20, 50]", {1.0, 2.5}},
      {"gear, driver: a, driven: c, teeth: [20, 50]", {1.0, -2.5}},
      {"gear, driver: a, driven: b, ratio: 2.5, internal: true", {1.0, -2.5}},
      {"gear, driver: a, driven: c, ratio: 2.5, internal: true", {1.0, 2.5}},
      {"gear, driver: a, driven: nut, ratio: 2", {1.0, 2.0}},
      {"bevel_gear, driver: a, driven: c, ratio: 3", {1.0, 3.0}},
      {"bevel_gear, driver: a, driven: c, teeth: [10, 30], same_sense: true", {1.0, -3.0}},
      {"planetary, sun: a, ring: b, carrier: c, teeth: [24, 72]", {1.0, 3.0, 4.0}},
      {"planetary, sun: a, carrier: b, teeth: [24, 72]", {1.0, -4.0}},
      {"planetary, ring: a, carrier: b, teeth: [24, 72]", {3.0, -4.0}},
      {"planetary, sun: a, ring: c, teeth: [24, 72]", {1.0, -3.0}},
      {"differential, left: a, right: b, cage: c", {1.0, 1.0, 2.0}},
      {"rack_and_pinion, rack: x, pinion: a, radius: 0.25", {1.0, -0.25}},
      {"rack_and_pinion, rack: nut, pinion: a, radius: 0.25, reversed: true", {1.0, 0.25}},
      {"belt, driver: a, driven: b, radii: [0.5, 1.25]", {1.0, -2.5}},
      {"belt, driver: a, driven: b, radii: [0.5, 1.25], crossed: true", {1.0, 2.5}},
      {"belt, driver: a, driven: c, radii: [0.5, 1.25]", {1.0, 2.5}},
      {"mimic, joint: b, follows: a, factor: 0.5, offset: 0.2", {1.0, -0.5}},
      {"mimic, joint: {joint: nut, coordinate: displacement}, follows: {joint: a}", {1.0, -1.0}}};
  for (const auto& [coupling, factors] : cases)
    EXPECT_EQ(factors_of(coupling), factors) << coupling;
  for (const char* screw :
       {"screw, joint: nut, lead: 0.01", "screw, translation: nut, rotation: nut, lead: 0.01",
        "screw, translation: x, rotation: a, lead: 0.01"}) {
    const Factors factors = factors_of(screw);
    ASSERT_EQ(factors.size(), 2u) << screw;
    EXPECT_EQ(factors[0], 1.0);
    EXPECT_NEAR(factors[1], -0.01 / (2.0 * pi), 1e-18);
  }
}

/// The run of a model in both formulations: its last row and units by column.
template <class Test>
void run_in_both(const std::string& text, const Test& test) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(text);
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    test(r, r.table.rows() - 1);
  }
}

// Motor J_1 on the pinion, wheel J_2, and behind a shaft of stiffness k the machine J_3:
// seen from the shaft of the wheel J = J_2 + i^2 J_1, w^2 = k (1 / J + 1 / J_3).
TEST(GearTrain, VibratesAsTwoInertias) {
  const std::string text = R"(
gravity: [0, 0, 0]
bodies:
  motor: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  wheel: {position: [0.3, 0, 0], rigid: {mass: 2, inertia: [0.03, 0.03, 0.05]}}
  machine: {position: [0.3, 0, 0.2], rigid: {mass: 9, inertia: [0.2, 0.2, 0.4]}}
joints:
  motor: {type: revolute, child: motor, at: [0, 0, 0], axis: z}
  wheel: {type: revolute, child: wheel, at: [0.3, 0, 0], axis: -z}
  shaft: {type: revolute, parent: wheel, child: machine, at: [0.3, 0, 0.2], axis: z}
forces: {shaft: {type: joint_spring, joint: shaft, spring: 500}}
couplings: {stage: {type: gear, driver: motor, driven: wheel, teeth: [19, 61]}}
outputs: {motor: {joint_position: motor}}
simulation: {step: 1.0e-3, duration: 1}
)";
  const double ratio = 61.0 / 19.0, behind = 0.05 + ratio * ratio * 0.02;
  const double omega = std::sqrt(500.0 * (1.0 / behind + 1.0 / 0.4));
  for (const Coordinates c : both_coordinates) {
    const LinearSystem s = linear_system(model_of(text), {.coordinates = c});
    ASSERT_EQ(s.degrees, 2);
    double highest = 0.0;
    for (const LinearMode& m : linear_modes(s))
      highest = std::max(highest, std::abs(m.lambda.imag()));
    EXPECT_NEAR(highest / omega, 1.0, 1e-9) << name_of(c);
  }
}

/// Two wheels of 0.02 and 0.05 kg m2 that this coupling ties. `second`: more keys of the joint of
/// the second one; the first one then turns.
std::string two_wheels(const std::string& coupling, const std::string& second = "") {
  return R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.3, 0, 0], rigid: {mass: 2, inertia: [0.03, 0.03, 0.05]}}
joints:
  a: {type: revolute, child: one, at: [0, 0, 0], axis: z)" +
         std::string(second.empty() ? "" : ", velocity: 2") + R"(}
  b: {type: revolute, child: two, at: [0.3, 0, 0], axis: z)" +
         second + "}\ncouplings: {tie: {" + coupling + R"(}}
outputs:
  a: {joint_position: a}
  tie: {coupling_force: tie}
simulation: {step: 1.0e-4, duration: 1}
)";
}

// s = q_1 + c q_2: s'' = -k (1 / J_1 + c^2 / J_2) s
TEST(ElasticCouplings, VibrateWithTheirStiffness) {
  const std::pair<const char*, double> cases[] = {
      {"type: gear, driver: a, driven: b, ratio: 3, mesh_stiffness: 700",
       700.0 * (1.0 / 0.02 + 9.0 / 0.05)},
      {"type: belt, driver: a, driven: b, radii: [0.1, 0.25], stiffness: 7.0e4",
       700.0 * (1.0 / 0.02 + 6.25 / 0.05)}};
  for (const auto& [coupling, square] : cases)
    for (const Coordinates c : both_coordinates) {
      double highest = 0.0;
      for (const LinearMode& m :
           linear_modes(linear_system(model_of(two_wheels(coupling)), {.coordinates = c})))
        highest = std::max(highest, std::abs(m.lambda.imag()));
      EXPECT_NEAR(highest / std::sqrt(square), 1.0, 1e-9) << coupling;
    }
}

// Between the flanks of a wheel that is held: two ways through the play at 2 rad/s and two halves
// of a vibration, with the torque k v / omega at their middle.
TEST(ElasticCouplings, GoThroughTheirBacklash) {
  const double omega = std::sqrt(2000.0 / 0.02), flight = 0.01, touch = pi / omega;
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(two_wheels(
        "type: gear, driver: a, driven: b, ratio: 1, mesh_stiffness: 2000, backlash: 0.02",
        ", motion: 0"));
    d.simulation.coordinates = c;
    d.simulation.locate_edges = true;
    d.simulation.step = 2e-5;
    d.simulation.duration = 2.0 * (flight + touch);
    const RunResult r = completed_run(d);
    double most = 0.0, least = 0.0;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      most = std::max(most, r.table.at(k, 2));
      least = std::min(least, r.table.at(k, 2));
    }
    const double torque = 2000.0 * 2.0 / omega;
    EXPECT_NEAR(least, -torque, 1e-3 * torque) << name_of(c);
    EXPECT_NEAR(most, torque, 1e-3 * torque);
    const std::size_t end = r.table.rows() - 1;
    EXPECT_NEAR(r.table.at(end, 1), 2.0 * (r.table.at(end, 0) - d.simulation.duration), 1e-5);
    EXPECT_LT(std::abs(r.summary.energy.remainder), 1e-4);
  }
}

// Willis: z_s w_s + z_r w_r = (z_s + z_r) w_c, torques in the ratio z_s : z_r : -(z_s + z_r).
TEST(Planetary, SpeedsAndTorques) {
  run_in_both(R"(
gravity: [0, 0, 0]
bodies:
  sun: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  ring: {position: [0, 0, 0.1], rigid: {mass: 2, inertia: [0.03, 0.03, 0.05]}}
  carrier: {position: [0, 0, 0.2], rigid: {mass: 3, inertia: [0.2, 0.2, 0.4]}}
joints:
  sun: {type: revolute, child: sun, at: [0, 0, 0], axis: z, motion: {velocity: 10}}
  ring: {type: revolute, child: ring, at: [0, 0, 0.1], axis: -z, motion: {velocity: 2}}
  carrier: {type: revolute, child: carrier, at: [0, 0, 0.2], axis: z}
forces: {load: {type: torque, body: carrier, direction: z, magnitude: -8}}
couplings: {hub: {type: planetary, sun: sun, ring: ring, carrier: carrier, teeth: [24, 72]}}
outputs:
  carrier: {joint_velocity: carrier}
  hub: {coupling_force: hub}
  sun: {motion_force: sun}
  ring: {motion_force: ring}
  carrier.M: {joint_torque: carrier, axis: z}
simulation: {step: 1.0e-3, duration: 1}
)",
              [](const RunResult& r, std::size_t end) {
                EXPECT_NEAR(r.table.at(end, 1), (24.0 * 10.0 - 72.0 * 2.0) / 96.0, 1e-9);
                EXPECT_NEAR(r.table.at(end, 2), -2.0, 1e-9);  // on the sun, against its motor
                EXPECT_NEAR(r.table.at(end, 3), 2.0, 1e-9);
                EXPECT_NEAR(r.table.at(end, 4), -6.0, 1e-9);  // its axis points down
                EXPECT_NEAR(r.table.at(end, 5), 8.0, 1e-9);
                EXPECT_EQ(r.table.columns[2].unit, "N m");
              });
}

// A car of 1.5 m track at 10 m/s on a circle of 10 m: wheels roll, the cage turns with their mean
// and gives each of them half of its torque.
TEST(Differential, SharesTheTorqueInATurn) {
  run_in_both(R"(
parameters: {inner: ${10 / 0.3 * 0.925}, outer: ${10 / 0.3 * 1.075}}
gravity: [0, 0, 0]
bodies:
  left: {position: [0, 1, 0], rigid: {mass: 1, inertia: [0.1, 0.2, 0.1]}}
  right: {position: [0, -1, 0], rigid: {mass: 1, inertia: [0.2, 0.3, 0.2]}}
  cage: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.4, 0.5, 0.4]}}
joints:
  left: {type: revolute, child: left, at: [0, 1, 0], axis: y, motion: {velocity: ${inner}}}
  right: {type: revolute, child: right, at: [0, -1, 0], axis: -y, motion: {velocity: ${-outer}}}
  cage: {type: revolute, child: cage, at: [0, 0, 0], axis: y}
forces: {motor: {type: torque, body: cage, direction: y, magnitude: 60}}
couplings: {axle: {type: differential, left: left, right: right, cage: cage}}
outputs:
  cage: {joint_velocity: cage}
  axle: {coupling_force: axle}
  left: {motion_force: left}
  right: {motion_force: right}
simulation: {step: 1.0e-3, duration: 1}
)",
              [](const RunResult& r, std::size_t end) {
                EXPECT_NEAR(r.table.at(end, 1), 10.0 / 0.3, 1e-9);
                EXPECT_NEAR(r.table.at(end, 2), 30.0, 1e-9);
                EXPECT_NEAR(r.table.at(end, 3), -30.0, 1e-9);  // what holds the wheels back
                EXPECT_NEAR(r.table.at(end, 4), 30.0, 1e-9);
              });
}

// (m + J / r^2) a = F, the teeth give what turns the pinion: F - m a.
TEST(RackAndPinion, MoveAsOneMass) {
  const double a = 2.1 / (4.0 + 0.03 / 0.01);
  run_in_both(R"(
gravity: [0, 0, 0]
bodies:
  rack: {position: [0, 0, 0], rigid: {mass: 4, inertia: [0.1, 0.1, 0.1]}}
  pinion: {position: [0, 0.1, 0], rigid: {mass: 1, inertia: [0.02, 0.02, 0.03]}}
joints:
  slide: {type: prismatic, child: rack, at: [0, 0, 0], axis: x}
  column: {type: revolute, child: pinion, at: [0, 0.1, 0], axis: z}
forces: {push: {type: force, body: rack, at: [0, 0, 0], direction: x, magnitude: 2.1}}
couplings:
  teeth: {type: rack_and_pinion, rack: slide, pinion: column, radius: 0.1, reversed: true}
outputs:
  x: {joint_velocity: slide}
  q: {joint_velocity: column}
  teeth: {coupling_force: teeth}
simulation: {step: 1.0e-3, duration: 2}
)",
              [&](const RunResult& r, std::size_t end) {
                EXPECT_NEAR(r.table.at(end, 1), 2.0 * a, 1e-4);
                EXPECT_NEAR(r.table.at(end, 2), -10.0 * r.table.at(end, 1), 1e-8);
                EXPECT_NEAR(r.table.at(end, 3), 4.0 * a - 2.1, 1e-8);
                EXPECT_EQ(r.table.columns[3].unit, "N");
              });
}

// A jack of 8 mm lead under a load of 500 kg: the torque that holds it is m g lead / 2 pi.
TEST(ScrewJack, IsHeldByTheTorqueOfItsLead) {
  const StaticsResult s = statics(model_of(R"(
bodies:
  load: {position: [0, 0, 0.5], rigid: {mass: 500, inertia: [10, 10, 10]}}
  spindle: {position: [0, 0, 0], rigid: {mass: 3, inertia: [0.1, 0.1, 0.01]}}
joints:
  lift: {type: prismatic, child: load, at: [0, 0, 0.5], axis: z}
  spindle: {type: revolute, child: spindle, at: [0, 0, 0], axis: z}
couplings: {jack: {type: screw, translation: lift, rotation: spindle, lead: 0.008}}
forces: {hold: {type: joint_spring, joint: spindle, spring: 100}}
outputs: {z: {joint_position: lift}}
simulation: {step: 1.0e-3, duration: 1}
)"));
  const double torque = 500.0 * 9.81 * 0.008 / (2.0 * pi);
  ASSERT_EQ(s.forces.size(), 2u);
  EXPECT_NEAR(s.forces[0].length, -torque / 100.0, 1e-9);
  EXPECT_NEAR(s.forces[1].force, 500.0 * 9.81, 1e-6);
  EXPECT_NEAR(s.joints[1].torque.z(), -torque, 1e-8);
}

// J_1 + J_2 / i^2 of open and crossed belts, started several turns away.
TEST(Belt, TurnsBothPulleys) {
  const double alpha = 0.3 / (0.02 + 0.05 / 6.25);
  for (const bool crossed : {false, true})
    run_in_both(std::string(R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.5, 0, 0], rigid: {mass: 3, inertia: [0.03, 0.03, 0.05]}}
joints:
  engine: {type: revolute, child: one, at: [0, 0, 0], axis: z, position: 50}
  fan: {type: revolute, child: two, at: [0.5, 0, 0], axis: z}
forces: {motor: {type: torque, body: one, direction: z, magnitude: 0.3}}
couplings: {belt: {type: belt, driver: engine, driven: fan, radii: [0.08, 0.2], crossed: )") +
                    (crossed ? "true" : "false") + R"(}}
outputs:
  engine: {joint_position: engine}
  fan: {joint_position: fan}
  belt: {coupling_force: belt}
simulation: {step: 1.0e-3, duration: 0.5}
)",
                [&](const RunResult& r, std::size_t end) {
                  const double sense = crossed ? -1.0 : 1.0;
                  EXPECT_NEAR(r.table.at(0, 2), sense * 20.0, 1e-9);
                  EXPECT_NEAR(r.table.at(end, 1), 50.0 + 0.125 * alpha, 1e-4);
                  EXPECT_NEAR(r.table.at(end, 2), sense * 0.4 * r.table.at(end, 1), 1e-9);
                  EXPECT_NEAR(r.table.at(end, 3), -0.05 * alpha / 6.25, 1e-8);
                });
}

TEST(Mimic, FollowsWithFactorAndOffset) {
  run_in_both(R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  box: {position: [0.5, 0, 0], rigid: {mass: 3}}
joints:
  knuckle:
    {type: revolute, child: one, at: [0, 0, 0], axis: z,
     motion: {sine: {amplitude: 0.5, frequency: 1}}}
  slide: {type: prismatic, child: box, at: [0.5, 0, 0], axis: x}
couplings: {finger: {type: mimic, joint: slide, follows: knuckle, factor: -0.8, offset: 0.1}}
outputs:
  knuckle: {joint_position: knuckle}
  slide: {joint_position: slide}
  finger: {coupling_force: finger}
simulation: {step: 1.0e-3, duration: 0.6}
)",
              [](const RunResult& r, std::size_t end) {
                EXPECT_NEAR(r.table.at(0, 2), 0.1, 1e-10);
                EXPECT_NEAR(r.table.at(end, 2), 0.1 - 0.8 * r.table.at(end, 1), 1e-10);
                // 3 kg times the second derivative of -0.4 sin(2 pi t)
                const double t = r.table.at(end, 0);
                EXPECT_NEAR(r.table.at(end, 3), 1.2 * 4.0 * pi * pi * std::sin(2.0 * pi * t), 1e-3);
              });
}

}  // namespace
}  // namespace floatframe::test

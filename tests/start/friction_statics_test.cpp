// Friction that sticks in equilibria: bristles bend from the start on up to breakaway, and slide
// beyond it; runs begin with this deflection and stay at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double weight_of_a_kilogram = 9.81;

const StaticsForce& friction_of(const StaticsResult& s) {
  for (const StaticsForce& f : s.forces)
    if (f.type == "bristle_friction") return f;
  throw std::runtime_error("no friction");
}

/// A run from the equilibrium stays there, in both formulations: columns q and f.
void expect_rest(const Model& model, double q, double f) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    for (std::size_t row = 0; row < r.table.rows(); ++row) {
      ASSERT_NEAR(r.table.at(row, 1), r.table.at(0, 1), 1e-9);
      ASSERT_NEAR(r.table.at(row, 2), r.table.at(0, 2), 1e-6);
    }
    EXPECT_NEAR(r.table.at(0, 1), q, 1e-9);
    EXPECT_NEAR(r.table.at(0, 2), f, 1e-6);
  }
}

/// An arm of 1 kg, its centre at 0.5 m, on a brake of 400 * 30 N m/rad.
Model braked_arm(const std::string& breakaway) {
  return model_of(R"(
bodies: {arm: {position: [0.5, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.1, 0.1]}}}
joints:
  h: {type: revolute, child: arm, at: [0, 0, 0], axis: y, friction: {breakaway: )" +
                  breakaway + R"(, stiffness: 400, damping: 4, preload: 200, radius: 0.15}}
outputs: {q: {joint_position: h}, f: {force: h.friction}}
simulation: {step: 1.0e-3, duration: 0.2, start: equilibrium}
)");
}

/// A vertical slide of 1 kg.
Model slide(const std::string& friction, const std::string& more = "") {
  return model_of(R"(
bodies: {c: {position: [0, 0, 1], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
joints:
  c: {type: prismatic, child: c, at: [0, 0, 1], axis: z, friction: {stiffness: 1.0e4, )" +
                  friction + "}" + more + R"(}
outputs: {q: {joint_position: c}, f: {force: c.friction}}
simulation: {step: 1.0e-3, duration: 0.2, start: equilibrium}
)");
}

const std::string stop_below = ", stops: {lower: -0.01, stiffness: 1.0e4}";

// 12000 q = 4.905 cos q.
TEST(FrictionStatics, ABrakeHoldsAnArm) {
  const Model model = braked_arm("0.4");
  const double moment = 0.5 * weight_of_a_kilogram, q = moment / 12000.0;
  const StaticsResult s = statics(model);
  EXPECT_NEAR(friction_of(s).length, q, 1e-9);
  EXPECT_NEAR(friction_of(s).force, moment * std::cos(q), 1e-6);
  EXPECT_TRUE(s.notes.empty());
  expect_rest(model, friction_of(s).length, friction_of(s).force);
}

// A brake of 3 N m: the arm slides until its weight turns with cos q = 3 / 4.905.
TEST(FrictionStatics, AWeakBrakeSlidesToWhereItHolds) {
  const Model model = braked_arm("0.1");
  const StaticsResult s = statics(model);
  EXPECT_NEAR(friction_of(s).length, std::acos(3.0 / (0.5 * weight_of_a_kilogram)), 1e-9);
  EXPECT_NEAR(friction_of(s).force, 3.0, 1e-9);
}

TEST(FrictionStatics, BristlesCarryASlide) {
  const double q = -weight_of_a_kilogram / 1e4;
  for (const char* friction : {"breakaway: 20, damping: 20", "breakaway: 20, elastic: 0",
                               "breakaway: 20, kinetic: 12, stribeck: 0.01"})
    for (const std::string& stop : {std::string(), stop_below}) {
      const Model model = slide(friction, stop);
      const StaticsResult s = statics(model);
      EXPECT_NEAR(s.bodies[0].position.z(), 1.0 + q, 1e-12) << friction << stop;
      EXPECT_NEAR(friction_of(s).force, -weight_of_a_kilogram, 1e-9) << friction << stop;
      expect_rest(model, q, -weight_of_a_kilogram);
    }
}

// Beyond breakaway it slides, with this force, onto the stop. Without one nothing holds it.
TEST(FrictionStatics, SlidesToAStop) {
  for (const char* friction : {"breakaway: 5, damping: 20", "breakaway: 5, elastic: 0, damping: 20",
                               "breakaway: 5, kinetic: 4, stribeck: 0.01, damping: 20"}) {
    const double q = -0.01 - (weight_of_a_kilogram - 5.0) / 1e4;
    const Model model = slide(friction, stop_below);
    const StaticsResult s = statics(model);
    EXPECT_NEAR(s.bodies[0].position.z(), 1.0 + q, 1e-9) << friction;
    expect_rest(model, q, -5.0);
  }
  EXPECT_EQ(error_of([] { statics(slide("breakaway: 5")); }), "no_equilibrium");
}

// Sticking friction is a stiffness of the equilibrium: an arm that stands is not unstable.
TEST(FrictionStatics, HoldsAnArmThatStands) {
  const auto standing = [](const std::string& friction) {
    return statics(model_of(R"(
bodies: {arm: {position: [0, 0, 0.5], rigid: {mass: 1, inertia: [0.1, 0.1, 0.01]}}}
joints: {h: {type: revolute, child: arm, at: [0, 0, 0], axis: y)" +
                            friction + "}}\n"));
  };
  EXPECT_FALSE(standing("").notes.empty());
  EXPECT_TRUE(standing(", friction: {breakaway: 1, stiffness: 100}").notes.empty());
}

// The normal force is that of the joint itself: m g cos a across the slope, with friction 0.5.
TEST(FrictionStatics, ABlockSticksByItsReaction) {
  const double a = 0.4, c = std::cos(a), s = std::sin(a);
  const Model model = model_of(R"(
bodies: {block: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints:
  slope: {type: prismatic, child: block, at: [0, 0, 0], axis: [)" +
                               std::to_string(c) + ", 0, " + std::to_string(-s) + R"(],
    friction: {breakaway: 0.5, stiffness: 1e5, damping: 200, reaction: true}}
outputs: {q: {joint_position: slope}, f: {force: slope.friction}}
simulation: {step: 1.0e-3, duration: 0.2, start: equilibrium}
)");
  const double pull = 2.0 * weight_of_a_kilogram * s, normal = 2.0 * weight_of_a_kilogram * c;
  const StaticsResult found = statics(model);
  EXPECT_NEAR(friction_of(found).force, pull, 1e-4);
  EXPECT_NEAR(friction_of(found).length, pull / (1e5 * normal), 1e-9);
  expect_rest(model, friction_of(found).length, friction_of(found).force);
}

// An arm on a pin whose friction is that of its own weight: it slides down until r mu m g holds it,
// cos q = r mu / l.
TEST(FrictionStatics, AnArmSlidesOnItsPin) {
  const Model model = model_of(R"(
bodies: {arm: {position: [0.5, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.1, 0.1]}}}
joints:
  h: {type: revolute, child: arm, at: [0, 0, 0], axis: y,
    friction: {breakaway: 0.5, stiffness: 1e3, damping: 10, reaction: true, bearing_radius: 0.2}}
outputs: {q: {joint_position: h}, f: {force: h.friction}}
simulation: {step: 1.0e-3, duration: 0.2, start: equilibrium}
)");
  const StaticsResult found = statics(model);
  EXPECT_NEAR(friction_of(found).force, 0.1 * weight_of_a_kilogram, 1e-7);
  EXPECT_NEAR(friction_of(found).length, std::acos(0.2), 1e-7);
}

// A coordinate that moves at the start slides, and keeps its friction.
TEST(FrictionStatics, SlidingFrictionStays) {
  const Model model = model_of(R"(
bodies: {c: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
joints:
  c: {type: prismatic, child: c, at: [0, 0, 0], axis: x, velocity: 2,
      friction: {breakaway: 5, stiffness: 1.0e4}}
forces: {s: {type: joint_spring, joint: c, spring: 100}}
outputs: {q: {joint_position: c}, f: {force: c.friction}}
simulation: {step: 1.0e-3, duration: 0.01, start: equilibrium}
)");
  const RunResult r = completed_run(model, model.simulation);
  EXPECT_NEAR(r.table.at(0, 1), -0.05, 1e-9);
  EXPECT_NEAR(r.table.at(0, 2), 5.0, 1e-6);
}

// What a bearing with clearance rubs with is not known at rest: a note says so.
TEST(FrictionStatics, OfAJournalBearingIsLeftOut) {
  const Model model = model_of(R"(
bodies: {shaft: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
joints: {p: {type: planar, child: shaft, at: [0, 0, 0], axis: y, axis_2: x}}
forces:
  pin: {type: journal_bearing, from: {body: ground, at: [0, 0, 0]},
    to: {body: shaft, at: [0, 0, 0]}, axis: y, radius: 0.01, clearance: 1.0e-4,
    stiffness: 1.0e+6, exponent: 1, restitution: 0.8,
    friction: 0.1}
)");
  const StaticsResult s = statics(model);
  EXPECT_NEAR(s.bodies[0].position.z(), -1e-4 - 1e-6 * weight_of_a_kilogram, 1e-9);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_TRUE(
      contains(s.notes[0], "journal_bearing 'pin' is in the equilibrium without its friction"))
      << s.notes[0];
}

}  // namespace
}  // namespace floatframe::test

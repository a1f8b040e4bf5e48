// Steps are divided at jumps and corners of functions of time: order by halving, in both
// formulations, for loads, targets and motions; what is located and what is said of the rest.
#include "floatframe/stepping/time_corners.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/realtime/realtime.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/figures.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A cart on a slide with a pendulum. `slide`: keys of its joint; `forces` beside.
std::string cart(const std::string& slide, const std::string& forces) {
  return R"(
points: {o: [0, 0, 0], end: [0.4, 0, 0.3]}
inputs: {none: {}}
bodies:
  cart: {rigid: {mass: 2, centre_of_mass: o, inertia: [1, 1, 1]}}
  bob: {rigid: {mass: 0.5, centre_of_mass: [0, 0, -0.4], inertia: [0.01, 0.02, 0.01]}}
joints:
  slide: {type: prismatic, child: cart, at: o, axis: x)" +
         slide + R"(}
  hinge: {type: revolute, parent: cart, child: bob, at: o, axis: y, position: 0.2}
forces:
)" + forces +
         R"(
outputs: {x: {joint_position: slide}, q: {joint_position: hinge}, v: {joint_velocity: slide}}
simulation: {step: 0.004, duration: 0.8, output_interval: 0.04}
)";
}

const std::string coil = "  coil: {type: joint_spring, joint: slide, spring: 80, damper: 3}\n";
std::string load(const std::string& table) {
  return coil + "  push: {type: force, body: cart, direction: x, magnitude: {table: " + table +
         "}}\n";
}

struct Cornered {
  const char* name;
  std::string model;
  long corners;  ///< that are located, at every step
};

std::vector<Cornered> cornered() {
  return {
      {"jump_at_a_step", cart("", load("[[0.4, 0], [0.4, 20]]")), 1},
      {"jump_within_a_step", cart("", load("[[0, 3], [0.3337, 5], [0.3337, -20], [2, 0]]")), 1},
      {"steep_flank", cart("", load("[[0, 0], [0.4, 0], [0.4000001, 20], [1, 20]]")), 2},
      {"two_corners_within_a_step", cart("", load("[[0, 0], [0.2101, 0], [0.2104, 40], [1, 0]]")),
       2},
      {"pulse_within_a_step",
       cart("", load("[[0, 0], [0.2101, 0], [0.21012, 900], [0.2104, 900], [0.21045, 0]]")), 4},
      {"corners_far_apart", cart("", load("[[0, 0], [0.1501, 30], [0.4703, -20], [0.9, 0]]")), 2},
      {"saw_of_jumps",
       cart("", load("[[0, 0], [0.1, 9], [0.1, -9], [0.2307, 9], [0.2307, -9], [0.5001, 9], "
                     "[0.5001, 0]]")),
       3},
      {"two_loads_at_one_instant",
       cart("", load("[[0.3001, 0], [0.3001, 20]]") +
                    "  turn: {type: torque, body: bob, direction: y, magnitude: {table: "
                    "[[0.3001000001, 0], [0.3001000001, 0.5]]}}\n"),
       1},
      {"jump_of_a_following_load",
       cart("",
            coil +
                "  blow: {type: force, body: bob, at: [0, 0, -0.4], direction: x, follows: true, "
                "magnitude: {table: [[0.3337, 0], [0.3337, 3], [0.5555, 3], [0.5555, 0]]}}\n"),
       2},
      {"jump_of_an_actuator",
       cart(
           "",
           "  strut: {type: spring_damper, from: {body: ground, at: end}, to: {body: cart, at: o}, "
           "spring: 200, damper: 2, actuator: {table: [[0.2003, 0], [0.2003, 15]]}}\n"),
       1},
      {"jump_of_a_target",
       cart("",
            "  coil: {type: joint_spring, joint: slide, spring: 80, damper: 3, "
            "target: {table: [[0.3337, 0], [0.3337, 0.2]]}, target_rate: 0}\n"),
       1},
      {"corner_of_a_target",  // its rate jumps, which the damper feels
       cart("",
            "  coil: {type: joint_spring, joint: slide, spring: 80, damper: 20, target: {table: "
            "[[0, 0], [0.2003, 0], [0.5005, 0.3], [1, 0.3]]}}\n"),
       2},
      {"jump_of_a_target_rate",
       cart("",
            "  coil: {type: joint_spring, joint: slide, spring: 0, damper: 20, target_rate: "
            "{table: [[0.2003, 0], [0.2003, 1], [0.5005, 1], [0.5005, 0]]}}\n"),
       2},
      {"acceleration_of_a_motion_jumps",  // three parabolas that meet with their slopes
       cart(", motion: {piecewise: [{below: 0.2003, polynomial: [0]}, {below: 0.5003, about: "
            "0.2003, polynomial: [0, 0, 2]}, {about: 0.5003, polynomial: [0.18, 1.2]}]}",
            "  idle: {type: force, body: bob, direction: x, magnitude: 0}\n"),
       2},
      {"cubic_table_of_a_motion",
       cart(", motion: {table: [[0, 0], [0.1507, 0.1], [0.4509, 0.15], [0.8, 0]]}",
            "  idle: {type: force, body: bob, direction: x, magnitude: 0}\n"),
       3},
  };
}

class TimeCornersOf
    : public ::testing::TestWithParam<std::tuple<std::size_t, Coordinates, double>> {
 protected:
  RunResult run_at(const Model& model, double step) const {
    SimulationDescription o = with(model.simulation, std::get<1>(GetParam()));
    o.spectral_radius = std::get<2>(GetParam());
    o.step = step;
    o.tolerance = 1e-11;
    return completed_run(model, o);
  }
};

TEST_P(TimeCornersOf, TheErrorFallsWithTheSquareOfTheStep) {
  const Cornered c = cornered()[std::get<0>(GetParam())];
  const Model model = model_of(c.model);
  const RunResult fine = run_at(model, 1e-4);
  double previous = 0.0, first = 0.0, last = 0.0;
  for (const double h : {4e-3, 2e-3, 1e-3}) {
    const RunResult r = run_at(model, h);
    EXPECT_EQ(r.summary.corners, c.corners);
    EXPECT_TRUE(r.summary.start.notes.empty());
    const double e = std::hypot(difference(r.table, fine.table, "x") / 0.1,
                                difference(r.table, fine.table, "q") / 0.3);
    figure(std::string(c.name) + " error", e);
    // A flank of a part of a step is not the same part of half the step: single ratios vary.
    if (previous > 0.0) {
      EXPECT_GT(previous / e, 3.0) << h;
    }
    if (previous == 0.0) first = e;
    previous = last = e;
  }
  EXPECT_GT(std::log2(first / last) / 2.0, 1.85) << "order over two halvings";
  EXPECT_LT(last, 2e-4);
}

INSTANTIATE_TEST_SUITE_P(All, TimeCornersOf,
                         ::testing::Combine(::testing::Range(std::size_t{0}, cornered().size()),
                                            ::testing::ValuesIn(both_coordinates),
                                            ::testing::Values(1.0, 0.8)),
                         [](const auto& x) {
                           return std::string(cornered()[std::get<0>(x.param)].name) + "_" +
                                  name_of(std::get<1>(x.param)) +
                                  (std::get<2>(x.param) < 1.0 ? "_alpha" : "");
                         });

/// 1 kg on a slide under a load, for 1 s in steps of 10 ms.
Model pushed(const std::string& table) {
  return model_of(R"(
gravity: [0, 0, 0]
bodies: {m: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {p: {type: prismatic, child: m, at: [0, 0, 0], axis: x}}
forces: {a: {type: force, body: m, direction: x, magnitude: {table: )" +
                  table + R"(}}}
outputs:
  x: {joint_position: p}
  v: {joint_velocity: p}
  a: {acceleration: m, axis: x}
  F: {force: a}
simulation: {step: 0.01, duration: 1}
)");
}

RunResult run_in(const Model& model, Coordinates coordinates, bool all = false) {
  SimulationDescription o = with(model.simulation, coordinates);
  o.locate_edges = all;
  return run(model, o);
}

// In closed form, at a step of any size: a constant force moves a free mass exactly.
TEST(TimeCorners, StepsOfALoadAreExact) {
  for (const Coordinates c : both_coordinates)
    for (const char* table : {"[[0, 0], [0.5, 0], [0.5000001, 1], [1, 1]]", "[[0.5, 0], [0.5, 1]]",
                              "[[0, 0], [0.5, 0], [0.500000001, 1], [1, 1]]"}) {
      const RunResult r = run_in(pushed(table), c);
      EXPECT_NEAR(r.table.at(100, 1), 0.125, 1e-7) << table;
      EXPECT_NEAR(r.table.at(100, 2), 0.5, 1e-7) << table;
      EXPECT_EQ(r.table.at(49, 3), 0.0);
      EXPECT_NEAR(r.table.at(51, 3), 1.0, 1e-9);
      // The balance sees both sides of the jump.
      EXPECT_NEAR(r.summary.energy.work.total(), 0.125, 1e-7);
      EXPECT_LT(std::abs(r.summary.energy.remainder), 1e-9);
    }
  // At the instant of a jump all that is sampled is of its right side.
  const RunResult r = run_in(pushed("[[0.5, 0], [0.5, 1]]"), Coordinates::relative);
  EXPECT_EQ(r.table.at(50, 4), 1.0);
  EXPECT_NEAR(r.table.at(50, 3), 1.0, 1e-9);
  EXPECT_NEAR(r.table.at(50, 2), 0.0, 1e-12);
}

// Ends of steps are sums of steps, and rounding leaves them on either side of jumps that are
// written as numbers: 0.09 + 0.01 is less than 0.1.
TEST(TimeCorners, JumpsAtEndsOfStepsAreMetWhateverTheRounding) {
  struct Grid {
    double step, on, off;
  };
  for (const Grid& g : {Grid{0.01, 0.09, 0.1}, Grid{0.01, 0.05, 0.07}, Grid{0.005, 0.035, 0.05},
                        Grid{0.0005, 0.8, 0.9}, Grid{0.001, 0.3, 0.7}})
    for (const Coordinates c : both_coordinates) {
      Model model = model_of(
          "points: {o: [0, 0, 0]}\nbodies: {m: {rigid: {mass: 2, centre_of_mass: o, inertia: [1, "
          "1, 1]}}}\njoints: {s: {type: prismatic, child: m, at: o, axis: x}}\nforces:\n  push: "
          "{type: force, body: m, direction: x, magnitude: {table: [[" +
          fmt::format("{0}, 0], [{0}, 100], [{1}, 100], [{1}, 0]]}}}}\n", g.on, g.off) +
          "outputs: {v: {joint_velocity: s}}\nsimulation: {step: 0.01, duration: 1}\n");
      model.simulation.step = g.step;
      const RunResult r = run_in(model, c);
      EXPECT_EQ(r.summary.corners, 2) << g.step;
      EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 50.0 * (g.off - g.on), 1e-9) << g.step;
      EXPECT_TRUE(r.summary.warnings.empty()) << r.summary.warnings.front().sentence;
    }
}

// A force on very little mass is no direction without mass.
TEST(TimeCorners, LightPartsFollowJumpsToo) {
  for (const double mass : {1.0, 1e-6, 1e-9}) {
    const Model model = model_of(
        "gravity: [0, 0, 0]\npoints: {o: [0, 0, 0]}\nbodies: {m: {rigid: {mass: " +
        fmt::format("{}", mass) +
        ", centre_of_mass: o}}}\njoints: {s: {type: prismatic, child: m, at: o, axis: x}}\nforces: "
        "{push: {type: force, body: m, direction: x, magnitude: {table: [[0.05, 0], [0.05, 1], "
        "[0.0551, 1], [0.0551, 0]]}}}\noutputs: {v: {joint_velocity: s}}\nsimulation: {step: "
        "0.001, "
        "duration: 0.1}\n");
    for (const Coordinates c : both_coordinates) {
      const RunResult r = run_in(model, c);
      EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1) * mass, 0.0051, 1e-9) << mass;
    }
  }
}

TEST(TimeCorners, APulseBetweenTwoStepsHasItsImpulse) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r =
        run_in(pushed("[[0, 0], [0.502, 0], [0.503, 10], [0.504, 10], [0.506, 0]]"), c);
    EXPECT_NEAR(r.table.at(100, 2), 0.025, 1e-9);
    EXPECT_EQ(r.summary.corners, 4);
    for (const RangeWarning& w : r.summary.warnings) EXPECT_NE(w.limit, RangeLimit::table);
    // Shorter than what is made as a step: by the accelerations of the middle.
    const RunResult s =
        run_in(pushed("[[0.5031, 0], [0.50315, 10], [0.50317, 10], [0.50318, 0]]"), c);
    EXPECT_NEAR(s.table.at(100, 2), 10.0 * 0.00005, 1e-9);
  }
}

std::string dense_table(int points, double gap) {
  std::string text = "[[0, 0]";
  for (int k = 1; k < points; ++k)
    text += ", [" + std::to_string(gap * k) + ", " + std::to_string(k % 2) + "]";
  return text + "]";
}

TEST(TimeCorners, DenseTablesAreSampledAndNamed) {
  const Model dense = pushed(dense_table(60, 0.0151));
  const RunResult r = run_in(dense, Coordinates::relative);
  EXPECT_EQ(r.summary.corners, 0);
  ASSERT_EQ(r.summary.start.notes.size(), 1u);
  EXPECT_EQ(r.summary.start.notes[0],
            "the load 'a' is sampled at the ends of steps: 59 of its corners follow one another "
            "within two steps; locate_edges: true divides steps there, too");
  const RunResult all = run_in(dense, Coordinates::relative, true);
  EXPECT_EQ(all.summary.corners, 59);
  EXPECT_TRUE(all.summary.start.notes.empty());
  // All of them: exact, but for the curvature within a piece.
  SimulationDescription fine = dense.simulation;
  fine.step = 1e-4;
  const RunResult exact = run(dense, fine);
  EXPECT_LT(std::abs(all.table.at(100, 2) - exact.table.at(10000, 2)), 1e-6);
  // Half as dense at half the step.
  SimulationDescription half = dense.simulation;
  half.step = 0.005;
  EXPECT_EQ(run(dense, half).summary.corners, 59);
  // A jump among many corners is located all the same.
  std::string text = dense_table(60, 0.0151);
  text.insert(text.rfind(']'), ", [0.9501, 0], [0.9501, 5]");
  EXPECT_EQ(run_in(pushed(text), Coordinates::relative).summary.corners, 1);
}

TEST(TimeCorners, CornersOfOnePartInAMillionOfAStepAreOne) {
  const Model m = pushed("[[0, 0], [0.5, 0], [0.5000000005, 1], [0.7, 1], [0.7002, 3], [0.9, 0]]");
  const TimeCorners c = time_corners(m, {.step = 0.01, .begin = 0.0, .duration = 1.0});
  ASSERT_EQ(c.located.size(), 4u);
  EXPECT_EQ(c.located[0].from, 0.5);
  EXPECT_EQ(c.located[0].to, 0.5000000005);
  EXPECT_EQ(c.located[1].from, 0.7);
  EXPECT_EQ(c.located[2].from, 0.7002);
  // Those at the beginning and before it have been, those after the end do not come.
  EXPECT_EQ(time_corners(m, {.step = 0.01, .begin = 0.7, .duration = 0.1}).located.size(), 1u);
}

/// The cart of motion_with_corners: a velocity of 2 m/s from one instant to the next.
Model jerked(const std::string& interpolation) {
  return model_of(cart(", motion: {table: [[0, 0], [0.5, 0], [1, 1], [1.5, 1]], interpolation: " +
                           interpolation + "}",
                       "  idle: {type: force, body: bob, direction: x, magnitude: 0}\n"));
}

TEST(TimeCorners, AVelocityThatJumpsIsNamedAndNotLocated) {
  for (const Coordinates c : both_coordinates) {
    const SimulationDescription o = with(jerked("linear").simulation, c, 0.004, 1.2);
    const RunResult r = completed_run(jerked("linear"), o);
    EXPECT_EQ(r.summary.corners, 0);
    ASSERT_EQ(r.summary.start.notes.size(), 1u);
    EXPECT_EQ(r.summary.start.notes[0],
              "the motion of joint 'slide' jumps in its velocity, by 2 m/s at t = 0.5 s (and at 1 "
              "more instant): an impulse, whose force and energy are those of the step, not of the "
              "model; round it over some steps, or write a table with interpolation: cubic");
    const RunResult smooth = run(jerked("cubic"), o);
    EXPECT_TRUE(smooth.summary.start.notes.empty());
    EXPECT_EQ(smooth.summary.corners, 2);
  }
}

// Steps of real time are of bounded work.
TEST(TimeCorners, RealTimeDoesNotDivideItsSteps) {
  const Model m = pushed("[[0.5031, 0], [0.5031, 1]]");
  const RealTimeOptions options{.paced = false};
  const RealTimeReport r = run_real_time(m, m.simulation, options, nullptr);
  EXPECT_EQ(r.steps, 100);
  ASSERT_EQ(r.start.notes.size(), 1u);
  EXPECT_EQ(
      r.start.notes[0],
      "the load 'a' jumps or has a corner within a step, the first at t = 0.5031 s: steps are "
      "not divided here, so it acts from one end of that step to the other");
  // The old way: half the load over the whole of that step.
  EXPECT_NEAR(r.outputs[1], 0.49 + 0.005, 1e-9);
}

// A simulation makes the steps of a run; saved within it goes on with equal bits; nothing
// allocates.
TEST(TimeCorners, ASimulationMeetsThemToo) {
  for (const Coordinates c : both_coordinates) {
    const Model model = model_of(cornered()[6].model);
    const SimulationOptions o{.coordinates = c};
    Simulation s(model, o), other(model, o);
    std::vector<std::byte> bytes;
    std::vector<double> rows;
    for (int k = 0; k < 200; ++k) {
      if (k == 58) bytes = s.save().to_bytes();  // in the step after the next one
      ASSERT_TRUE(s.step());
      if (k >= 58) rows.insert(rows.end(), s.outputs().begin(), s.outputs().end());
    }
    EXPECT_EQ(s.counters().corners, 3);
    other.restore(SimulationState::from_bytes(bytes));
    std::vector<double> again;
    again.reserve(rows.size());
    const AllocationScope scope;
    for (int k = 58; k < 200; ++k) {
      ASSERT_TRUE(other.step());
      again.insert(again.end(), other.outputs().begin(), other.outputs().end());
    }
    if (allocations_counted()) {
      EXPECT_EQ(scope.count(), 0u);
    }
    EXPECT_TRUE(equal_bits(again, rows));
    SimulationDescription d = with(model.simulation, c);
    d.output_interval = 0.0;
    const RunResult r = run(model, d);
    EXPECT_EQ(r.table.at(200, 1), s.output("x"));
    // Steps of other sizes meet the same instants.
    Simulation odd(model, o);
    while (odd.time() < 0.7995) ASSERT_TRUE(odd.step(0.0033));
    EXPECT_EQ(odd.counters().corners, 3);
  }
}

}  // namespace
}  // namespace floatframe::test

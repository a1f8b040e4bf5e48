// Start values that do not fit the loops are changed and reported; those that are kept stay.
#include <gtest/gtest.h>

#include "floatframe/start/check.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A four-bar linkage of unequal links; `extra` are keys of the joints at the ground.
std::string four_bar(const std::string& crank, const std::string& rocker,
                     const std::string& cut = "c") {
  const auto mark = [&](const char* joint) { return cut == joint ? ", cut: true" : ""; };
  return std::string(R"(
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1],
      inertia: [.001, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 1, centre_of_mass: [0.25, 0, 0.3],
      inertia: [.001, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0, 0.2],
      inertia: [.001, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y)") +
         crank + mark("a") + R"(}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y)" +
         mark("b") + R"(}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.4], axis: y)" +
         mark("c") + R"(}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y)" +
         rocker + mark("d") + R"(}
outputs:
  a: {joint_position: a}
  d: {joint_position: d}
  a.rate: {joint_velocity: a}
  d.rate: {joint_velocity: d}
simulation: {step: 0.001, duration: 0.01}
)";
}

TEST(StartValues, GivenOnesThatDoNotFitAreReported) {
  const Model model =
      model_of(four_bar(", position: 0.3, velocity: 1", ", position: 0.3, velocity: 1"));
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    const StartReport& start = r.summary.start;
    ASSERT_EQ(start.changes.size(), 4u) << c.name();
    EXPECT_EQ(start.changes[0].owner, "joint 'a'");
    EXPECT_EQ(start.changes[0].quantity, "angle");
    EXPECT_EQ(start.changes[0].unit, "rad");
    EXPECT_EQ(start.changes[3].owner, "joint 'd'");
    EXPECT_TRUE(start.changes[3].rate);
    EXPECT_EQ(start.changes[3].unit, "rad/s");
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(start.changes[k].given, k < 2 ? 0.3 : 1.0);
      // What the outputs show at the start.
      EXPECT_NEAR(start.changes[k].used, r.table.at(0, k + 1), 1e-9) << c.name() << k;
    }
    ASSERT_GE(start.notes.size(), 4u);
    expect_in(start.notes[0],
              "joint 'a': closing the loops changed the angle from the 0.3 rad given to ");
    expect_in(start.notes[3],
              "joint 'd': closing the loops changed the rate of the angle from the 1 rad/s");
  }
  EXPECT_EQ(check(model).start.changes.size(), 4u);
}

TEST(StartValues, ThatBringTheEndsOfASpringTogetherAreNoted) {
  const auto model_at = [](double position) {
    return model_of(R"(
bodies: {a: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {s: {type: prismatic, child: a, at: [0, 0, 0], axis: x, position: )" +
                    std::to_string(position) + R"(}}
forces:
  k: {type: spring_damper, from: {body: ground, at: [1, 0, 0]}, to: {body: a, at: [0, 0, 0]},
      spring: 100}
simulation: {step: 0.001, duration: 0.01}
)");
  };
  for (const Combination& c : combinations) {
    const std::vector<std::string> notes = run_of(model_at(1.0), c).summary.start.notes;
    ASSERT_EQ(notes.size(), 1u) << c.name();
    expect_in(notes[0], "the ends of force 'k' coincide at the start");
    EXPECT_TRUE(run_of(model_at(0.999), c).summary.start.notes.empty());
  }
}

TEST(StartValues, OnesThatFitAreNot) {
  const Model model = model_of(four_bar(", position: 0.3, velocity: 1", ""));
  const RunResult r = run_of(model, combinations[0]);
  EXPECT_TRUE(r.summary.start.changes.empty());
  EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-12);
  EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-12);
}

TEST(StartValues, CountWhereverTheLoopIsCut) {
  // The value of a joint that happens to be cut was forgotten.
  for (const char* cut : {"a", "b", "c", "d"}) {
    const Model model = model_of(four_bar(", position: 0.3, velocity: 1", "", cut));
    for (const Combination& c : combinations) {
      const RunResult r = run_of(model, c);
      EXPECT_TRUE(r.summary.start.changes.empty()) << cut << c.name();
      EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-9) << cut << c.name();
      EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-9) << cut << c.name();
    }
  }
}

TEST(StartValues, KeptOnesDoNotMove) {
  for (const char* cut : {"a", "c", "d"}) {
    const Model model = model_of(
        four_bar(", position: 0.3, velocity: 1, keep: true", ", position: 0.3, velocity: 1", cut));
    const RunResult r = run_of(model, combinations[0]);
    EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-9) << cut;
    EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-9) << cut;
    ASSERT_EQ(r.summary.start.changes.size(), 2u) << cut;
    EXPECT_EQ(r.summary.start.changes[0].owner, "joint 'd'");
    EXPECT_TRUE(r.summary.start.changes[1].rate);
  }
}

TEST(StartValues, KeptOnesThatCannotBeHeldAreNamed) {
  for (const char* cut : {"a", "c"}) {
    const Model positions =
        model_of(four_bar(", position: 0.3, keep: true", ", position: 0.3, keep: true", cut));
    expect_in(message_of([&] { run_of(positions, combinations[0]); }),
              "cannot be assembled while joints 'a' and 'd' keep their start values (keep: true)");
    const Model rates =
        model_of(four_bar(", velocity: 1, keep: true", ", velocity: 1, keep: true", cut));
    expect_in(message_of([&] { run_of(rates, combinations[0]); }),
              "the start velocities do not fit while joints 'a' and 'd' keep their start values");
  }
}

// Both cranks of a four-bar linkage are driven: one rate follows from the other.
TEST(StartValues, MotionsThatContradictEachOther) {
  const auto message = [&](const char* a, const char* d, const char* cut) {
    const auto motion = [](const char* polynomial) {
      return std::string(", motion: {polynomial: ") + polynomial + "}";
    };
    const Model model = model_of(four_bar(motion(a), motion(d), cut));
    std::string first;
    for (const Combination& c : combinations) {
      const std::string m = message_of([&] { run_of(model, c); });
      if (first.empty()) first = m;
      EXPECT_EQ(m, first) << c.name();
    }
    return first;
  };
  for (const char* cut : {"a", "c", "d"}) {
    // In the design position the rocker of 0.4 m goes at half the rate of the crank of 0.2 m.
    EXPECT_EQ(message("[0, 2]", "[0, 5]", cut),
              "the start velocities do not fit: the prescribed motions of joints 'a' and 'd' "
              "contradict each other: joint 'a' is off by 8 rad/s if the rest is met")
        << cut;
    run_of(
        model_of(four_bar(", motion: {polynomial: [0, 2]}", ", motion: {polynomial: [0, 1]}", cut)),
        combinations[0]);
    expect_in(message("[0, 0]", "[0.1, 0]", cut),
              "the model cannot be assembled: the prescribed motions of joints 'a' and 'd' "
              "contradict each other: joint 'a' is off by 0.2 rad if the rest is met");
  }
}

}  // namespace
}  // namespace floatframe::test

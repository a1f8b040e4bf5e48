// The alarm of the energy balance: silent where little of the energy changes hands and the error is
// small beside all of it, or where a set point steps; and where it speaks it names the corner or
// jump that no step resolves instead of a smaller step.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/energy_cause.hpp"
#include "support/contains.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

#define RANGE(name) FLOATFRAME_TEST_DATA "/range/" name ".yaml"

RunSummary alarm_run(const ModelDescription& d, Coordinates coordinates, double step = 0.0) {
  SimulationDescription s = with(d.simulation, coordinates);
  if (step > 0.0) s.step = step;
  return run(build_model(d), s).summary;
}

std::string balance_sentence(const RunSummary& s) {
  for (const RangeWarning& w : s.warnings)
    if (w.limit == RangeLimit::balance || w.limit == RangeLimit::damping) return w.sentence;
  return "";
}

// The energy that the spring of the motor has when its set point has stepped is work of the
// actuator: nothing is missing, and what is left falls with the step.
TEST(EnergyAlarm, StepOfASetPoint) {
  const ModelDescription d = read_model(RANGE("set_point_step"));
  for (const Coordinates c : both_coordinates) {
    double part[2];
    for (int k = 0; k < 2; ++k) {
      const RunSummary s = alarm_run(d, c, k == 0 ? 0.01 : 0.005);
      ASSERT_EQ(s.status, "completed");
      EXPECT_EQ(sentences(s.warnings), std::vector<std::string>{});
      EXPECT_GT(s.energy.work[EnergyFlow::actuators], 2.0);  // Tmax 0.5 - Tmax^2/(2 Kp) and more
      part[k] = std::abs(s.energy.largest_remainder) / s.energy.exchanged;
    }
    figure("set point remainder", part[0]);
    EXPECT_LT(part[0], 5e-3);
    EXPECT_LT(part[1], 0.75 * part[0]);
  }
}

// Booked by the change of the spring's energy or by its rate, the work is the same where the target
// moves smoothly.
TEST(EnergyAlarm, TargetsWithoutJumpsAreBookedAsBefore) {
  const ModelDescription d = test::description_of(R"(
gravity: [0, 0, 0]
points: {o: [0, 0, 0]}
bodies: {m: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}}
joints: {r: {type: revolute, child: m, at: o, axis: z}}
forces:
  pd: {type: joint_spring, joint: r, spring: 40, damper: 2,
       target: {sine: {amplitude: 0.4, frequency: 0.7}}}
simulation: {step: 0.002, duration: 2}
)");
  ModelDescription table = d;
  auto& spring = std::get<JointSpring>(table.forces[0].kind);
  // The same, of pieces.
  spring.target->pieces = PiecewisePolynomial({1.0}, {{0.0, {0.0}}, {1.0, {0.0}}});
  const EnergySummary a = alarm_run(d, Coordinates::relative).energy,
                      b = alarm_run(table, Coordinates::relative).energy;
  EXPECT_NEAR(a.work[EnergyFlow::actuators], b.work[EnergyFlow::actuators], 1e-4 * a.exchanged);
  EXPECT_LT(std::abs(a.largest_remainder), 1e-4 * a.exchanged);
  EXPECT_LT(std::abs(b.largest_remainder), 1e-4 * b.exchanged);
}

// Torque-free: all energy stays where it is, so the error is all that changes.
TEST(EnergyAlarm, FreeTop) {
  const ModelDescription d = read_model(RANGE("free_top"));
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = alarm_run(d, c);
    EXPECT_EQ(sentences(s.warnings), std::vector<std::string>{});
    EXPECT_NEAR(s.energy.present, 100.0, 0.01);
    EXPECT_GT(std::abs(s.energy.largest_remainder), 0.2 * s.energy.exchanged);  // nothing else
    EXPECT_LT(std::abs(s.energy.largest_remainder), 1e-5 * s.energy.present);
  }
}

// A step that is too long for it is said all the same.
TEST(EnergyAlarm, FreeTopInLongSteps) {
  const ModelDescription d = read_model(RANGE("free_top"));
  for (const Coordinates c : both_coordinates) {
    const std::string said = balance_sentence(alarm_run(d, c, 0.04));
    EXPECT_TRUE(contains(said, "take a smaller step than 0.04 s"));
  }
}

// A mechanism without weight, driven at a constant rate: only what its links swing changes hands,
// and a link without mass has no energy at all.
TEST(EnergyAlarm, WeightlessMechanisms) {
  for (const char* mass : {"0", "1e-9", "1"})
    for (const char* motion : {"[0.5, 3]", "[0.5, 0]"}) {
      const ModelDescription d = test::description_of(
          std::string("gravity: [0, 0, 0]\npoints: {a: [0, 0, 0], b: [0.3, 0, 0.1], c: [1, 0, 0]}\n"
                      "bodies:\n  crank: {rigid: {mass: ") +
          mass + ", centre_of_mass: a, inertia: [0, 0, 0]}}\n  rod: {rigid: {mass: " + mass +
          ", centre_of_mass: b, inertia: [0, 0, 0]}}\n  block: {rigid: {mass: " + mass +
          ", centre_of_mass: c}}\njoints:\n"
          "  crank: {type: revolute, child: crank, at: a, axis: y, motion: {polynomial: " +
          motion +
          "}}\n  pin: {type: revolute, parent: crank, child: rod, at: b, axis: y}\n"
          "  wrist: {type: revolute, parent: rod, child: block, at: c, axis: y}\n"
          "  guide: {type: prismatic, parent: ground, child: block, at: c, axis: x}\n"
          "simulation: {step: 0.002, duration: 2}\n");
      for (const Coordinates c : both_coordinates) {
        const RunSummary s = alarm_run(d, c);
        ASSERT_EQ(s.status, "completed") << s.message;
        EXPECT_EQ(balance_sentence(s), "") << mass << motion;
      }
    }
}

constexpr const char* cornered_motion = R"(
gravity: [0, 0, 0]
points: {o: [0, 0, 0], b: [0, 0, -1]}
bodies:
  m: {rigid: {mass: 10, centre_of_mass: o, inertia: [1, 1, 1]}}
  p: {rigid: {mass: 1, centre_of_mass: b, inertia: [0.01, 0.01, 0.01]}}
joints:
  p: {type: prismatic, child: m, at: o, axis: x,
      motion: {table: [[0, 0], [0.5, 0], [1, 1], [1.5, 1]], interpolation: linear}}
  h: {type: revolute, parent: m, child: p, at: o, axis: y}
simulation: {step: 0.01, duration: 1.5}
)";

TEST(EnergyAlarm, NamesTheCornerOfAMotion) {
  const ModelDescription d = test::description_of(cornered_motion);
  for (const Coordinates c : both_coordinates)
    for (const double step : {0.01, 0.005, 0.0025}) {
      const std::string said = balance_sentence(alarm_run(d, c, step));
      ASSERT_NE(said, "");
      EXPECT_FALSE(contains(said, "smaller step"));
      EXPECT_TRUE(contains(said,
                           "the velocity of the motion of joint 'p' jumps by -2 m/s at t = 1 s: no "
                           "step resolves that, round the corner"));
    }
}

TEST(EnergyCause, OfMotionsLiesInTheWindow) {
  const Model model = model_of(cornered_motion);
  EXPECT_EQ(energy_cause(model, 0.0, 0.4, 0.01, {}), "");
  EXPECT_TRUE(contains(energy_cause(model, 0.9, 1.2, 0.01, {}), "jumps by -2 m/s at t = 1 s"));
  EXPECT_EQ(energy_cause(model, 1.1, 1.5, 0.01, {}), "");
  // Cubic: no corner.
  std::string smooth = cornered_motion;
  smooth.replace(smooth.find("linear"), 6, "cubic");
  EXPECT_EQ(energy_cause(model_of(smooth), 0.0, 2.0, 0.01, {}), "");
}

TEST(EnergyCause, OfTargetsAndLoadsIsWhatStepsAreNotDividedAt) {
  const auto cause = [](const std::string& force, double step,
                        std::span<const TimeCorner> corners = {}) {
    return energy_cause(
        model_of("points: {o: [0, 0, 0]}\n"
                 "bodies: {m: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}}\n"
                 "joints: {r: {type: revolute, child: m, at: o, axis: z}}\n"
                 "forces: {f: " +
                 force + "}\n"),
        0.9, 1.1, step, corners);
  };
  const std::string table = "{table: [[0, 0], [1, 0], [1.001, 0.5], [9, 0.5]]}";
  const std::string spring = "{type: joint_spring, joint: r, spring: 60, damper: 3, target: ";
  EXPECT_EQ(cause(spring + table + "}", 0.01),
            "the target of force 'f' goes by 0.5 rad within a step from t = 1 s on: take a smaller "
            "step than 0.01 s, or locate_edges: true");
  const TimeCorner located[] = {{1.0, 1.0}, {1.001, 1.001}};
  EXPECT_EQ(cause(spring + table + "}", 0.01, located), "");
  EXPECT_EQ(cause(spring + table + "}", 0.0005), "");
  EXPECT_EQ(cause(spring + "{table: [[0, 0], [1, 0], [2, 0.5]]}}", 0.01), "");
  EXPECT_EQ(
      cause("{type: torque, body: m, direction: z, magnitude: " + table + "}", 0.01).substr(0, 56),
      "the magnitude of force 'f' goes by 0.5 N m within a step");
  EXPECT_EQ(cause("{type: joint_spring, joint: r, actuator: " + table + "}", 0.01).substr(0, 55),
            "the actuator of force 'f' goes by 0.5 N m within a step");
}

}  // namespace
}  // namespace floatframe::test

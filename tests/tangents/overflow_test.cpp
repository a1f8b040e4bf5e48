// Numbers that overflow and tolerances below rounding: the sentence blames them and nothing else.
#include <gtest/gtest.h>

#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

TEST(Overflow, IsNotCalledASingularMatrix) {
  const char* const text = R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: MASS, centre_of_mass: [0.5, 0.1, 0.2],
    inertia: [MASS, MASS, MASS]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y}}
)";
  const auto with_mass = [&](const std::string& mass) {
    std::string t = text;
    for (std::size_t at = t.find("MASS"); at != std::string::npos; at = t.find("MASS"))
      t.replace(at, 4, mass);
    return t;
  };
  for (const std::string& t : {with_mass("1e308"), with_mass("1") + "gravity: [0, 0, -1e300]\n"}) {
    const Model model = model_of(t);
    for (const Combination& c : combinations)
      expect_in(message_of([&] { run_of(model, c); }), "model overflow: ");
    expect_in(message_of([&] { statics(model); }), "model overflow: ");
    expect_in(message_of([&] { check(model); }), "model overflow: ");
  }
}

struct Oversized {
  std::string joint, rest, expected;
  bool at_start;  // or when the first steps have failed
};

TEST(Overflow, OfLawsMotionsAndVelocitiesIsNamedAlikeInAllFormulations) {
  const std::string spring = "forces: {s: {type: joint_spring, joint: h, ";
  const std::string load = "forces: {s: {type: torque, body: b, direction: y, magnitude: ";
  for (const Oversized& o :
       {Oversized{"", spring + "spring: 1e308}}", "the spring of 's' has a slope of 1e+308", true},
        Oversized{"", spring + "damper: 1e150}}", "the damper of 's' has a slope of 1e+150", true},
        Oversized{", velocity: 1e200", "", "body 'b' turns at 1e+200 rad/s", true},
        Oversized{", motion: {polynomial: [0, 1e200]}", "",
                  "the motion of joint 'h' or its rate reaches 1e+200", true},
        Oversized{", motion: {sine: {amplitude: 1, frequency: 1e200}}", "",
                  "the motion of joint 'h' or its rate reaches 6.28e+200", true},
        Oversized{"", load + "{polynomial: [0, 0, 1e60]}}}", "", false},
        Oversized{"", load + "{sine: {amplitude: 1e300, frequency: 10}}}}", "the force of 's' is ",
                  false},
        Oversized{", velocity: 1e20", spring + "damper: 1}}", "body 'b' turns at 1e+20 rad/s",
                  false}}) {
    const Model model = model_of(R"(
bodies: {b: {rigid: {mass: 1, centre_of_mass: [1, 0, 0], inertia: [1, 1, 1]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y)" +
                                 o.joint + "}}\n" + o.rest + "\nsimulation: {duration: 0.01}\n");
    std::string first;
    for (const Combination& c : combinations) {
      if (o.at_start) {
        const std::string m = message_of([&] { run_of(model, c); });
        expect_in(m, "model overflow: " + o.expected);
        if (first.empty()) first = m;
        EXPECT_EQ(m, first) << c.name();
      } else if (const RunResult r = run_of(model, c); r.summary.status != "completed") {
        expect_in(r.summary.message, "model overflow: " + o.expected);
      }
    }
  }
}

TEST(Overflow, OfStepsAndTinyMasses) {
  const std::string head = "bodies: {b: {rigid: {centre_of_mass: [0, 0, 0], ";
  const Model tiny = model_of(head + "mass: 1e-320}}}\n");
  const Model lasting = model_of(head +
                                 "mass: 1, inertia: [1, 1, 1]}}}\n"
                                 "simulation: {step: 1e300, duration: 1e301}\n");
  for (const Combination& c : combinations) {
    expect_in(message_of([&] { run_of(tiny, c); }),
              "the numbers of the model overflow: the mass of body 'b' is 9.99989e-321 kg");
    expect_in(run_of(lasting, c).summary.message,
              "the numbers of the model overflow: the step of 1e+300 s is too long");
  }
}

TEST(Overflow, LongAxesAreAxes) {
  for (const char* axis : {"[1e300, 1e300, 0]", "[1e-300, 1e-300, 0]"}) {
    const std::string head =
        "bodies: {b: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: "
        "[0.5, 0.1, 0.2], inertia: [1, 1, 1]}}}\n";
    const auto angle = [&](const std::string& direction) {
      const Model model = model_of(
          head + "joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: " + direction +
          "}}\n" + "outputs: {h: {joint_position: h}}\nsimulation: {step: 0.01, duration: 0.5}\n");
      const RunResult r = run_of(model, combinations[0]);
      return r.table.at(r.table.rows() - 1, 1);
    };
    EXPECT_NEAR(angle(axis), angle("[1, 1, 0]"), 1e-12);
  }
}

TEST(Tolerances, BelowRoundingAreBlamedThemselves) {
  const Model model = model_of(R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0.1, 0.2],
    inertia: [1, 1, 1]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y}}
)");
  SimulationDescription options = with(model.simulation, Coordinates::relative);
  options.tolerance = 1e-300;
  options.step = 1e-3;
  options.min_step = 1e-6;
  Stepper steps(model, options);
  bool good = true;
  for (int k = 0; k < 200 && good; ++k) good = steps.advance();
  ASSERT_FALSE(good);
  expect_in(steps.failure(), "the tolerance of 1e-300 is below the rounding of double precision");
  expect_in(message_of([] {
              model_of(
                  "bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0]}}}\n"
                  "simulation: {tolerance: 1e-300}\n");
            }),
            "simulation.tolerance: found 1e-300, expected a number from 1e-15 to 1");
}

}  // namespace
}  // namespace floatframe::test

// Numbers that overflow and tolerances below rounding: the sentence blames them and nothing else.
#include <gtest/gtest.h>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/runner.hpp"
#include "simulation/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

TEST(Overflow, IsNotCalledASingularMatrix) {
  const char* const text = R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: MASS, centre_of_mass: [0.5, 0.1, 0.2], inertia: [MASS, MASS, MASS]}}}
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
      expect_in(message_of([&] { run_of(model, c); }), "the numbers of the model overflow: ");
    expect_in(message_of([&] { statics(model); }), "the numbers of the model overflow: ");
    expect_in(message_of([&] { count(model); }), "the numbers of the model overflow: ");
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
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0.1, 0.2], inertia: [1, 1, 1]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y}}
)");
  RelativeFormulation f(model, model.simulation.inertia);
  StepOptions options = step_options(model, model.simulation);
  options.tolerance = 1e-300;
  Runner<RelativeFormulation> runner(f, options, 1e-6);
  runner.state() = relative_start(f, Start::given);
  start_accelerations(f, runner.state(), options.penalty_mass);
  bool good = true;
  for (int k = 0; k < 200 && good; ++k) good = runner.advance(1e-3);
  ASSERT_FALSE(good);
  expect_in(runner.failure(), "the tolerance of 1e-300 is below the rounding of double precision");
  expect_in(message_of([] {
              model_of(
                  "bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0]}}}\n"
                  "simulation: {tolerance: 1e-300}\n");
            }),
            "simulation.tolerance: found 1e-300, expected a number of at least 1e-15");
}

}  // namespace
}  // namespace floatframe::test

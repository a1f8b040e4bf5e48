// Runs made again at half and a quarter of the step.
#include "floatframe/run/verification.hpp"

#include <gtest/gtest.h>

#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

Verification verified(const Model& model, const SimulationDescription& o,
                      const RunOptions& options = {}) {
  const RunResult r = run(model, o);
  return verify_steps(model, o, r.summary.duration, rows_of(r.table), options);
}

const char* pendulum = R"(
bodies: {bob: {position: [0.5, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.02, 0.02]}}}
joints: {hinge: {type: revolute, child: bob, at: [0, 0, 0], axis: y, position: 0.3}}
gravity: [0, 0, -9.81]
outputs: {angle: {joint_position: hinge}, speed: {joint_velocity: hinge}, bob: {position: bob}}
)";

std::string with_settings(const std::string& text, const std::string& settings) {
  return text + "simulation: {" + settings + "}\n";
}

TEST(Verification, ErrorOfAPendulum) {
  const Model model = model_of(with_settings(pendulum, "step: 0.01, duration: 1"));
  for (const Coordinates c : both_coordinates) {
    const SimulationDescription o = with(model.simulation, c, 0.01, 1.0);
    const Verification v = verified(model, o);
    EXPECT_TRUE(v.sentences.empty()) << v.sentences[0];
    EXPECT_EQ(v.instants, 101u);
    const RunResult run_h = completed_run(model, o),
                    exact = completed_run(model, with(o, c, 0.01 / 32, 1.0));
    ASSERT_EQ(v.outputs.size(), 5u);
    for (const std::size_t k : {0, 1, 2, 4}) {
      EXPECT_NEAR(v.outputs[k].order, 2.0, 0.05) << v.outputs[k].column.name;
      double error = 0.0;
      for (std::size_t row = 0; row < run_h.table.rows(); ++row)
        error =
            std::max(error, std::abs(run_h.table.at(row, k + 1) - exact.table.at(32 * row, k + 1)));
      EXPECT_NEAR(v.outputs[k].error, error, 0.02 * error) << v.outputs[k].column.name;
    }
    EXPECT_EQ(v.outputs[3].convergence, Convergence::round_off) << "bob.y";
  }
}

TEST(Verification, RowsThatAreNotEveryStepAndALastStepThatIsShorter) {
  const Model model =
      model_of(with_settings(pendulum, "step: 0.01, duration: 0.537, output_interval: 0.0251"));
  const RunResult r = completed_run(model, model.simulation);
  const Verification v = verified(model, model.simulation);
  EXPECT_EQ(v.instants, r.table.rows());
  EXPECT_NEAR(v.to, 0.537, 1e-12);
  EXPECT_NEAR(v.outputs[0].order, 2.0, 0.1);
}

TEST(Verification, ACornerOfALawIsNamed) {
  const std::string text = R"(
bodies: {block: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
joints: {slide: {type: prismatic, child: block, at: [0, 0, 0], axis: x, position: 0.1}}
gravity: [0, 0, 0]
forces:
  s: {type: joint_spring, joint: slide,
      spring: {table: [[-1, -100], [0, 0], [0.05, 5], [0.051, 105]]}}
outputs: {x: {joint_position: slide}}
)";
  const Model model = model_of(with_settings(text, "step: 1e-4, duration: 1"));
  SimulationDescription o = model.simulation;
  const Verification v = verified(model, o);
  EXPECT_NEAR(v.outputs[0].order, 1.0, 0.3);
  ASSERT_EQ(v.sentences.size(), 1u);
  EXPECT_TRUE(contains(v.sentences[0], "'x'"));
  EXPECT_TRUE(contains(v.sentences[0], "locate_edges: true"));
  o.locate_edges = true;
  const Verification good = verified(model, o);
  EXPECT_TRUE(good.sentences.empty()) << good.sentences[0];
  EXPECT_NEAR(good.outputs[0].order, 2.0, 0.05);
}

/// A pendulum whose law throws after 0.5 s in the runs from number `from` on, counted from 0.
Model failing_pendulum(int from) {
  ModelDescription d = description_of(with_settings(pendulum, "step: 0.01, duration: 1"));
  ForceLaw law;
  law.joint = "hinge";
  law.law = [from, runs = 0, last = 0.0](double x, double, double t) mutable -> ForceLawValue {
    if (t < 0.5 * last) ++runs;
    last = t;
    if (runs >= from && t > 0.5) throw std::runtime_error("no more");
    return -0.1 * x;
  };
  d.forces.push_back({"f", law, {}});
  return build_model(d);
}

TEST(Verification, ARunAtASmallerStepThatFails) {
  for (const int from : {1, 2}) {
    const Model model = failing_pendulum(from);
    const Verification v = verified(model, model.simulation);
    ASSERT_FALSE(v.sentences.empty());
    EXPECT_TRUE(contains(v.sentences[0],
                         from == 1 ? "the run at half the step failed: the law of 'f'"
                                   : "the run at a quarter of the step failed: the law of 'f'"));
    EXPECT_NEAR(v.to, from == 1 ? 0.5 : 1.0, 1e-9);
    EXPECT_NEAR(v.outputs[0].order, 2.0, 0.05);
    EXPECT_FALSE(v.interrupted);
  }
}

TEST(Verification, ARunThatHasFailed) {
  const Model model = failing_pendulum(0);
  const Verification v = verified(model, model.simulation);
  ASSERT_FALSE(v.sentences.empty());
  EXPECT_EQ(v.sentences[0], "the run ended early: compared up to 0.5 s");
  EXPECT_NEAR(v.outputs[0].order, 2.0, 0.05);
}

TEST(Verification, AnInterruptKeepsWhatIsThere) {
  const Model model = model_of(with_settings(pendulum, "step: 0.01, duration: 1"));
  for (const double at : {0.1, 0.5}) {  // in the one run and in the other
    std::atomic<bool> stop{false};
    RunOptions options;
    options.stop = &stop;
    options.progress = [&](double f) { stop = f >= at; };
    const Verification v = verified(model, model.simulation, options);
    EXPECT_TRUE(v.interrupted);
    ASSERT_EQ(v.sentences.size(), 1u);
    EXPECT_TRUE(contains(v.sentences[0],
                         at < 0.3 ? "the run at half the step was interrupted at t = 0.3"
                                  : "the run at a quarter of the step was interrupted at t = "));
    EXPECT_EQ(v.outputs[0].convergence, at < 0.3 ? Convergence::unknown : Convergence::regular);
    EXPECT_GT(v.outputs[0].largest, 0.0);
  }
}

}  // namespace
}  // namespace floatframe::test

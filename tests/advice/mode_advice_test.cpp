// Advice on modes: figures against closed forms, and advice that a run confirms or refuses.
#include "floatframe/advice/mode_advice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/body/with_modes.hpp"
#include "support/model_text.hpp"

namespace floatframe {
namespace {

// A cantilever of 1 m that is welded to the ground and carries a tip mass on a slow sine force in
// z. Its bending in y is never excited, and its higher bending modes in z hardly.
const char* const cantilever = R"(
gravity: [0, 0, 0]
parameters: {normal: 6, frequency: 1}
points: {root: [0, 0, 0], tip: [1, 0, 0]}
bodies:
  beam:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars:
        bar: {from: root, to: tip, elements: 12, section: {rectangle: [0.01, 0.02]}, reference: y}
      clamped: [root]
      static_modes: [{point: tip, dofs: [y, z]}]
      normal_modes: "${normal}"
      damping: 0.02
joints:
  root: {type: weld, child: beam, at: root}
forces:
  push: {type: force, body: beam, at: tip, direction: [0, 0, 1], magnitude: {sine: {amplitude: 5,
      frequency: "${frequency}"}}}
outputs:
  tip.z: {position: {body: beam, at: tip}, axis: z}
  tip.rate: {velocity: {body: beam, at: tip}, axis: z}
simulation: {step: 0.002, duration: 1, spectral_radius: 0.8, tolerance: 1.0e-9}
)";

ModelDescription description(const std::string& text,
                             const std::vector<ParameterOverride>& values = {}) {
  return test::description_of(text, values);
}

ModeAdviceReport advise(const ModelDescription& d, AdviceOptions options = {}) {
  options.repeat = 1;
  return advise(build_model(d), d.simulation, options);
}

TEST(ModeAdvice, FrequenciesOfABarInClosedForm) {
  const ModelDescription d = description(cantilever);
  const ModeAdviceReport report = advise(d);
  ASSERT_EQ(report.bodies.size(), 1u);
  const BodyAdvice& beam = report.bodies[0];
  ASSERT_EQ(beam.modes.size(), 8u);
  // Free-free bar: (4.730)^2 / (2 pi) sqrt(EI / (rho A L^4)); first in y (the soft direction).
  const double rho_A = 2700.0 * 0.01 * 0.02, EI_y = 70e9 * 0.02 * std::pow(0.01, 3) / 12.0;
  const double free = std::pow(4.730041, 2) / (2.0 * std::numbers::pi) * std::sqrt(EI_y / rho_A);
  EXPECT_NEAR(beam.free_frequencies[0] / free, 1.0, 0.02);
  // Fixed-interface modes: clamped-pinned, (3.9266)^2.
  const double pinned = std::pow(3.926602, 2) / (2.0 * std::numbers::pi) * std::sqrt(EI_y / rho_A);
  EXPECT_NEAR(beam.modes[2].frequency / pinned, 1.0, 0.02);
  for (const ModeAdvice& m : beam.modes) {
    EXPECT_GE(m.free_frequency, m.frequency * (1.0 - 1e-12)) << m.name;
    EXPECT_NEAR(m.step_phase, 2.0 * std::numbers::pi * m.free_frequency * d.simulation.step,
                1e-12 * m.step_phase);
  }
}

// Statically, the tip deflects in the static modes alone.
TEST(ModeAdvice, StaticSharesBelongToTheStaticModes) {
  const ModeAdviceReport report = advise(description(cantilever));
  const auto& modes = report.bodies[0].modes;
  double sum = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    sum += modes[k].static_share;
    EXPECT_TRUE(k < 2 || modes[k].static_share < 1e-12) << modes[k].name;
  }
  // Uncoupled stiffness (tip translations in y and z): shares add up, and as the compliances do.
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_NEAR(modes[0].static_share / modes[1].static_share, 4.0, 1e-6);
}

TEST(ModeAdvice, IrrelevantModesGoAndTheRunConfirmsIt) {
  const ModelDescription d = description(cantilever);
  const ModeAdviceReport report = advise(d);
  ASSERT_GE(report.dropped, 4);
  // Normal modes 1 and 2 are the first in y and z; all above are superfluous.
  for (std::size_t k = 4; k < 8; ++k)
    EXPECT_EQ(report.bodies[0].modes[k].action, ModeAction::drop) << k;
  EXPECT_EQ(report.bodies[0].modes[1].action == ModeAction::drop, false);
  EXPECT_LT(report.flops_reduced, 0.7 * report.flops_full);
  ASSERT_FALSE(report.differences.empty());
  for (const OutputDifference& o : report.differences) EXPECT_LE(o.relative, 0.01) << o.name;

  // The claim, checked by other means: the model file with fewer normal modes gives the same curve.
  const RunResult full = run(build_model(d), d.simulation);
  const ModelDescription few = description(cantilever, {{"normal", "2"}});
  const RunResult reduced = run(build_model(few), few.simulation);
  double high = 0.0, difference = 0.0;
  for (std::size_t r = 0; r < full.table.rows(); ++r) {
    high = std::max(high, std::abs(full.table.at(r, 1)));
    difference = std::max(difference, std::abs(full.table.at(r, 1) - reduced.table.at(r, 1)));
  }
  EXPECT_LT(difference, 0.01 * high);
}

TEST(ModeAdvice, SlowLoadsMakeAModeQuasiStaticAndResonanceDoesNot) {
  const ModeAdviceReport slow = advise(description(cantilever));
  EXPECT_EQ(slow.bodies[0].modes[1].action, ModeAction::quasi_static);
  EXPECT_LT(slow.bodies[0].modes[1].kinetic_ratio, 0.05);
  const double own = slow.bodies[0].modes[1].frequency;
  // Driven near the first frequency of the cantilever in z.
  const ModeAdviceReport fast =
      advise(description(cantilever, {{"frequency", std::to_string(own)}}));
  EXPECT_EQ(fast.bodies[0].modes[1].action, ModeAction::keep);
  EXPECT_GT(fast.bodies[0].modes[1].kinetic_ratio, 0.3);
}

// With a threshold that calls every mode droppable, the run refuses what matters.
TEST(ModeAdvice, ARunThatChangesRefusesTheDrop) {
  AdviceOptions careless;
  careless.drop_share = 10.0;
  const ModeAdviceReport report = advise(description(cantilever), careless);
  EXPECT_EQ(report.candidates, 8);
  EXPECT_GT(report.trials, 1);
  EXPECT_LT(report.dropped, 8);
  EXPECT_GE(report.dropped, 4);
  const ModeAdvice& z = report.bodies[0].modes[1];
  EXPECT_NE(z.action, ModeAction::drop);
  EXPECT_TRUE(z.retained);
  for (const OutputDifference& o : report.differences) EXPECT_LE(o.relative, careless.tolerance);

  // Without its deflection in z the tip does not move at all: nothing may go if nothing may differ.
  AdviceOptions strict = careless;
  strict.tolerance = 0.0;
  const ModeAdviceReport none = advise(description(cantilever), strict);
  for (const OutputDifference& o : none.differences) EXPECT_EQ(o.relative, 0.0);
}

TEST(ModeAdvice, AModelWithoutModes) {
  const ModelDescription d = description(R"(
bodies: {rod: {rigid: {mass: 1, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.1, 0.1]}}}
joints: {hinge: {type: revolute, child: rod, at: [0, 0, 0], axis: y}}
simulation: {step: 0.01, duration: 0.1}
)");
  const ModeAdviceReport report = advise(d);
  EXPECT_EQ(report.modes, 0);
  EXPECT_EQ(report.dropped, 0);
  EXPECT_TRUE(report.bodies.empty());
}

// Columns, rows and names of what is kept, against the same body reduced with fewer modes.
TEST(WithModes, EqualsAReductionWithFewerNormalModes) {
  const Model many = build_model(description(cantilever, {{"normal", "5"}}));
  const Model few = build_model(description(cantilever, {{"normal", "2"}}));
  const FlexibleBody& reference = *few.bodies[0].data;
  const FlexibleBody body = with_modes(*many.bodies[0].data, {0, 1, 2, 3});
  ASSERT_EQ(body.modes(), 4);
  EXPECT_EQ(body.mode_names, reference.mode_names);
  EXPECT_LT((body.fixed_interface_frequencies - reference.fixed_interface_frequencies).norm(),
            1e-9 * reference.fixed_interface_frequencies.norm());
  EXPECT_LT((body.K - reference.K).norm(), 1e-9 * reference.K.norm());
  EXPECT_LT((body.invariants.S - reference.invariants.S).norm(), 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((body.invariants.Si[i] - reference.invariants.Si[i]).norm(), 1e-9);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_LT((body.invariants.Sij[i][j] - reference.invariants.Sij[i][j]).norm(), 1e-9);
  }
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    EXPECT_LT((body.nodes[n].X - reference.nodes[n].X).norm(), 1e-9);
    EXPECT_LT((body.nodes[n].X_theta - reference.nodes[n].X_theta).norm(), 1e-8);
  }
  ASSERT_TRUE(body.projection);
  EXPECT_LT((body.projection->X - reference.projection->X).norm(), 1e-8);
  const FlexibleBody none = with_modes(*many.bodies[0].data, {});
  EXPECT_EQ(none.modes(), 0);
  EXPECT_EQ(none.nodes.size(), body.nodes.size());
}

}  // namespace
}  // namespace floatframe

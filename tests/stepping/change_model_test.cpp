// A simulation that goes on with another model of the same structure: against closed forms, against
// a run with an input that does the same, by step halving, saved states, what is refused.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "floatframe/stepping/stepping.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// 1 kg on a spring along z, at 0.1 m; `more`: keys of the spring.
Model oscillator(const std::string& stiffness, const std::string& more = "",
                 const std::string& simulation = "step: 0.01") {
  return model_of(R"(
gravity: [0, 0, 0]
inputs: {F: {unit: N}}
bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z, position: 0.1}}
forces:
  s: {type: joint_spring, joint: z, spring: )" +
                  stiffness + more + R"(}
  f: {type: force, body: b, direction: z, magnitude: {input: F}}
outputs: {z: {joint_position: z}, v: {joint_velocity: z}, a: {acceleration: b, axis: z}}
simulation: {)" + simulation +
                  "}\n");
}

/// The slider crank with a beam: a load on its rod, a spring at the hinge of the beam.
std::string changing_machine(double load, double spring) {
  return machine_bodies + machine_joints + R"(forces:
  push: {type: joint_spring, joint: hinge, spring: )" +
         std::to_string(spring) + R"(, damper: 0.2}
  load: {type: force, body: rod, at: [0.3, 0, 0], direction: y, magnitude: )" +
         std::to_string(load) + R"(}
outputs:
  eye: {joint_position: eye}
  hinge: {joint_position: hinge}
  tip: {position: {body: beam, node: tip}, axis: z}
simulation: {step: 0.001}
)";
}

bool equal_bits(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  return true;
}

class ChangeModel : public ::testing::TestWithParam<Coordinates> {
 protected:
  SimulationOptions options(double step, double rho = 1.0) const {
    return {.step = step, .coordinates = GetParam(), .tolerance = 1e-12, .spectral_radius = rho};
  }
};

// z = 0.1 cos(10 t) up to t1 = 0.2, then with w = 20: z1 cos(w s) + v1 / w sin(w s).
TEST_P(ChangeModel, AStiffnessThatChangesIsOfSecondOrder) {
  const Model soft = oscillator("100"), stiff = oscillator("400");
  const double z1 = 0.1 * std::cos(2.0), v1 = -std::sin(2.0), s = 0.3, w = 20.0;
  const double exact = z1 * std::cos(w * s) + v1 / w * std::sin(w * s);
  for (const double rho : {1.0, 0.8, 0.5}) {
    double previous = 0.0;
    for (const double h : {4e-3, 2e-3, 1e-3, 5e-4}) {
      Simulation x(soft, options(h, rho));
      for (long k = 0; k < std::lround(0.2 / h); ++k) ASSERT_TRUE(x.step());
      x.change_model(stiff);
      for (long k = 0; k < std::lround(s / h); ++k) ASSERT_TRUE(x.step());
      const double error = std::abs(x.output("z") - exact);
      figure("rho " + std::to_string(rho) + " error", error);
      if (previous > 0.0) {
        EXPECT_GT(previous / error, 3.5) << "rho " << rho << ", step " << h;
      }
      previous = error;
    }
    EXPECT_LT(previous, 1e-5);
  }
}

// A preload of -k x0 is the force of an input: both act from the next step, and the trapezoidal
// rule makes the same steps.
TEST_P(ChangeModel, APreloadActsAsAnInputDoes) {
  const Model plain = oscillator("{linear: {stiffness: 100, preload: 0}}"),
              loaded = oscillator("{linear: {stiffness: 100, preload: 3}}");
  for (const double rho : {1.0, 0.6}) {
    Simulation a(plain, options(0.01, rho)), b(plain, options(0.01, rho));
    for (int k = 0; k < 40; ++k) {
      if (k == 20) {
        a.change_model(loaded);
        b.set_input("F", -3.0);
        EXPECT_EQ(a.output("z"), b.output("z"));
        EXPECT_EQ(a.output("a"), b.output("a")) << "outputs are those of the last step";
      }
      ASSERT_TRUE(a.step());
      ASSERT_TRUE(b.step());
      EXPECT_NEAR(a.output("z"), b.output("z"), 1e-11) << k;
      EXPECT_NEAR(a.output("v"), b.output("v"), 1e-9) << k;
    }
  }
}

TEST_P(ChangeModel, NothingThatChangesChangesNoBit) {
  const Model model = model_of(changing_machine(2.0, 5.0));
  Simulation a(model, options(1e-3)), b(model, options(1e-3));
  for (int k = 0; k < 60; ++k) {
    if (k % 20 == 10) a.change_model(model_of(changing_machine(2.0, 5.0)));
    ASSERT_TRUE(a.step());
    ASSERT_TRUE(b.step());
    ASSERT_TRUE(equal_bits(a.outputs(), b.outputs())) << k;
  }
}

// A state file keeps positions and velocities, from which the changed model starts as well.
TEST_P(ChangeModel, IsARunFromAStateOfTheChangedModel) {
  Simulation a(model_of(changing_machine(2.0, 5.0)), options(1e-3));
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(a.step());
  const Model changed = model_of(changing_machine(-7.0, 40.0));
  a.change_model(changed);
  SimulationOptions from_state = options(1e-3);
  from_state.state = std::make_shared<const SystemState>(a.state());
  Simulation b(changed, from_state);
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(a.step());
    ASSERT_TRUE(b.step());
    for (const char* name : {"eye", "hinge", "tip"})
      EXPECT_NEAR(a.output(name), b.output(name), 1e-7) << name << " " << k;
  }
}

TEST_P(ChangeModel, SavedStatesBelongToTheChangedModel) {
  const Model first = model_of(changing_machine(2.0, 5.0)),
              second = model_of(changing_machine(3.0, 9.0));
  Simulation a(first, options(1e-3));
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(a.step());
  const SimulationState before = a.save();
  const double* row = a.outputs().data();
  a.change_model(second);
  EXPECT_EQ(a.outputs().data(), row) << "outputs stay where they are";
  const SimulationState after = a.save();
  EXPECT_EQ(error_of([&] { a.restore(before); }), "mismatch");
  Simulation b(second, options(1e-3));
  b.restore(SimulationState::from_bytes(after.to_bytes()));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(a.step());
    ASSERT_TRUE(b.step());
    ASSERT_TRUE(equal_bits(a.outputs(), b.outputs())) << k;
  }
  // Back to the first model, and to what was saved of it.
  a.change_model(first);
  a.restore(before);
  Simulation c(first, options(1e-3));
  c.restore(before);
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(a.step());
    ASSERT_TRUE(c.step());
    ASSERT_TRUE(equal_bits(a.outputs(), c.outputs())) << k;
  }
}

TEST_P(ChangeModel, InputsAndCallbackStay) {
  Simulation a(oscillator("100"), options(0.01));
  a.set_input("F", 2.0);
  a.change_model(oscillator("0"));
  ASSERT_TRUE(a.step());
  EXPECT_NEAR(a.output("v"), 0.02, 1e-12);
  int calls = 0;
  a.on_force([&](double, std::span<const double>, std::span<double> inputs) {
    ++calls;
    inputs[0] = 0.0;
    EXPECT_EQ(error_of([&] { a.change_model(oscillator("1")); }), "in_use");
  });
  a.change_model(oscillator("0", ", damper: 1"));
  ASSERT_TRUE(a.step());
  EXPECT_EQ(calls, 1);
}

TEST_P(ChangeModel, LocatedEdgesAreThoseOfTheNewLaw) {
  const std::string stop =
                        "{piecewise: [{below: -0.02, polynomial: [-2, 1000], about: -0.02}, "
                        "{polynomial: [0, 100]}]}",
                    early =
                        "{piecewise: [{below: 0.05, polynomial: [5, 1000], about: 0.05}, "
                        "{polynomial: [0, 100]}]}";
  SimulationOptions o = options(0.005);
  o.locate_edges = true;
  Simulation a(oscillator(stop), o);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(a.step());
  a.change_model(oscillator(early));
  SimulationOptions s = o;
  s.state = std::make_shared<const SystemState>(a.state());
  Simulation b(oscillator(early), s);
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(a.step());
    ASSERT_TRUE(b.step());
    EXPECT_NEAR(a.output("z"), b.output("z"), 1e-7) << k;
  }
  EXPECT_GT(a.counters().edges, 0);
}

TEST_P(ChangeModel, OtherStructuresAreRefused) {
  Simulation a(oscillator("100"), options(0.01));
  ASSERT_TRUE(a.step());
  const std::vector<double> before(a.outputs().begin(), a.outputs().end());
  const auto refused = [&](const Model& model, const char* part) {
    EXPECT_EQ(error_of([&] { a.change_model(model); }), "mismatch");
    EXPECT_TRUE(contains(sentences_of([&] { a.change_model(model); }), part));
    EXPECT_TRUE(equal_bits(a.outputs(), before));
  };
  refused(model_of(changing_machine(1.0, 1.0)), "'body'");
  refused(oscillator("100", "", "step: 0.02"), "step");
  refused(oscillator("100", "", "step: 0.01, tolerance: 1e-5"), "tolerance");
  refused(oscillator("100", ", target: {input: F}"), "'s'");
  EXPECT_EQ(error_of([&] { a.change_model(Model()); }), "missing");
  EXPECT_TRUE(a.step());
}

INSTANTIATE_TEST_SUITE_P(Both, ChangeModel,
                         ::testing::Values(Coordinates::relative, Coordinates::absolute),
                         [](const auto& p) {
                           return p.param == Coordinates::relative ? "relative" : "absolute";
                         });

}  // namespace
}  // namespace floatframe::test

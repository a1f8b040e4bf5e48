// Formulas in models: as forces, laws, motions, outputs; against elements with the same law, in
// both formulations, linear systems and statics; what they may refer to.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// Two arms, the second one on the first, with a drive between them.
std::string two_arms(const std::string& rest) {
  return R"(
parameters: {k: 40, c: 3}
inputs: {u: {initial: 0.5}}
bodies:
  upper: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}
  lower: {rigid: {mass: 1, centre_of_mass: [0.9, 0, 0], inertia: [0.001, 0.03, 0.03]}}
joints:
  shoulder: {type: revolute, child: upper, at: [0, 0, 0], axis: y, velocity: 1}
  elbow: {type: revolute, parent: upper, child: lower, at: [0.6, 0, 0], axis: y}
simulation: {step: 0.002, duration: 0.4}
)" + rest;
}
const std::string by_springs = two_arms(R"(
forces:
  drive: {type: joint_spring, joint: elbow, spring: 40, damper: 3, actuator: {input: u}}
  hold: {type: joint_spring, joint: shoulder, spring: 200, damper: 9}
outputs: {a: {joint_position: shoulder}, b: {joint_position: elbow}}
)");
const std::string by_formulas = two_arms(R"(
forces:
  drive:
    type: joint_spring
    joint: elbow
    actuator: {formula: '-k * angle(elbow) - c * rate(elbow) + u'}
  hold:
    type: joint_spring
    joint: shoulder
    actuator: {formula: '-200 * angle(shoulder) - 9 * rate(shoulder)'}
outputs: {a: {joint_position: shoulder}, b: {joint_position: elbow}}
)");

class InFormulas : public ::testing::TestWithParam<Coordinates> {};

TEST_P(InFormulas, ActAsSpringsOfTheSameLaw) {
  const Model springs = model_of(by_springs), formulas = model_of(by_formulas);
  const RunResult a = completed_run(springs, with(springs.simulation, GetParam()));
  const RunResult b = completed_run(formulas, with(formulas.simulation, GetParam()));
  ASSERT_EQ(a.table.data.size(), b.table.data.size());
  for (std::size_t k = 0; k < a.table.data.size(); ++k)
    EXPECT_NEAR(a.table.data[k], b.table.data[k], 1e-10);
}

TEST_P(InFormulas, HaveTheSamePolesAndStatics) {
  const auto resting = [](std::string text) {
    return model_of(text.replace(text.find(", velocity: 1"), 13, ""));
  };
  const Model springs = resting(by_springs), formulas = resting(by_formulas);
  const StaticsResult at_rest = statics(springs), same = statics(formulas);
  EXPECT_NEAR(at_rest.bodies[1].roll_pitch_yaw[1], same.bodies[1].roll_pitch_yaw[1], 1e-9);
  const LinearSystem a = linear_system(springs, {.coordinates = GetParam()});
  const LinearSystem b = linear_system(formulas, {.coordinates = GetParam()});
  ASSERT_EQ(a.A.rows(), b.A.rows());
  EXPECT_LT((a.A - b.A).cwiseAbs().maxCoeff(), 1e-8 * a.A.cwiseAbs().maxCoeff());
}

// The whole slope is in the tangent: also where the force is far from what it depends on.
TEST_P(InFormulas, ConvergeQuadratically) {
  const Model model = model_of(two_arms(R"(
forces:
  far:
    type: joint_spring
    joint: shoulder
    actuator: {formula: '-3e5 * angle(elbow) - 2e5 * angle(shoulder) - 2e3 * rate(elbow) - 2e3 *
      rate(shoulder)'}
  hold: {type: joint_spring, joint: elbow, spring: 2e5, damper: 2e3}
)"));
  SimulationOptions o{.coordinates = GetParam()};
  Simulation s(model, o);
  for (int k = 0; k < 40; ++k) {
    const StepReport report = s.step();
    ASSERT_TRUE(report) << s.failure();
    EXPECT_LE(report.iterations, 4);
  }
}

TEST_P(InFormulas, MotionsHaveExactDerivatives) {
  const auto run = [&](const std::string& motion) {
    const Model model = model_of(R"(
bodies: {arm: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}}
joints: {hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: y, motion: )" +
                                 motion + R"(}}
outputs:
  q: {joint_position: hinge}
  m: {motion_force: hinge}
  a: {angular_acceleration: arm, axis: y}
simulation: {step: 0.001, duration: 0.2}
)");
    return completed_run(model, with(model.simulation, GetParam())).table.data;
  };
  const std::vector<double> a =
      run("{sine: {amplitude: 0.4, frequency: 2, phase: 0.3}, polynomial: [0, 1, 2]}");
  const std::vector<double> b = run("{formula: '0.4 * sin(4 * pi * t + 0.3) + t + 2 * t ^ 2'}");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9 * (1 + std::abs(a[k])));
}

TEST_P(InFormulas, AllocateNothing) {
  const Model model = model_of(by_formulas);
  Simulation s(model, {.coordinates = GetParam()});
  s.step();
  const AllocationScope scope;
  for (int k = 0; k < 20; ++k) s.step();
  EXPECT_EQ(scope.count(), 0u);
}

TEST_P(InFormulas, LawsAreThoseOfPrograms) {
  const Model formula = model_of(R"(
bodies: {ball: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {fall: {type: prismatic, child: ball, at: [0, 0, 0], axis: z, position: 0.5}}
forces:
  contact: {type: force_law, joint: fall, law: {formula: 'if(x < 0, -1e6 * (-x) ^ 1.5, 0)'}}
outputs: {z: {joint_position: fall}}
simulation: {step: 0.001, duration: 0.7}
)");
  ModelDescription d = description_of(R"(
bodies: {ball: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {fall: {type: prismatic, child: ball, at: [0, 0, 0], axis: z, position: 0.5}}
outputs: {z: {joint_position: fall}}
simulation: {step: 0.001, duration: 0.7}
)");
  ForceLaw law;
  law.joint = "fall";
  law.law = ForceFunction([](double x, double, double) -> ForceLawValue {
    if (!(x < 0.0)) return {0.0, 0.0, 0.0};
    return {-1e6 * std::pow(-x, 1.5), 1.5e6 * std::sqrt(-x), 0.0};
  });
  d.forces.push_back({"contact", law, {}});
  const Model program = build_model(d);
  const auto a = completed_run(formula, with(formula.simulation, GetParam())).table.data;
  const auto b = completed_run(program, with(program.simulation, GetParam())).table.data;
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, InFormulas, ::testing::ValuesIn(both_coordinates));

TEST(FormulaOutputs, AreValuesOfOtherOutputs) {
  const Model model = model_of(two_arms(R"(
measures: {tip: {position: {body: lower, at: [1.2, 0, 0]}}}
outputs:
  b: {joint_position: elbow, unit: deg}
  acc: {acceleration: lower, axis: z}
  z: {position: {body: lower, at: [1.2, 0, 0]}, axis: z}
  sum: {formula: '2 * acc + tip.z ^ 2 + b + angle(shoulder) + u * t', unit: bar}
  shoulder: {joint_position: shoulder}
)"));
  EXPECT_EQ(model.outputs[3].unit, "bar");
  const std::vector<double> rows = completed_run(model, model.simulation).table.data;
  for (std::size_t k = 0; k + 5 < rows.size(); k += 6)
    EXPECT_NEAR(rows[k + 4],
                2 * rows[k + 2] + rows[k + 3] * rows[k + 3] + rows[k + 1] * std::numbers::pi / 180 +
                    rows[k + 5] + 0.5 * rows[k],
                1e-12 * (1 + std::abs(rows[k + 4])));
}

// Accelerations are those of the step before: first order.
TEST(FormulaSamples, AreThoseOfTheLastStep) {
  const auto tip = [](double step) {
    const Model model = model_of(two_arms(R"(
measures: {acc: {angular_acceleration: lower, axis: y}}
forces:
  hold: {type: joint_spring, joint: shoulder, spring: 200, damper: 9}
  add: {type: torque, body: lower, direction: [0, 1, 0], magnitude: {formula: '-0.02 * acc'}}
outputs: {b: {joint_position: elbow}}
)"));
    SimulationDescription o = model.simulation;
    o.step = step;
    return completed_run(model, o).table.data.back();
  };
  const Model exact = model_of(two_arms(R"(
forces: {hold: {type: joint_spring, joint: shoulder, spring: 200, damper: 9}}
outputs: {b: {joint_position: elbow}}
)"));
  // An inertia of 0.02 kg m2 more.
  ModelDescription d = description_of(two_arms(R"(
forces: {hold: {type: joint_spring, joint: shoulder, spring: 200, damper: 9}}
outputs: {b: {joint_position: elbow}}
)"));
  Mat3& J = std::get<RigidDescription>(d.bodies[1].kind).J_C;
  J(0, 0) += 0.02;
  J(1, 1) += 0.02;
  SimulationDescription o = exact.simulation;
  o.step = 1e-4;
  const double with_inertia = completed_run(build_model(d), o).table.data.back();
  const double coarse = tip(2e-3) - with_inertia, fine = tip(1e-3) - with_inertia;
  EXPECT_NEAR(coarse / fine, 2.0, 0.4);
  EXPECT_LT(std::abs(fine), 0.02);
}

TEST(FormulaTurns, AreCounted) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies: {disc: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.02, 0.02, 0.02]}}}
joints: {spin: {type: revolute, child: disc, at: [0, 0, 0], axis: z, position: 20}}
forces: {m: {type: joint_spring, joint: spin, actuator: {formula: '-2 * angle(spin)'}}}
outputs: {q: {joint_position: spin}, f: {force: m}}
simulation: {step: 0.001, duration: 0.7}
)");
  for (const Coordinates c : both_coordinates) {
    const auto rows = completed_run(model, with(model.simulation, c)).table.data;
    for (std::size_t k = 0; k + 2 < rows.size(); k += 3)
      EXPECT_NEAR(std::abs(rows[k + 2]), std::abs(2 * rows[k + 1]), 1e-9);
    EXPECT_NEAR(rows[rows.size() - 2], 20 * std::cos(7.0), 0.4);  // 0.2 rad per step
  }
}

TEST(FormulaFailures, NameFormulaAndTime) {
  const Model model = model_of(two_arms(R"(
forces:
  m: {type: torque, body: lower, direction: y, magnitude: {formula: '1 / (0.01 - t) ^ 0.5'}}
)"));
  Simulation s(model);
  std::string failure;
  for (int k = 0; k < 20 && failure.empty(); ++k)
    if (!s.step()) failure = s.failure();
  EXPECT_NE(failure.find("is not defined for"), std::string::npos) << failure;
}

std::string refused(const std::string& formula) {
  return error_of([&] {
    model_of(
        two_arms("forces: {m: {type: torque, body: lower, direction: [0, 1, 0], magnitude: "
                 "{formula: \"" +
                 formula + "\"}}}\n"));
  });
}

TEST(FormulaErrors, HaveACode) {
  const auto has = [](const std::string& formula, const std::string& code) {
    const std::string error = refused(formula);
    EXPECT_TRUE(error.ends_with(": " + code)) << formula << ": " << error;
  };
  has("2 * kk", "not_found");
  has("angle(elbw)", "not_found");
  has("angle(elbow, 2)", "out_of_range");
  has("position(lower)", "wrong_value");
  has("speed(lower)", "not_found");
  has("force(lower)", "not_found");
  has("kinetic_energy(lower, 2)", "wrong_count");
  has("stress(lower)", "unsupported");
  has("(1 + 2", "wrong_value");
}

}  // namespace
}  // namespace floatframe::test

// Starts with nothing left to move: all is driven or welded, whatever the mass matrix; and what the
// mass matrix alone does not decide.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Start accelerations in the absolute formulation.
struct AbsoluteStart {
  explicit AbsoluteStart(const Model& model) : f(model, model.simulation.inertia) {
    RelativeFormulation tree(model, model.simulation.inertia);
    const State start = relative_start(tree, Start::given);
    f.start_from(tree, start.q, start.v, state.q, state.v);
    start_accelerations(f, state, default_penalty_mass(model, Coordinates::absolute));
  }
  /// Force and torque of the joint's constraints on its child, about the child's marker.
  Vec6 reaction(int joint) const {
    Vec6 sum = Vec6::Zero();
    for (std::size_t k = 0; k < f.constraint_set().parts().size(); ++k) {
      const ConstraintPart& p = f.constraint_set().parts()[k];
      ConstraintRow rows[3];
      evaluate_constraint(p, f.marker(p.a), f.marker(p.b), 0.0, rows);
      if (p.owner.joint != joint) continue;
      for (int r = 0; r < p.rows(); ++r) {
        const double lambda = state.lambda[f.constraint_set().offset(k) + r];
        sum.head<3>() -= lambda * rows[r].gradient.b.F;
        sum.tail<3>() -= lambda * rows[r].gradient.b.T;
      }
    }
    return sum;
  }
  AbsoluteFormulation f;
  State state;
};

TEST(NothingFree, PointMassOnADrivenHinge) {
  const Model model = model_of(R"(
bodies: {ball: {position: [1, 0, 0], rigid: {mass: 2}}}
joints:
  arm: {type: revolute, child: ball, at: [0, 0, 0], axis: y, motion: {polynomial: [0.3, 2, 1.5]}}
outputs:
  x: {position: ball, axis: x}
  a: {acceleration: ball}
simulation: {step: 0.001, duration: 0.2}
)");
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, c);
    for (const std::size_t row : {std::size_t{0}, r.table.rows() - 1}) {
      const double t = r.table.at(row, 0), angle = 0.3 + 2 * t + 1.5 * t * t, w = 2 + 3 * t;
      const double s = std::sin(angle), k = std::cos(angle);
      EXPECT_NEAR(r.table.at(row, column(r.table, "x")), k, 1e-8) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.x")), -s * 3.0 - k * w * w, 1e-5) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.z")), -k * 3.0 + s * w * w, 1e-5) << c.name();
    }
  }
  // m (a - g) at the start, and the moment of it about the hinge: 2 kg x 1 m x 3 rad/s2 and weight.
  const AbsoluteStart start(model);
  const double s = std::sin(0.3), k = std::cos(0.3);
  const Vec6 reaction = start.reaction(0);
  EXPECT_NEAR(reaction[0], 2.0 * (-s * 3.0 - k * 4.0), 1e-9);
  EXPECT_NEAR(reaction[1], 0.0, 1e-9);
  EXPECT_NEAR(reaction[2], 2.0 * (-k * 3.0 + s * 4.0 + 9.81), 1e-9);
  EXPECT_NEAR(reaction[4], 2.0 * 3.0 - 2.0 * 9.81 * k, 1e-9);
}

TEST(NothingFree, DrivenParallelCranksWithoutSpinInertia) {
  const Model model = model_of(R"(
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1],
      inertia: [0, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 1, centre_of_mass: [0.25, 0, 0.2],
      inertia: [0, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0, 0.1],
      inertia: [0, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y, motion: {polynomial: [0, 2, 1]}}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.2], axis: y}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y}
outputs: {a: {acceleration: coupler}}
simulation: {step: 0.001, duration: 0.1}
)");
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, c);
    const std::size_t last = r.table.rows() - 1;
    for (const std::size_t row : {std::size_t{0}, last}) {
      const double t = r.table.at(row, 0), angle = 2 * t + t * t, w = 2 + 2 * t;
      const double s = 0.2 * std::sin(angle), k = 0.2 * std::cos(angle);
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.x")), k * 2.0 - s * w * w, 1e-5) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.z")), -s * 2.0 - k * w * w, 1e-5) << c.name();
    }
  }
}

TEST(NothingFree, AccelerationsOfManyMillions) {
  const Model model = model_of(R"(
bodies:
  lever: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}
joints:
  hinge: {type: revolute, child: lever, at: [0, 0, 0], axis: y, motion: {polynomial: [0, 0, 1e7]}}
outputs: {end: {acceleration: {body: lever, at: [0.6, 0, 0]}}, angle: {joint_position: hinge}}
simulation: {step: 1e-5, duration: 1e-3}
)");
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, c);
    EXPECT_NEAR(r.table.at(0, column(r.table, "end.z")), -0.6 * 2e7, 1.0) << c.name();
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, column(r.table, "angle")), 10.0, 1e-6) << c.name();
  }
  const AbsoluteStart start(model);
  const Vec6 reaction = start.reaction(0);
  EXPECT_NEAR(reaction[2], 2.0 * (9.81 - 0.3 * 2e7), 1e-3);
  EXPECT_NEAR(reaction[4], (0.06 + 2.0 * 0.09) * 2e7 - 2.0 * 9.81 * 0.3, 1e-2);
}

TEST(NothingFree, EverythingWelded) {
  const Model model = model_of(R"(
bodies:
  stone: {position: [1, 0, 0], rigid: {mass: 2}}
  hat: {position: [1, 0, 1], rigid: {mass: 3}}
joints:
  foot: {type: weld, child: stone, at: [0, 0, 0]}
  glue: {type: weld, parent: stone, child: hat, at: [1, 0, 1]}
outputs: {z: {position: hat, axis: z}}
simulation: {step: 0.01, duration: 0.1}
)");
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, c);
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 1.0, 1e-12) << c.name();
    SimulationDescription s = with(model.simulation, c, 0.01, 0.1);
    s.start = Start::equilibrium;
    EXPECT_EQ(run(model, s).summary.status, "completed") << c.name();
  }
  EXPECT_EQ(check(model).degrees_of_freedom, 0);
  const StaticsResult statics_result = statics(model);
  EXPECT_NEAR(statics_result.joints[0].force.z(), 5.0 * 9.81, 1e-9);
  EXPECT_NEAR(statics_result.joints[1].force.z(), 3.0 * 9.81, 1e-9);
  EXPECT_NEAR(AbsoluteStart(model).reaction(0)[2], 5.0 * 9.81, 1e-9);
}

// Natural coordinates have no mass where thin bars are held by constraints: dense linear algebra at
// the start would take as long as a hundred steps.
TEST(DenseStart, IsForDirectionsWithoutMassOnly) {
  const Model model = build_model(read_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml"));
  AbsoluteStart start(model);
  const VecX possible = possible_masses(start.f, start.state);
  start.f.positions(start.state.t, start.state.q);
  start.f.velocities(start.state.v);
  start.f.dynamics();
  const VecX diagonal = mass_diagonal(start.f, start.state);
  EXPECT_LT(diagonal.minCoeff(), 1e-9 * diagonal.maxCoeff());
  EXPECT_FALSE(may_lack_mass(start.f, diagonal, possible,
                             default_penalty_mass(model, Coordinates::absolute)));
}

}  // namespace
}  // namespace floatframe::test

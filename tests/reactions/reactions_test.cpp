// Reactions of runs: a pendulum by its closed form, the balance of every body and absolute =
// relative on random mechanisms, redundant joints, rods, motors, no allocation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/reactions/reaction_solver.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "floatframe/tangents/linearization.hpp"
#include "support/allocation_counter.hpp"
#include "support/body_balance.hpp"
#include "support/descriptions.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/random_count.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {
namespace {

RunResult reaction_run(const Model& model, Coordinates coordinates) {
  const SimulationDescription o = with(model.simulation, coordinates);
  const RunResult r = completed_run(model, o);
  return r;
}

// A rod of mass m and inertia I about its centre at the distance l from the hinge, at the angle p
// below the x axis, rate w, moves about y: (I + m l^2) wdot = m g l cos p.
TEST(Reactions, OfAPendulumAreThoseOfItsClosedForm) {
  const Model model = model_of(R"(
bodies: {bob: {position: [2, 0, 0], rigid: {mass: 3, inertia: [0.01, 0.4, 0.4]}}}
joints: {hinge: {type: revolute, child: bob, at: [0, 0, 0], axis: y, position: 0.3, velocity: 1.2}}
outputs:
  p: {joint_position: hinge}
  w: {joint_velocity: hinge}
  wdot: {angular_acceleration: bob, axis: y}
  F: {joint_force: hinge}
  T: {joint_torque: hinge}
  along: {joint_force: hinge, in: {body: bob}, axis: x}
  across: {joint_force: hinge, in: {body: bob}, axis: z}
  in_child: {joint_force: hinge, in: child, axis: z}
  in_parent: {joint_force: hinge, in: parent, axis: z}
  centre: {joint_torque: hinge, about: bob, axis: y}
  kinetic: {kinetic_energy: bob}
  potential: {potential_energy: bob}
simulation: {step: 0.001, duration: 0.2, output_interval: 0.02}
)");
  const double m = 3.0, I = 0.4, l = 2.0, g = 9.81;
  for (const Coordinates c : both_coordinates) {
    const ResultTable t = reaction_run(model, c).table;
    ASSERT_EQ(t.rows(), 11u);
    for (std::size_t i = 0; i < t.rows(); ++i) {
      const double p = entry(t, i, "p"), w = entry(t, i, "w"), tol = 1e-9;
      const double wdot = m * g * l * std::cos(p) / (I + m * l * l);
      const double along = -m * l * w * w - m * g * std::sin(p);  // on the rod, outwards
      const double across = -m * l * wdot + m * g * std::cos(p);  // its own z axis
      EXPECT_NEAR(entry(t, i, "wdot"), wdot, tol);
      EXPECT_NEAR(entry(t, i, "along"), along, 60 * tol);
      EXPECT_NEAR(entry(t, i, "across"), across, 60 * tol);
      EXPECT_NEAR(entry(t, i, "F.x"), along * std::cos(p) + across * std::sin(p), 60 * tol);
      EXPECT_NEAR(entry(t, i, "F.z"), -along * std::sin(p) + across * std::cos(p), 60 * tol);
      EXPECT_NEAR(entry(t, i, "F.y"), 0.0, tol);
      for (const char* axis : {"T.x", "T.y", "T.z"})
        EXPECT_NEAR(entry(t, i, axis), 0.0, 60 * tol) << axis;
      // Joint frames: z along the axis.
      EXPECT_NEAR(entry(t, i, "in_child"), 0.0, 60 * tol);
      EXPECT_NEAR(entry(t, i, "in_parent"), 0.0, 60 * tol);
      // The moment of the force about the centre turns the rod.
      EXPECT_NEAR(entry(t, i, "centre"), I * wdot, 60 * tol);
      EXPECT_NEAR(entry(t, i, "kinetic"), 0.5 * (I + m * l * l) * w * w, 60 * tol);
      EXPECT_NEAR(entry(t, i, "potential"), -m * g * l * std::sin(p), 60 * tol);
    }
  }
}

// Slides driven by motions, a rod that carries a weight: forces that statics or one formula gives.
TEST(Reactions, OfMotorsAndRods) {
  const Model model = model_of(R"(
bodies:
  sled: {position: [0, 0, 0], rigid: {mass: 4, inertia: [1, 1, 1]}}
  wheel: {position: [0, 3, 0], rigid: {mass: 1, inertia: [1, 1, 0.5]}}
  weight: {position: [1, 0, -2], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  slide: {type: prismatic, child: sled, at: [0, 0, 0], axis: x,
          motion: {piecewise: [{polynomial: [0, 0.3, 0, 2]}]}}
  drive: {type: revolute, child: wheel, at: [0, 3, 0], axis: z,
          motion: {piecewise: [{polynomial: [0, 1, 1.5]}]}}
  guide: {type: prismatic, child: weight, at: [1, 0, -2], axis: z}
rods: {tie: {from: {body: ground, at: [1, 0, 0]}, to: {body: weight, at: [1, 0, -2]}}}
outputs:
  push: {motion_force: slide}
  push_power: {motion_power: slide}
  turn: {motion_force: drive}
  turn_power: {motion_power: drive}
  slide: {joint_force: slide}
  tie: {rod_force: tie}
  hang: {joint_force: {rod: tie}}
  moment: {joint_torque: {rod: tie}, about: {body: ground, at: [0, 0, 0]}, axis: y}
simulation: {step: 0.01, duration: 0.3, output_interval: 0.1}
)");
  for (const Coordinates c : both_coordinates) {
    const ResultTable t = reaction_run(model, c).table;
    for (std::size_t i = 0; i < t.rows(); ++i) {
      const double time = t.at(i, 0), tol = 1e-7;
      EXPECT_NEAR(entry(t, i, "push"), 4 * 12 * time, tol);
      EXPECT_NEAR(entry(t, i, "push_power"), 4 * 12 * time * (0.3 + 6 * time * time), tol);
      EXPECT_NEAR(entry(t, i, "turn"), 0.5 * 3, tol);
      EXPECT_NEAR(entry(t, i, "turn_power"), 1.5 * (1 + 3 * time), tol);
      EXPECT_NEAR(entry(t, i, "slide.x"), 4 * 12 * time, tol);
      EXPECT_NEAR(entry(t, i, "slide.z"), 4 * 9.81, tol);
      EXPECT_NEAR(entry(t, i, "tie"), 2 * 9.81, tol);
      EXPECT_NEAR(entry(t, i, "hang.z"), 2 * 9.81, tol);
      EXPECT_NEAR(entry(t, i, "hang.x"), 0.0, tol);
      EXPECT_NEAR(entry(t, i, "moment"), -2 * 9.81, tol);
    }
  }
}

/// Of one formulation at the start of a mechanism.
template <class F>
struct Solved {
  InitialisedModel started;
  ReactionSolver solver;
  explicit Solved(const Model& model, const SimulationDescription& o, InertiaMethod method)
      : started(model, with(o, method), F::coordinates_of),
        solver(F::coordinates_of, started.model(), method, started.state(),
               {started.step_options().penalty_mass, o.step, !started.report().redundant.empty()}) {
    solver.solve(started.state(), started.formulation().inputs(),
                 started.formulation().spring_angles());
  }
  static SimulationDescription with(SimulationDescription o, InertiaMethod method) {
    o.inertia = method;
    return o;
  }
};

TEST(Reactions, BalanceEveryBodyOfRandomMechanismsAndAreThoseOfEitherFormulation) {
  int compared = 0, weightless = 0, redundant = 0, rods = 0, driven = 0;
  double worst_balance = 0.0, worst_difference = 0.0;
  const int count = random_count();
  for (int seed = 1; seed <= count; ++seed) {
    const Mechanism mechanism = random_mechanism(static_cast<unsigned>(seed));
    try {
      const Model model = build_model(mechanism.description);
      if (fastest_rate(model, mechanism.relative) == 0.0) continue;
      Solved<RelativeFormulation> r(model, model.simulation, mechanism.relative);
      Solved<AbsoluteFormulation> a(model, model.simulation, mechanism.absolute);
      const BodyBalance br =
          body_balance(r.solver.formulation(), r.solver.reactions(), mechanism.relative);
      const BodyBalance ba =
          body_balance(a.solver.formulation(), a.solver.reactions(), mechanism.absolute);
      // Before the first step nothing need balance the forces on a freedom without mass.
      if (r.solver.lacks_mass() && r.solver.force_error() > 1e-6 * br.largest_force) {
        ++weightless;
        continue;
      }
      EXPECT_LT(br.error, 1e-8) << "relative " << seed << " " << br.body;
      EXPECT_LT(ba.error, 1e-8) << "absolute " << seed << " " << ba.body;
      worst_balance = std::max({worst_balance, br.error, ba.error});
      ++compared;
      redundant += r.started.report().redundant.empty() ? 0 : 1;
      rods += std::ranges::any_of(model.elements, &Element::links) ? 1 : 0;
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        driven += model.joints[j].motion >= 0 ? 1 : 0;
        const Reactions::Wrench &x = r.solver.reactions().joints[j],
                                &y = a.solver.reactions().joints[j];
        const double length = model.bodies[model.joints[j].child].length;
        const double difference =
            std::max((x.force - y.force).norm(), (x.torque - y.torque).norm() / length) /
            br.largest_force;
        EXPECT_LT(difference, 1e-6) << seed << " " << model.joints[j].name;
        worst_difference = std::max(worst_difference, difference);
      }
    } catch (const std::exception&) {
      continue;  // refused: random_mechanisms_test says when
    }
  }
  RecordProperty("balance", std::to_string(worst_balance));
  RecordProperty("difference", std::to_string(worst_difference));
  EXPECT_GT(compared, 6 * count / 10);
  EXPECT_LT(weightless, 5 + count / 40);
  EXPECT_GT(redundant, count / 20);
  EXPECT_GT(rods, count / 100);
  EXPECT_GT(driven, count / 20);
}

// A body welded at two places hangs half from each; the weight of both together is unique.
TEST(Reactions, ThatRedundantJointsLeaveOpenAreOfLeastNormAndNamed) {
  const Model model = model_of(R"(
bodies: {block: {position: [1, 0, 0], rigid: {mass: 10, inertia: [1, 1, 1]}}}
joints:
  weld_1: {type: weld, child: block, at: [0, 0, 0]}
  weld_2: {type: weld, child: block, at: [2, 0, 0]}
outputs:
  one: {joint_force: weld_1, axis: z}
  two: {joint_force: weld_2, axis: z}
  one_torque: {joint_torque: weld_1, axis: y}
simulation: {step: 0.01, duration: 0.02}
)");
  for (const Coordinates c : both_coordinates) {
    const RunResult r = reaction_run(model, c);
    for (std::size_t i = 0; i < r.table.rows(); ++i) {
      EXPECT_NEAR(entry(r.table, i, "one"), 49.05, 1e-7);
      EXPECT_NEAR(entry(r.table, i, "two"), 49.05, 1e-7);
      EXPECT_NEAR(entry(r.table, i, "one_torque"), 0.0, 1e-7);
    }
    ASSERT_EQ(r.summary.start.notes.size(), 2u);
    EXPECT_EQ(r.summary.start.notes[1],
              "outputs 'one', 'two' and 'one_torque' are not unique, since constraints are "
              "redundant: of the reactions that are possible those of least norm are given");
  }
}

// The numbers of `statics`, at the same equilibrium: a door on two hinges.
TEST(Reactions, AtRestAreThoseOfStatics) {
  const Model model = model_of(R"(
bodies: {door: {rigid: {mass: 20, centre_of_mass: [0.5, 0, 1], inertia: [1, 1, 1]}}}
joints:
  low: {type: revolute, child: door, at: [0, 0, 0], axis: z}
  high: {type: revolute, child: door, at: [0, 0, 2], axis: z}
outputs:
  low: {joint_force: low}
  low_torque: {joint_torque: low}
  high: {joint_force: high}
  hinge: {joint_torque: high, axis: z}
simulation: {step: 0.01, duration: 0}
)");
  const StaticsResult s = statics(model);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = reaction_run(model, c);
    const char* const axes[] = {".x", ".y", ".z"};
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(entry(r.table, 0, std::string("low") + axes[k]), s.joints[0].force[k], 1e-7);
      EXPECT_NEAR(entry(r.table, 0, std::string("high") + axes[k]), s.joints[1].force[k], 1e-7);
      EXPECT_NEAR(entry(r.table, 0, std::string("low_torque") + axes[k]), s.joints[0].torque[k],
                  1e-7);
    }
    // The torque about the line of the hinges is zero, whatever the shares.
    ASSERT_EQ(r.summary.start.notes.size(), 2u);
    EXPECT_EQ(r.summary.start.notes[1].find("'hinge'"), std::string::npos);
    EXPECT_NE(r.summary.start.notes[1].find("'high.z'"), std::string::npos);
  }
}

/// A four-bar linkage drawn in space: its hinges are redundant.
const char* const spatial_linkage = R"(
bodies:
  left: {position: [0, 0, 0.5], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  top: {position: [1, 0, 1], rigid: {mass: 2, inertia: [0.1, 0.2, 0.2]}}
  right: {position: [2, 0, 0.5], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  a: {type: revolute, child: left, at: [0, 0, 0], axis: y, velocity: 1}
  b: {type: revolute, parent: left, child: top, at: [0, 0, 1], axis: y}
  c: {type: revolute, parent: right, child: top, at: [2, 0, 1], axis: y}
  d: {type: revolute, child: right, at: [2.2, 0, -0.3], axis: y}
outputs:
  b: {joint_force: b}
  c: {joint_torque: c, about: top, in: child}
simulation: {step: 0.002, duration: 1}
)";

void expect_samples_without_allocation(Coordinates coordinates) {
  const Model model = model_of(spatial_linkage);
  Stepper steps(model, with(model.simulation, coordinates));
  std::vector<double> row(1 + model.outputs.size()), again(row.size());
  steps.sample(row.data());
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(steps.advance());
    const AllocationScope counter;
    steps.sample(row.data());
    EXPECT_EQ(counter.count(), 0u);
    steps.sample(again.data());
    EXPECT_EQ(row, again);
  }
}

TEST(Reactions, AreSampledWithoutAllocation) {
  for (const Coordinates c : both_coordinates) expect_samples_without_allocation(c);
}

// W dv = -Phi_q^T i with the change dv of the velocities that a step with projections makes after
// one
// without them; W = M, since nothing is elastic.
template <class F>
void expect_impulses_to_be_the_change_of_momentum() {
  const Model model = model_of(spatial_linkage);
  InitialisedModel started(model, model.simulation, F::coordinates_of);
  F& f = static_cast<F&>(started.formulation());
  StepOptions options = started.step_options();
  AugmentedLagrangian<F> projecting(f, options);
  projecting.keep_impulses();
  options.max_projections = 0;
  AugmentedLagrangian<F> plain(f, options);
  State projected = started.state(), rough = started.state();
  // Several steps: the first errors are round-off.
  for (int k = 0; k < 20; ++k) {
    rough = projected;
    plain.set_tangent_reuse(projecting.tangent_reuse());
    ASSERT_TRUE(plain.attempt(rough, 2e-3).accepted());
    ASSERT_TRUE(projecting.attempt(projected, 2e-3).accepted());
    ASSERT_TRUE(rough.q == projected.q);
  }
  const VecX none = VecX::Zero(f.constraints());
  const VecX r0 = residual_at(f, projected.t, projected.q, projected.v, none);
  const VecX dv = projected.v - rough.v;
  const VecX momentum = mass_times(f, dv / dv.norm(), 1.0, r0, none) * dv.norm();
  VecX given(f.velocities());
  f.constraint_forces(projecting.impulses(), given);
  ASSERT_GT(momentum.norm(), 1e-9);
  // What a formulation holds exactly, a body's own constraints, takes the rest.
  VecX rest = momentum + given, own = none;
  f.balance(own, rest);
  EXPECT_LT(rest.norm(), 1e-4 * momentum.norm());
}

TEST(Reactions, ImpulsesOfTheProjectionsAreTheChangeOfMomentum) {
  expect_impulses_to_be_the_change_of_momentum<RelativeFormulation>();
  expect_impulses_to_be_the_change_of_momentum<AbsoluteFormulation>();
}

// As outputs: none before the first step, then those of the cut joints or of all.
TEST(Reactions, OfTheProjectionsAreASeparateOutput) {
  ModelDescription d = description_of(spatial_linkage);
  d.outputs.clear();
  for (const JointDescription& j : d.joints)
    d.outputs.push_back(make_output(j.name, OutputType::projection_impulse, j.name));
  d.simulation.duration = 0.2;
  for (const Coordinates c : both_coordinates) {
    const ResultTable t = reaction_run(build_model(d), c).table;
    std::size_t moved = 0;
    for (std::size_t column = 1; column < t.columns.size(); ++column) {
      EXPECT_EQ(t.at(0, column), 0.0);
      double largest = 0.0;
      for (std::size_t i = 1; i < t.rows(); ++i)
        largest = std::max(largest, std::abs(t.at(i, column)));
      moved += largest > 0.0 ? 1 : 0;
      EXPECT_LT(largest, 1e-2);
    }
    EXPECT_EQ(moved, c == Coordinates::relative ? 1u : 4u);
  }
}

// Whether reactions are looked at or not, the steps are the same.
TEST(Reactions, LeaveTheStepsAlone) {
  ModelDescription d = description_of(spatial_linkage);
  for (const Coordinates c : both_coordinates) {
    d.simulation.coordinates = c;
    d.simulation.duration = 0.1;
    const Model with = build_model(d);
    ModelDescription plain = d;
    const OutputDescription o = make_output("x", place_on("top"), 0);
    plain.outputs = {o};
    ModelDescription more = d;
    more.outputs.push_back(o);
    const ResultTable a = reaction_run(build_model(plain), c).table,
                      b = reaction_run(build_model(more), c).table;
    ASSERT_EQ(a.rows(), b.rows());
    for (std::size_t i = 0; i < a.rows(); ++i) EXPECT_EQ(entry(a, i, "x"), entry(b, i, "x"));
  }
}

}  // namespace
}  // namespace floatframe::test

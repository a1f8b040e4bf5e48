// Redundant constraints: named, and the reactions that they leave open marked and of least norm.
#include "floatframe/loops/redundancy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::vector<std::string> texts(const std::vector<RedundantDirection>& redundant) {
  std::vector<std::string> out;
  for (const RedundantDirection& r : redundant) out.push_back(r.owner + ": " + r.direction);
  return out;
}

const char* const welded_twice = R"(
bodies: {block: {position: [1, 0, 0], rigid: {mass: 10, inertia: [1, 1, 1]}}}
joints:
  weld_1: {type: weld, child: block, at: [0, 0, 0]}
  weld_2: {type: weld, child: block, at: [2, 0, 0]}
simulation: {step: 0.01, duration: 0.05}
)";

TEST(Redundancy, BodyWeldedTwiceHangsHalfFromEach) {
  const Model model = model_of(welded_twice);
  const StaticsResult s = statics(model);
  for (const StaticsJoint& j : s.joints) {
    EXPECT_NEAR(j.force.z(), 49.05, 1e-9) << j.name;
    EXPECT_NEAR(j.force.x(), 0.0, 1e-9) << j.name;
    EXPECT_FALSE(j.unique()) << j.name;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(j.unique_force[i] || j.unique_torque[i]);
  }
  // The least torques that go with it: none.
  EXPECT_NEAR(s.joints[0].torque.norm(), 0.0, 1e-9);
  EXPECT_EQ(texts(s.redundant),
            (std::vector<std::string>{
                "joint 'weld_2': translation along x", "joint 'weld_2': translation along y",
                "joint 'weld_2': translation along z", "joint 'weld_2': rotation about y",
                "joint 'weld_2': rotation about x", "joint 'weld_2': rotation about z"}));
}

TEST(Redundancy, IsNamedByCheckAndRun) {
  const Model model = model_of(welded_twice);
  const ModelCounts c = check(model);
  EXPECT_EQ(c.redundant_constraints, 6);
  EXPECT_EQ(c.start.redundant.size(), 6u);
  for (const Coordinates coordinates : both_coordinates) {
    const SimulationDescription o = with(model.simulation, coordinates);
    const RunSummary s = run(model, o).summary;
    EXPECT_EQ(s.status, "completed");
    EXPECT_EQ(s.start.redundant.size(), 6u);
    ASSERT_EQ(s.start.notes.size(), 1u);
    EXPECT_EQ(s.start.notes[0].find("6 constraints are redundant (joint 'weld_2': translation"), 0u)
        << s.start.notes[0];
  }
}

// Two hinges in a line: five of the ten are redundant; torques about the line are unique (zero),
// and so is nothing that the other hinge might carry too.
TEST(Redundancy, UniqueComponentsAreKnown) {
  const Model model = model_of(R"(
bodies: {door: {position: [0, 0, 0], rigid: {mass: 20, centre_of_mass: [0.5, 0, 1],
    inertia: [1, 1, 1]}}}
joints:
  low: {type: revolute, child: door, at: [0, 0, 0], axis: z}
  high: {type: revolute, child: door, at: [0, 0, 2], axis: z}
)");
  const StaticsResult s = statics(model);
  for (const StaticsJoint& j : s.joints) {
    EXPECT_EQ(j.unique_force, (std::array<bool, 3>{false, false, false})) << j.name;
    EXPECT_EQ(j.unique_torque, (std::array<bool, 3>{false, false, true})) << j.name;
    EXPECT_NEAR(j.force.z(), 98.1, 1e-9) << j.name;
  }
  // Whatever the shares, they balance the weight: forces and moments about the origin.
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t k = 0; k < 2; ++k) {
    force += s.joints[k].force;
    moment += s.joints[k].torque + Vec3(0, 0, k == 0 ? 0.0 : 2.0).cross(s.joints[k].force);
  }
  const Vec3 centre =
      s.bodies[0].position + Vec3(0.5 * std::cos(s.bodies[0].roll_pitch_yaw.z()),
                                  0.5 * std::sin(s.bodies[0].roll_pitch_yaw.z()), 1);
  EXPECT_NEAR((force - Vec3(0, 0, 196.2)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((moment - centre.cross(Vec3(0, 0, 196.2))).norm(), 0.0, 1e-9);
  EXPECT_EQ(s.redundant.size(), 5u);
}

// A planar four-bar linkage drawn in space: three redundant constraints, and the forces in the
// plane are unique.
TEST(Redundancy, PlanarForcesOfAFourBarAreUnique) {
  const Model model = model_of(R"(
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1],
      inertia: [.001, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 2, centre_of_mass: [0.25, 0, 0.3],
      inertia: [.001, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 3, centre_of_mass: [0.5, 0, 0.2],
      inertia: [.001, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.4], axis: y}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y}
)");
  const StaticsResult s = statics(model);
  EXPECT_EQ(s.redundant.size(), 3u);
  for (const StaticsJoint& j : s.joints) {
    EXPECT_EQ(j.unique_force, (std::array<bool, 3>{true, false, true})) << j.name;
    EXPECT_EQ(j.unique_torque, (std::array<bool, 3>{false, true, false})) << j.name;
    EXPECT_NEAR(j.force.y(), 0.0, 1e-9) << j.name;
  }
  EXPECT_NEAR(s.joints[0].force.z() + s.joints[3].force.z(), 6.0 * 9.81, 1e-8);
}

TEST(Redundancy, RodsToo) {
  // A stone on a weld and a rod below: the rod carries half of the weight.
  const Model model = model_of(R"(
bodies: {stone: {position: [0, 0, 1], rigid: {mass: 10, inertia: [1, 1, 1]}}}
joints: {weld: {type: weld, child: stone, at: [0, 0, 1]}}
rods: {prop: {from: {body: ground, at: [0, 0, 0]}, to: {body: stone, at: [0, 0, 1]}}}
)");
  const StaticsResult s = statics(model);
  ASSERT_EQ(s.forces.size(), 1u);
  EXPECT_NEAR(s.forces[0].force, -49.05, 1e-9);
  EXPECT_FALSE(s.forces[0].unique);
  EXPECT_NEAR(s.joints[0].force.z(), 49.05, 1e-9);
  EXPECT_EQ(s.joints[0].unique_force, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(texts(s.redundant), (std::vector<std::string>{"rod 'prop': length"}));
}

TEST(Redundancy, NoneOfTheExamplesHasAny) {
  for (const char* name : {"slider_crank", "flexible_pendulum", "active_damper"}) {
    const Model model =
        build_model(read_model(std::string(FLOATFRAME_EXAMPLES "/") + name + "/" + name + ".yaml"));
    const ModelCounts c = check(model);
    EXPECT_TRUE(c.start.notes.empty()) << name;
    EXPECT_TRUE(statics(model).redundant.empty()) << name;
  }
}

// Reactions by the rows of all joints and by the wrenches of the tree are the same where they are
// unique.
TEST(Redundancy, ReactionsAgreeWithThoseOfTheTree) {
  const Model model =
      build_model(read_model(FLOATFRAME_EXAMPLES "/slider_crank/slider_crank.yaml"));
  const StaticsResult tree = statics(model);
  RelativeFormulation f(model, model.simulation.inertia);
  State state = relative_start(f, Start::equilibrium);
  const ConstraintAnalysis analysis(f, state.q);
  const auto found = analysis.multipliers(tree.residual);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->balanced.cols(), 0);
  std::vector<StaticsJoint> all(tree.joints.size());
  for (std::size_t k = 0; k < analysis.parts().size(); ++k) {
    const ConstraintPart& p = analysis.parts()[k];
    for (int r = 0; r < p.rows() && p.owner.joint >= 0; ++r) {
      const Eigen::Index i = analysis.row_of(k) + r;
      all[p.owner.joint].force -= found->lambda[i] * analysis.row(k, r).gradient.b.F;
      all[p.owner.joint].torque -= found->lambda[i] * analysis.row(k, r).gradient.b.T;
    }
  }
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    EXPECT_NEAR((all[j].force - tree.joints[j].force).norm(), 0.0, 1e-8) << tree.joints[j].name;
    EXPECT_NEAR((all[j].torque - tree.joints[j].torque).norm(), 0.0, 1e-8) << tree.joints[j].name;
  }
}

}  // namespace
}  // namespace floatframe::test

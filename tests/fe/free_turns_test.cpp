// Turns that nothing resists: rigid bars, spiders and straight beams between nodes that have no
// rotations.
#include "floatframe/fe/free_turns.hpp"

#include <gtest/gtest.h>

#include "floatframe/math/so3.hpp"
#include "support/fe_models.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

/// 4 x 2 x 2 bricks: nodes (i, j, k) at 9 i + 3 j + k.
FeModel bar_block(double size = 1.0) { return brick_beam(4, 2, 2, 0.4 * size, 0.1 * size); }

int block_node(int i, int j, int k) { return 9 * i + 3 * j + k; }

int add_node(FeModel& model, const Vec3& p) {
  model.positions.push_back(p);
  return model.nodes() - 1;
}

/// e . (u_b - u_a) = 0
void keep_length(FeModel& model, int a, int b) {
  const Vec3 e = (model.positions[b] - model.positions[a]).normalized();
  LinearEquation equation;
  Eigen::Index largest = 0;
  e.cwiseAbs().maxCoeff(&largest);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const int axis = static_cast<int>((largest + k) % 3);
    if (e(axis) == 0.0) continue;
    equation.terms.push_back({b, axis, e(axis)});
    equation.terms.push_back({a, axis, -e(axis)});
  }
  model.equations.push_back(equation);
}

/// u_p = (1 - s) u_a + s u_b
void keep_share(FeModel& model, int p, double s, int a, int b) {
  for (int axis = 0; axis < 3; ++axis) {
    LinearEquation equation;
    equation.terms = {{p, axis, 1.0}, {a, axis, s - 1.0}, {b, axis, -s}};
    model.equations.push_back(equation);
  }
}

FeModel tied(FeModel model) {
  tie_free_turns(model, free_turns(model));
  return model;
}

/// Six rigid motions, then the same eigenvalues.
void expect_same(const FeModel& model, const FeModel& oracle, int count = 30) {
  const VecX a = free_eigenvalues(model), b = free_eigenvalues(oracle);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT(a.head<6>().cwiseAbs().maxCoeff(), 1e-7 * a(6));
  for (int k = 6; k < 6 + count; ++k) EXPECT_NEAR(a(k) / b(k), 1.0, 1e-9) << k;
  const VecX without = free_eigenvalues(bar_block());  // it stiffens the block
  EXPECT_GT((a.segment(6, 20).array() / without.segment(6, 20).array()).maxCoeff(), 1.001);
}

TEST(FreeTurns, ARigidBarKeepsALength) {
  FeModel model = bar_block();
  const int a = block_node(0, 0, 0), b = block_node(4, 2, 1);
  FeModel oracle = model;
  keep_length(oracle, a, b);
  add_spider(model, a, {b});
  const std::vector<FreeTurn> turns = free_turns(model);
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_FALSE(turns[0].every_way);
  EXPECT_LT(turns[0].axis.cross((model.positions[b] - model.positions[a]).normalized()).norm(),
            1e-12);
  // The reference has two turns of its own more than the equation leaves: b's directions across.
  FeModel with = tied(model);
  EXPECT_EQ(assemble(with).size(), assemble(oracle).size());
  expect_same(with, oracle);
  EXPECT_TRUE(free_turns(with).empty());  // once is enough
  ASSERT_EQ(with.notes.size(), 1u);
  EXPECT_EQ(
      with.notes[0],
      "nothing resists the turn of 1 rigid or straight group of nodes about the line that holds "
      "them: nodes without rotations; it follows the elements there; first: the rigid spider of "
      "node 0, held at node 0");
}

TEST(FreeTurns, WithoutTheTieTheStiffnessIsSingular) {
  FeModel model = bar_block();
  add_spider(model, block_node(0, 0, 0), {block_node(4, 2, 1)});
  const FeSystem system = assemble(model);
  const VecX loose = symmetric_eigenvalues(MatX(system.K));
  EXPECT_LT(loose(6), 1e-12 * loose(loose.size() - 1));
  EXPECT_GT(loose(7), 1e-9 * loose(loose.size() - 1));
}

TEST(FreeTurns, TheUnitOfLengthDoesNotMatter) {
  FeModel model = bar_block(1e-3), large = bar_block();
  for (FeModel* m : {&model, &large}) add_spider(*m, block_node(0, 0, 0), {block_node(4, 2, 1)});
  const VecX a = free_eigenvalues(tied(model)), b = free_eigenvalues(tied(large));
  for (int k = 6; k < 30; ++k) EXPECT_NEAR(1e-6 * a(k) / b(k), 1.0, 1e-9) << k;
}

TEST(FreeTurns, ThreeNodesOnALine) {
  FeModel model = bar_block();
  const int a = block_node(0, 0, 0), p = block_node(1, 0, 1), b = block_node(2, 0, 2);
  FeModel oracle = model;
  keep_length(oracle, a, b);
  keep_share(oracle, p, 0.5, a, b);
  add_spider(model, p, {a, b});
  expect_same(tied(model), oracle);
}

TEST(FreeTurns, AReferenceThatNothingElseUses) {
  const int a = block_node(0, 1, 0), b = block_node(3, 0, 2);
  FeModel oracle = bar_block();
  keep_length(oracle, a, b);
  for (const double beside : {0.0, 0.02}) {  // on the line and beside it
    FeModel model = bar_block();
    const Vec3 p = 0.3 * model.positions[a] + 0.7 * model.positions[b] + Vec3(0, beside, 0);
    add_spider(model, add_node(model, p), {a, b});
    const FeModel with = tied(model);
    EXPECT_EQ(assemble(with).size(), assemble(oracle).size());
    expect_same(with, oracle);
  }
}

/// A chain of rigid bars whose inner nodes are references of the next.
TEST(FreeTurns, ChainsTurnTogether) {
  FeModel model = bar_block();
  const int a = block_node(0, 0, 0), p = block_node(1, 0, 1), b = block_node(2, 0, 2);
  FeModel oracle = model;
  keep_length(oracle, a, b);
  keep_share(oracle, p, 0.5, a, b);
  add_spider(model, a, {p});
  add_spider(model, p, {b});
  ASSERT_EQ(free_turns(model).size(), 1u);
  expect_same(tied(model), oracle);
  model.spiders[1].nodes = {block_node(3, 2, 2)};  // no line: a rigid triangle
  EXPECT_TRUE(free_turns(model).empty());
}

TEST(FreeTurns, AnArmOnOneNodeDoesNothing) {
  FeModel model = bar_block();
  add_spider(model, add_node(model, Vec3(0.5, 0.2, 0.3)), {block_node(4, 2, 1)});
  const std::vector<FreeTurn> turns = free_turns(model);
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_TRUE(turns[0].every_way);
  const VecX a = free_eigenvalues(tied(model)), b = free_eigenvalues(bar_block());
  ASSERT_EQ(a.size(), b.size());
  for (int k = 6; k < 36; ++k) EXPECT_NEAR(a(k) / b(k), 1.0, 1e-9) << k;
}

TEST(FreeTurns, MassOffTheLineLeavesAMechanism) {
  FeModel model = bar_block();
  const int a = block_node(0, 1, 0), b = block_node(3, 0, 2);
  const int beside = add_node(model, Vec3(0.2, 0.3, 0.05));
  add_spider(model, beside, {a, b});
  model.masses.push_back({beside, 0.1, Mat3::Zero()});
  EXPECT_TRUE(free_turns(model).empty());
  model.masses[0] = {beside, 0.0, Mat3::Identity()};  // inertia turns
  EXPECT_TRUE(free_turns(model).empty());
  model.masses.clear();
  model.positions[beside] = 0.5 * (model.positions[a] + model.positions[b]);
  model.masses.push_back({beside, 0.1, Mat3::Zero()});  // on the line it does not
  EXPECT_EQ(free_turns(model).size(), 1u);
  model.spiders.clear();
  model.masses = {{block_node(2, 1, 1), 0.1, Mat3::Zero()}};
  add_spider(model, beside, {block_node(4, 1, 1)});
  EXPECT_EQ(free_turns(model).size(), 1u);  // a mass elsewhere
  model.masses[0].node = beside;            // a pendulum: two swings are left
  const VecX lambda = free_eigenvalues(tied(model));
  EXPECT_LT(lambda(7), 1e-9 * lambda(8));
}

TEST(FreeTurns, HeldNodesHaveNone) {
  FeModel model = bar_block();
  const int a = block_node(0, 1, 0), b = block_node(3, 0, 2);
  add_spider(model, a, {b, block_node(2, 2, 2)});  // three nodes, no line
  EXPECT_TRUE(free_turns(model).empty());
  model.spiders[0].nodes = {b};
  EXPECT_EQ(free_turns(model).size(), 1u);
  LinearEquation turn;  // some rotation of it is said
  turn.terms = {{a, 3, 1.0}, {b, 0, 1.0}};
  model.equations = {turn};
  EXPECT_TRUE(free_turns(model).empty());
  model.equations.clear();
  model.spiders[0].mask = 3;
  EXPECT_TRUE(free_turns(model).empty());
}

/// Two bars in one element that is skew: the turn of one follows none that the other ties.
TEST(FreeTurns, NeighbouringBars) {
  FeModel model = bar_block();
  for (Vec3& p : model.positions) p += Vec3(0.3 * p.y(), 0.2 * p.z(), 0.1 * p.x());
  const int pairs[2][2] = {{block_node(0, 0, 0), block_node(1, 1, 1)},
                           {block_node(0, 1, 0), block_node(1, 0, 1)}};
  FeModel oracle = model;
  for (const auto& [a, b] : pairs) {
    keep_length(oracle, a, b);
    add_spider(model, a, {b});
  }
  const VecX a = free_eigenvalues(tied(model)), b = free_eigenvalues(oracle);
  ASSERT_EQ(a.size(), b.size());
  for (int k = 6; k < 36; ++k) EXPECT_NEAR(a(k) / b(k), 1.0, 1e-9) << k;
}

/// Of a bar between balls only its axial force is felt; without mass it is a rod.
TEST(FreeTurns, AStraightBarIsARod) {
  const int a = block_node(0, 1, 0), b = block_node(3, 0, 2);
  FeModel bar = bar_block();
  bar.materials.push_back({2.1e11, 0.3, 0.0});
  bar.sections = {BeamSection::solid_round(0.02)};
  FeElement e;
  e.type = FeElementType::beam2;
  e.nodes[0] = a;
  e.nodes[1] = b;
  e.material = 1;
  FeModel rod = bar;
  bar.elements.push_back(e);
  e.type = FeElementType::rod2;
  rod.elements.push_back(e);
  const FeModel with = tied(bar);
  ASSERT_EQ(with.equations.size(), 1u);
  // Rotations of the bar's ends carry no mass: condensed.
  const FeSystem system = assemble(with);
  std::vector<int> kept, gone;
  for (int i = 0; i < system.size(); ++i)
    (system.dofs[static_cast<std::size_t>(i)].axis < 3 ? kept : gone).push_back(i);
  EXPECT_EQ(gone.size(), 5u);
  const MatX K(system.K), M(system.M);
  const MatX inner = K(gone, gone);
  EXPECT_GT(symmetric_eigenvalues(inner)(0), 1e-6 * inner.diagonal().maxCoeff());
  const MatX X = inner.ldlt().solve(MatX(K(gone, kept)));
  const MatX Kc = MatX(K(kept, kept)) - MatX(K(kept, gone)) * X;
  const VecX f =
      generalised_eigenvalues(MatX(0.5 * (Kc + Kc.transpose())), MatX(M(kept, kept))).values;
  const VecX expected = free_eigenvalues(rod);
  ASSERT_EQ(f.size(), expected.size());
  for (int k = 6; k < 40; ++k) EXPECT_NEAR(f(k) / expected(k), 1.0, 1e-8) << k;
}

}  // namespace
}  // namespace floatframe::test

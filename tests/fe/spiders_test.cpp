// Spiders and equations by elimination.
#include <gtest/gtest.h>

#include "fe/mixed_model.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/so3.hpp"
#include "support/error_of.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

TEST(Spiders, MeanMovesAsTheLeastSquaresRigidMotion) {
  FeModel model = mixed_model(Spider::Kind::mean);
  model.elements.pop_back();
  model.masses.clear();
  model.spiders[0].weights = {1.0, 2.0, 0.5, 1.5};
  const FeSystem system = assemble(model);
  // Four nodes with 12 dofs, of which six follow: 24 + 6 + 6 rows.
  EXPECT_EQ(system.size(), 3 * 8 + 12 - 6 + 6);
  Random random(6);
  const VecX q = random.matrix(system.size(), 1);
  const VecX u = system.T * q, theta = system.T_theta * q;
  // The rigid motion of the reference minimises sum w |u_i - u_r - theta x r_i|^2: the residual has
  // no weighted resultant force and no moment.
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const Spider& s = model.spiders[0];
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 r = model.positions[s.nodes[i]] - model.positions[12];
    const Vec3 residual =
        u.segment<3>(3 * s.nodes[i]) - u.segment<3>(36) - Vec3(theta.segment<3>(36)).cross(r);
    force += s.weights[i] * residual;
    moment += s.weights[i] * r.cross(residual);
  }
  EXPECT_LT(force.norm(), 1e-12 * u.norm());
  EXPECT_LT(moment.norm(), 1e-12 * u.norm());
  // Rigid motion of everything, and its energy.
  const MatX R = rigid_motions_of(model, system);
  EXPECT_LT((system.K * R).cwiseAbs().maxCoeff(), 1e-11 * system.K.coeffs().cwiseAbs().maxCoeff());
  FeModel free = model;
  free.spiders.clear();
  const FeSystem plain = assemble(free);
  const MatX R_free = rigid_motions_of(free, plain);
  const Mat6 expected = R_free.transpose() * plain.M * R_free;
  EXPECT_LT((R.transpose() * system.M * R - expected).cwiseAbs().maxCoeff(),
            1e-12 * expected.cwiseAbs().maxCoeff());
}

TEST(Spiders, ForceOnAMeanReferenceIsCarriedInEquilibrium) {
  // A brick held at one end by a mean spider, loaded at the other by another one: the reaction at
  // the held reference balances the load, and both ends are not stiffened: the same brick with
  // rigid spiders is stiffer.
  FeModel model = mixed_model(Spider::Kind::mean);
  model.elements.pop_back();
  model.masses.clear();
  model.positions.emplace_back(-0.05, 0.05, 0.05);  // 14
  Spider other = model.spiders[0];
  other.name = "ROOT";
  other.reference = 14;
  other.nodes = {0, 1, 2, 3};
  model.spiders.push_back(other);
  double deflection[2] = {};
  for (const Spider::Kind kind : {Spider::Kind::mean, Spider::Kind::rigid}) {
    for (Spider& s : model.spiders) s.kind = kind;
    const FeSystem system = assemble(model);
    const int root = system.first[14], tip = system.first[12];
    MatX K(system.K);
    VecX f = VecX::Zero(system.size());
    Vec6 load;
    load << 100, 20, -30, 1, -2, 3;
    f.segment<6>(tip) = load;
    MatX held = K;
    held.middleRows<6>(root).setZero();
    held.block<6, 6>(root, root).setIdentity();
    const VecX u = held.partialPivLu().solve(f);
    const Vec6 reaction = (K * u).segment<6>(root);
    const Vec3 arm = model.positions[12] - model.positions[14];
    EXPECT_LT((reaction.head<3>() + load.head<3>()).norm(), 1e-9 * 100);
    EXPECT_LT((reaction.tail<3>() + load.tail<3>() + arm.cross(Vec3(load.head<3>()))).norm(), 1e-9);
    deflection[kind == Spider::Kind::rigid ? 1 : 0] = u.segment<6>(tip).dot(load);
  }
  EXPECT_GT(deflection[0], 1.01 * deflection[1]);
}

TEST(Spiders, ChainsAndEquations) {
  // Node 13 hangs rigidly on node 12, which is the rigid reference of the flange, by an equation
  // for a single direction and by a spider of a spider.
  FeModel model = mixed_model(Spider::Kind::rigid);
  model.masses.clear();
  model.positions.emplace_back(0.6, 0.0, 0.1);
  add_spider(model, 14, {12, 13}).name = "OUTER";
  LinearEquation tie;  // ux of node 0 = 0.5 (ux of node 1 + ux of node 2)
  tie.terms = {{0, 0, 2.0}, {1, 0, -1.0}, {2, 0, -1.0}};
  model.equations.push_back(tie);
  const FeSystem system = assemble(model);
  EXPECT_EQ(system.size(), 8 * 3 - 1 + 6);
  EXPECT_EQ(system.first[0], -1);
  EXPECT_EQ(system.row(0, 1), 0);
  Random random(9);
  const VecX q = random.matrix(system.size(), 1);
  const VecX u = system.T * q;
  EXPECT_NEAR(u(0), 0.5 * (u(3) + u(6)), 1e-14);
  const int r = system.first[14];
  for (const int node : {8, 9, 10, 11, 12, 13}) {
    const Vec3 arm = model.positions[node] - model.positions[14];
    const Vec3 expected = q.segment<3>(r) + Vec3(q.segment<3>(r + 3)).cross(arm);
    EXPECT_LT((u.segment<3>(3 * node) - expected).norm(), 1e-13) << node;
  }
}

std::string refusal(const FeModel& model) {
  return error_of([&] {
    validate(model);
    assemble(model);
  });
}

/// A face that moves as one in x with a point beside it is one that moves as its first node.
TEST(Spiders, EquationsCarryNodesThatNothingElseUses) {
  FeModel model = mixed_model(Spider::Kind::rigid);
  model.elements.pop_back();
  model.masses.clear();
  model.spiders.clear();
  FeModel direct = model;
  for (const int node : {9, 10, 11})
    direct.equations.push_back({{{node, 0, 1.0}, {8, 0, -1.0}}, {}});
  for (const int node : {8, 9, 10, 11})
    model.equations.push_back({{{node, 0, 1.0}, {13, 0, -1.0}}, {}});
  const FeSystem A = assemble(model), B = assemble(direct);
  ASSERT_EQ(A.size(), B.size());
  EXPECT_EQ(A.row(13, 0), A.size() - 1);
  EXPECT_EQ(A.row(13, 1), -1);
  const VecX found = free_eigenvalues(A), expected = free_eigenvalues(B);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
}

TEST(Spiders, Refusals) {
  const FeModel good = mixed_model(Spider::Kind::rigid);
  EXPECT_EQ(refusal(good), "no error");
  FeModel f = good;
  f.files = {"deck.inp"};
  Spider second = f.spiders[0];
  second.name = "SECOND";
  second.reference = 13;
  second.nodes = {3, 9};
  second.source = {0, 88};
  f.spiders.push_back(second);
  EXPECT_EQ(refusal(f), "deck.inp:88: dependent");
  f = good;
  f.spiders[0].kind = Spider::Kind::mean;
  f.spiders[0].nodes = {8, 9};
  EXPECT_EQ(refusal(f), "singular");
  f = good;
  second.reference = 8;
  second.nodes = {12};
  second.source = {};
  f.spiders.push_back(second);
  EXPECT_EQ(refusal(f), "cycle");
  f = good;
  LinearEquation e;
  e.terms = {{0, 0, 1.0}, {1, 4, 1.0}};
  f.equations.push_back(e);
  EXPECT_EQ(refusal(f), "wrong_value");
  f.positions.emplace_back(1, 2, 3);  // 14: nothing uses it, nor an equation with another node
  f.equations[0].terms = {{14, 0, 1.0}};
  EXPECT_EQ(refusal(f), "wrong_value");
  f.equations[0].terms = {{0, 0, 0.0}, {1, 1, 1.0}};
  EXPECT_EQ(refusal(f), "out_of_range");
}

}  // namespace
}  // namespace floatframe::test

// RBE3, RBE1, RBAR, RTRPLT and RROD of Nastran: the same part written otherwise, and what the
// averages of RBE3 are by definition.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_text.hpp"
#include "floatframe/math/so3.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

/// Two bars that only a rigid element joins. The middle nodes have turned systems.
const std::string two_bars =
    "CORD2R,7,,1.,2.,3.,2.,4.,5.\n,0.,1.,1.\nCORD2C,8,,-1.,2.,0.,-1.,3.,1.\n,4.,2.,.5\n"
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,.2,0.,7\nGRID,3,,1.3,.5,.4,8\nGRID,4,,2.,1.,1.\n"
    "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,3,4,0.,1.,0.\n"
    "PBAR,1,1,1.-3,1.-7,2.-7,2.-7\nMAT1,1,2.+11,,.3,8000.\nPARAM,COUPMASS,1\n";

VecX rigid_lambda(const std::string& element) {
  const VecX lambda = free_eigenvalues(valid_bdf(two_bars + element));
  EXPECT_EQ(lambda.size(), 18) << element;
  return lambda.tail(12);
}

TEST(NastranRigid, IndependentComponentsOfSeveralNodes) {
  const VecX expected = rigid_lambda("RBE2,5,2,123456,3\n");
  for (const char* element :
       {"RBAR,5,2,3,123456\n", "RBAR,5,2,3,,123456\n", "RBAR1,5,2,3\n", "RBAR,5,2,3,123,456\n",
        "RBAR,5,2,3,236,145,145,236\n", "RBE1,5,2,123,3,456\n,UM,2,456,3,123\n",
        "RBE1,5,2,123456\n,UM,3,123456,1.-5\n", "RBE1,5,3,236,2,145\n,UM,3,145,2,236\n"}) {
    const VecX found = rigid_lambda(element);
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(found(i) / expected(i), 1.0, 1e-8) << element << i;
  }
}

TEST(NastranRigid, Triangle) {
  const std::string third = "GRID,5,,1.4,-.2,.1\nCBAR,3,1,5,4,0.,1.,0.\n";
  const auto lambda = [&](const std::string& element) {
    return VecX(free_eigenvalues(valid_bdf(two_bars + third + element)).tail(12));
  };
  const VecX expected = lambda("RBE2,5,2,123456,3,5\n");
  for (const char* element : {"RTRPLT,5,2,3,5,123456\n", "RTRPLT,5,2,3,5,12,356,4\n"}) {
    const VecX found = lambda(element);
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(found(i) / expected(i), 1.0, 1e-8) << element << i;
  }
}

// Only what CMB names follows: a hinge leaves one rotation free.
TEST(NastranRigid, SomeComponentsFollow) {
  const FeSystem all = assemble(valid_bdf(two_bars + "RBAR,5,2,3,123456\n"));
  const FeSystem hinge = assemble(valid_bdf(two_bars + "RBE1,5,2,123456\n,UM,3,12346\n"));
  EXPECT_EQ(hinge.size(), all.size() + 1);
}

TEST(NastranRigid, RodKeepsItsLength) {
  const FeModel model = valid_bdf(two_bars + "RROD,5,2,3\n");
  ASSERT_EQ(model.equations.size(), 1u);
  const Vec3 d = (model.positions[2] - model.positions[1]).normalized();
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  for (const LinearEquation::Term& t : model.equations[0].terms)
    (t.node == 1 ? a : b)(t.axis) += t.factor;
  const double scale = b.dot(d);
  EXPECT_LT((b - scale * d).norm() + (a + scale * d).norm(), 1e-14 * std::abs(scale));
}

/// Sum of w (component of the nodes - that of the rigid motion q of the reference)^2.
struct Weighted {
  int node;
  Vec3 e;
  bool rotation;
  double w;
};

double misfit(const FeModel& m, int reference, const std::vector<Weighted>& all, const VecX& u,
              const Vec6& q) {
  double sum = 0.0;
  for (const Weighted& x : all) {
    const Vec3 own = u.segment<3>(6 * x.node + (x.rotation ? 3 : 0)), turn = q.tail<3>();
    const Vec3 arm = m.positions[x.node] - m.positions[reference];
    const Vec3 rigid = x.rotation ? turn : Vec3(q.head<3>() + turn.cross(arm));
    sum += x.w * std::pow(x.e.dot(own - rigid), 2);
  }
  return sum;
}

// The reference (node 5) moves so that the weighted sum of squares is least; rotations count with
// the square of the mean distance of the nodes.
TEST(NastranRigid, WeightedComponents) {
  const std::string deck = two_bars + "GRID,5,,1.1,.4,.3,8\n";
  const std::string cards[] = {"RBE3,9,,5,123456,1.5,123456,1,2,\n,.7,1346,3,4\n",
                               "RBE3,9,,5,1346,1.5,123456,1,2,\n,.7,1346,3,4,\n,UM,1,12,2,56\n"};
  Random random(5);
  for (const std::string& card : cards) {
    const FeModel m = valid_bdf(deck + card);
    const bool whole = &card == &cards[0];
    ASSERT_EQ(m.equations.size(), whole ? 6u : 4u);
    std::vector<Weighted> all;
    double mean = 0.0;
    for (int i = 0; i < 4; ++i) mean += 0.25 * (m.positions[i] - m.positions[4]).norm();
    // Axes of CORD2R 7 and of CORD2C 8 at their nodes, by their definition.
    const auto frame = [](const Vec3& o, const Vec3& b, const Vec3& c) {
      Mat3 R;
      R.col(2) = (b - o).normalized();
      R.col(1) = R.col(2).cross(c - o).normalized();
      R.col(0) = R.col(1).cross(R.col(2));
      return R;
    };
    const Vec3 o(-1, 2, 0);
    const Mat3 cylinder = frame(o, {-1, 3, 1}, {4, 2, .5});
    const auto around = [&](const Vec3& p) {
      Mat3 R;
      R.col(2) = cylinder.col(2);
      R.col(0) = (p - o - (p - o).dot(R.col(2)) * R.col(2)).normalized();
      R.col(1) = R.col(2).cross(R.col(0));
      return R;
    };
    const Mat3 axes[] = {Mat3::Identity(), frame({1, 2, 3}, {2, 4, 5}, {0, 1, 1}),
                         around(m.positions[2]), Mat3::Identity()};
    for (int i = 0; i < 4; ++i)
      for (int c = 0; c < 6; ++c) {
        if (i >= 2 && (c == 1 || c == 4)) continue;
        const double w = i < 2 ? 1.5 : .7;
        all.push_back({i, axes[i].col(c % 3), c >= 3, c < 3 ? w : w * mean * mean});
      }
    // Displacements of the nodes at random; the fit by the slopes of the quadratic misfit.
    VecX u = VecX::Zero(6 * m.nodes());
    for (int i = 0; i < 24; ++i) u(i) = random();
    Mat6 H;
    Vec6 g;
    const double zero = misfit(m, 4, all, u, Vec6::Zero());
    for (int i = 0; i < 6; ++i) {
      const Vec6 ei = Vec6::Unit(i);
      g(i) = 0.5 * (misfit(m, 4, all, u, ei) - misfit(m, 4, all, u, -ei));
      for (int j = 0; j < 6; ++j)
        H(i, j) = misfit(m, 4, all, u, ei + Vec6::Unit(j)) - misfit(m, 4, all, u, ei) -
                  misfit(m, 4, all, u, Vec6::Unit(j)) + zero;
    }
    u.segment<6>(24) = -H.ldlt().solve(g);
    if (!whole) {  // components 2 and 5 of the reference are free
      const Mat3 R = around(m.positions[4]);
      u.segment<3>(24) += 0.3 * R.col(1);
      u.segment<3>(27) -= 0.8 * R.col(1);
    }
    for (const LinearEquation& e : m.equations) {
      double sum = 0.0, size = 0.0;
      for (const LinearEquation::Term& t : e.terms) {
        ASSERT_LT(t.node, 5);
        sum += t.factor * u(6 * t.node + t.axis);
        size = std::max(size, std::abs(t.factor));
      }
      EXPECT_NEAR(sum, 0.0, 1e-11 * size);
    }
  }
}

// Two nodes with rotations at -a and a: about z half by their displacements, half by their turns.
TEST(NastranRigid, TwoNodesWithRotations) {
  const FeModel m = valid_bdf(
      "GRID,1,,-2.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\n"
      "PBAR,1,1,1.-3,1.-7,2.-7,2.-7\nMAT1,1,2.+11,,.3,8000.\nRBE3,5,,3,123456,1.,123456,1,2\n");
  VecX u = VecX::Zero(6 * m.nodes());
  u(1) = .1;
  u(7) = .5;
  u(5) = .03;
  u(11) = .2;
  u(13) = .3;                       // uy of the reference
  u(17) = .4 / (4 * 2.) + .23 / 4;  // rz
  for (const LinearEquation& e : m.equations) {
    double sum = 0.0;
    for (const LinearEquation::Term& t : e.terms) sum += t.factor * u(6 * t.node + t.axis);
    EXPECT_NEAR(sum, 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace floatframe::test

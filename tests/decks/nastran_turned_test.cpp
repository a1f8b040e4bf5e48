// Displacement systems of nodes (CD): the same part with its equations, rigid elements and bars in
// basic axes and in turned, cylindrical and spherical ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

/// Stiffness of the whole as seen at some free nodes: what differs in the choice of dependent
/// degrees of freedom is condensed away.
MatX stiffness_at(const FeModel& model, const std::vector<int>& nodes) {
  const FeSystem s = assemble(model);
  std::vector<int> keep, rest;
  for (int i = 0; i < s.size(); ++i) {
    const bool kept = std::find(nodes.begin(), nodes.end(), s.dofs[i].node) != nodes.end();
    (kept ? keep : rest).push_back(i);
  }
  const MatX K(s.K);
  const MatX A = K(rest, rest), B = K(rest, keep);
  return K(keep, keep) - B.transpose() * A.completeOrthogonalDecomposition().solve(B);
}

void expect_same_turned(const std::string& basic, const std::string& turned,
                        const std::vector<int>& nodes) {
  const MatX a = stiffness_at(read_bdf(basic), nodes), b = stiffness_at(read_bdf(turned), nodes);
  ASSERT_EQ(a.rows(), b.rows()) << turned;
  EXPECT_LT((a - b).norm(), 1e-10 * a.norm()) << turned;
}

// Nodes 1 to 3 are bars along x; 4 is beside them; 5 and 6 are bars from 4.
const std::string bars =
    "MAT1,1,100.,,.25,2.\nPBAR,1,1,.1,.2,.3,.4\n"
    "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\nCBAR,3,1,4,5,0.,0.,1.,BGG\nCBAR,4,1,5,6,0.,0.,1."
    "\n"
    "GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\nGRID,5,,3.,3.,2.\nGRID,6,,5.,4.,2.\n";

std::string nodes_3_and_4(int cd) {
  return fmt::format("GRID,3,,5.,1.,.5,{0}\nGRID,4,,4.,2.,1.,{0}\n", cd);
}

const char* const systems =
    "CORD2R,1,,0.,0.,0.,1.,2.,3.\n,-1.,4.,0.5\n"
    "CORD2C,2,,.5,0.,0.,.5,1.,3.\n,1.,0.,0.\n"
    "CORD2S,3,,.5,-1.,0.,.5,1.,3.\n,1.,0.,0.\n"
    "CORD1R,4,1,2,5,6,1,5,2\n";

/// Columns of the axes of system cd at a place, as the manuals have them.
Mat3 axes_of(int cd, const Vec3& p) {
  const auto frame = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    Mat3 R;
    R.col(2) = (b - a).normalized();
    R.col(1) = R.col(2).cross(c - a).normalized();
    R.col(0) = R.col(1).cross(R.col(2));
    return R;
  };
  if (cd == 1) return frame({0, 0, 0}, {1, 2, 3}, {-1, 4, 0.5});
  if (cd == 4) return frame({0, 0, 0}, {3, 0, 0}, {3, 3, 2});
  const Vec3 a(0.5, cd == 2 ? 0.0 : -1.0, 0);
  const Vec3 z = (Vec3(0.5, 1, 3) - a).normalized(), d = p - a;
  const Vec3 around = z.cross(d).normalized();
  Mat3 R;
  if (cd == 2) {
    R << around.cross(z), around, z;
  } else {
    R << d.normalized(), around.cross(d.normalized()), around;
  }
  return R;
}

const Vec3 p3(5, 1, 0.5), p4(4, 2, 1);

TEST(NastranTurned, Equations) {
  for (int cd = 1; cd <= 4; ++cd) {
    const Mat3 R3 = axes_of(cd, p3), R4 = axes_of(cd, p4);
    ASSERT_LT((R3.transpose() * R3 - Mat3::Identity()).norm(), 1e-12);
    // Directions 1 and 2 of node 4 follow those of node 3 and a rotation of node 2.
    std::string basic, turned;
    turned = "MPC,9,4,1,1.,3,1,-1.\n,,2,6,.5\nMPC,9,4,2,2.,3,2,-1.\n";
    // The same in basic axes, solved for x and y or whichever can be.
    Eigen::Matrix<double, 2, 7> rows;  // u4, u3, rz of node 2
    rows << R4.col(0).transpose(), -R3.col(0).transpose(), 0.5, 2 * R4.col(1).transpose(),
        -R3.col(1).transpose(), 0.0;
    int i = 0, j = 1;
    double most = 0.0;
    for (int a = 0; a < 3; ++a) {
      for (int b = a + 1; b < 3; ++b) {
        const double det = rows(0, a) * rows(1, b) - rows(0, b) * rows(1, a);
        if (std::abs(det) <= most) continue;
        most = std::abs(det);
        i = a;
        j = b;
      }
    }
    Eigen::Matrix2d P;
    P << rows.col(i), rows.col(j);
    rows = (P.inverse() * rows).eval();
    const int k = 3 - i - j;
    for (int r = 0; r < 2; ++r) {
      basic +=
          fmt::format("MPC*,9,4,{},1.\n*,4,{},{:.16g}\n", (r == 0 ? i : j) + 1, k + 1, rows(r, k));
      basic += fmt::format("*,,3,1,{:.16g}\n*,3,2,{:.16g}\n*,,3,3,{:.16g}\n*,2,6,{:.16g}\n",
                           rows(r, 3), rows(r, 4), rows(r, 5), rows(r, 6));
    }
    expect_same_turned(bars + nodes_3_and_4(0) + basic, bars + systems + nodes_3_and_4(cd) + turned,
                       {0, 1, 3});
  }
}

TEST(NastranTurned, RigidElements) {
  for (int cd = 1; cd <= 4; ++cd) {
    const Mat3 R = axes_of(cd, p4);
    // Node 4 follows node 2 in its directions 1, 3 and 5: three MPC of the same.
    std::string mpc;
    const Vec3 arm = p4 - Vec3(3, 0, 0);
    for (const int c : {0, 2, 4}) {
      const Vec3 e = R.col(c % 3), lever = arm.cross(e);
      mpc += fmt::format("MPC*,9,4,{},1.\n", c + 1);
      std::vector<std::array<double, 3>> terms;
      for (int k = 0; k < 3; ++k) terms.push_back({2.0, double(k + 1 + (c / 3) * 3), -e(k)});
      if (c < 3)
        for (int k = 0; k < 3; ++k) terms.push_back({2.0, double(k + 4), -lever(k)});
      for (std::size_t t = 0; t < terms.size(); ++t) {
        mpc += fmt::format("{},{:.0f},{:.0f},{:.17g}\n", t % 2 == 0 ? "*" : "*,", terms[t][0],
                           terms[t][1], terms[t][2]);
      }
    }
    const std::string deck = bars + systems + nodes_3_and_4(cd);
    expect_same_turned(deck + mpc, deck + "RBE2,9,2,135,4\n", {0, 1, 2});
    // All directions do not depend on the system.
    expect_same_turned(bars + nodes_3_and_4(0) + "RBE2,9,2,123,4\n", deck + "RBE2,9,2,123,4\n",
                       {0, 1, 2});
  }
}

/// Eigenvalues of the free part [rad2/s2], the smallest first.
VecX turned_eigenvalues(const std::string& text) {
  const FeSystem s = assemble(read_bdf(text));
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(MatX(s.K), MatX(s.M),
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

// RBE2 in some directions: nodes that get their rotations from it, or from a mass; all of them
// turned, so that the reference has no node but them.
TEST(NastranTurned, BodiesOnSlides) {
  const std::string brick =
      "PARAM,COUPMASS,1\nGRID,1,,0,0,0\nGRID,2,,0.2,0,0\nGRID,3,,0.2,0.2,0\nGRID,4,,0,0.2,0\nGRID,"
      "5,,0,0,0.2\n"
      "GRID,6,,0.2,0,0.2\nGRID,7,,0.2,0.2,0.2\nGRID,8,,0,0.2,0.2\n"
      "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,2.+11,,.3,7800.\n"
      "GRID,204,,.3,.1,.1\nRBE2,1,204,123456,2,3,6,7\n"
      "CORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n"  // x is y, y is z, z is x
      "CONM2,340,208,,1.5,{1}\n,.1,,.2,,,.3\nGRID,208,,.3,.1,.1,{0}\n";
  const std::string bars_there =
      "GRID,209,,.8,.1,.1\nGRID,210,,.8,.4,.1\nCBAR,60,60,208,209,{0}\n"
      "CBAR,61,60,209,210,0.,0.,1.\nPBAR,60,1,1.-3,1.-6,2.-6,2.-6\n";
  for (const char* offset : {"", ".1,.05,.02"})
    for (const bool bar : {false, true}) {
      const auto of = [&](int cd, const char* vector, const char* slide) {
        return turned_eigenvalues(fmt::format(fmt::runtime(brick), cd, offset) +
                                  (bar ? fmt::format(fmt::runtime(bars_there), vector) : "") +
                                  slide);
      };
      const VecX basic = of(0, "0.,0.,1.", "RBE2,340,204,13456,208\nCELAS2,5,1.+6,204,2,208,2\n");
      const VecX turned = of(9, "0.,1.,0.", "RBE2,340,204,23456,208\nCELAS2,5,1.+6,204,2,208,1\n");
      ASSERT_EQ(basic.size(), turned.size());
      EXPECT_LT((basic - turned).norm(), 1e-9 * basic.norm()) << bar << offset;
      EXPECT_NEAR(turned(6) / basic(6), 1.0, 1e-7) << bar << offset;
    }
}

// Which components depend does not change the equations.
TEST(NastranTurned, DependentComponentsOfMeanSpiders) {
  const std::string deck =
      bars + nodes_3_and_4(0) + "GRID,8,,4.,2.,0.\nCONM2,9,8,,1.\nRBE3,9,,8,123456,1.,123,3,5\n,6";
  expect_same_turned(deck + "\n", deck + ",UM,3,123,5,12,6,3\n", {0, 1, 6});
  EXPECT_EQ(bdf_error(deck + ",UM,3,123,5,12\n"), "arm.bdf:15: wrong_count");
}

TEST(NastranTurned, OrientationAndOffsetsOfBars) {
  const std::string bar =
      "GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\nMAT1,1,100.,,.25,2.\nPBAR,1,1,.1,.2,.3,.4\n";
  const std::string turned =
      "CORD2R,7,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nGRID,5,,3.,1.,0.,7\nGRID,6,,6.,1.,0.,7\n"
      "GRID,7,,9.,1.,0.\nCBAR,2,1,6,7,0.,1.,0.\n";
  // x of system 7 is Y, its y is Z and its z is X.
  const FeModel model = read_bdf(bar + turned +
                                 "CBAR,1,1,5,6,.6,.8,0.\n,,,.1,.2,.3,.4,.5,.6\n"
                                 "CBAR,3,1,1,2,0.,1.,0.\n");
  const auto position_of = [&](int end) {
    return model.positions.at(model.elements[1].nodes[end]);
  };
  const Vec3 along = position_of(1) - position_of(0), y = model.elements[1].reference;
  EXPECT_NEAR(y.dot(along.cross(Vec3(0, 0.6, 0.8))), 0.0, 1e-12);
  EXPECT_NEAR(y.dot(along), 0.0, 1e-12);
  EXPECT_GT(y.dot(Vec3(0, 0.6, 0.8)), 0.9);
  EXPECT_LT((position_of(0) - Vec3(3.3, 1.1, 0.2)).norm(), 1e-12);
  EXPECT_LT((position_of(1) - Vec3(6.6, 1.4, 0.5)).norm(), 1e-12);
}

TEST(NastranTurned, Supports) {
  const FeModel model =
      read_bdf(bars +
               "GRID,3,,5.,1.,.5,8\nGRID,4,,4.,2.,1.,9\nCORD2C,8,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
               "CORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nSPC1,1,3,3\nSPC1,1,12,3\nSPC1,1,1,3\n"
               "SPC1,1,16,4\n");
  ASSERT_EQ(model.supports.size(), 3u);  // radial alone is no basic direction
  EXPECT_EQ(model.supports[0].mask, 4u);
  EXPECT_EQ(model.supports[1].mask, 3u);
  EXPECT_EQ(model.supports[2].mask, 2u | 8u);
}

TEST(NastranTurned, ErrorsOfTurnedSystems) {
  const std::string deck = bars + systems + nodes_3_and_4(1);
  const auto error = [&](const std::string& cards) { return bdf_error(deck + cards); };
  EXPECT_EQ(error("MPC,9,4,1,1.,3,1,-1.\nMPC,9,4,1,1.,2,1,-1.\n"), "arm.bdf:21: duplicate");
  EXPECT_EQ(error("RBE2,8,2,1,4\nRBE2,9,1,1,4\n"), "arm.bdf:21: duplicate");
}

}  // namespace
}  // namespace floatframe::test

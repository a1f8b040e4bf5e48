// CONM1, CMASS1, CMASS2 and corners of shells in thickness: the same part by CONM2 and PSHELL.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string bar =
    "CORD2R,7,,1.,2.,3.,2.,4.,5.\n,0.,1.,1.\n"                                        // 1, 2
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,.2,0.,7\n"                                          // 3, 4
    "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,1.-3,1.-7,2.-7,2.-7\nMAT1,1,2.+11,,.3,8000.\n";  // 5 to 7

/// Mass and inertia about the origin, with which the whole moves.
Mat6 rigid_mass_of(const FeModel& model) {
  const FeSystem system = assemble(model);
  MatX R = MatX::Zero(system.size(), 6);
  for (int node = 0; node < model.nodes(); ++node) {
    const Vec3 p = model.positions[static_cast<std::size_t>(node)];
    for (int k = 0; k < 3; ++k) {
      const int row = system.row(node, k), turn = system.row(node, 3 + k);
      if (row >= 0) {
        R(row, k) = 1.0;
        R.row(row).segment<3>(3) = p.cross(Vec3::Unit(k)).transpose();
      }
      if (turn >= 0) R(turn, 3 + k) = 1.0;
    }
  }
  return R.transpose() * system.M * R;
}

void expect_same_rigid_mass(const std::string& a, const std::string& b) {
  const Mat6 x = rigid_mass_of(valid_bdf(bar + a)), y = rigid_mass_of(valid_bdf(bar + b));
  EXPECT_LT((x - y).norm(), 1e-12 * y.norm()) << a;
}

TEST(NastranMasses, ThoseOfDirectionsTogether) {
  expect_same_rigid_mass("CMASS2,5,3.,2,1\nCMASS2,6,3.,,,2,2\nCMASS2,7,3.,2,3,0\n",
                         "CONM2,5,2,,3.\n");
  expect_same_rigid_mass(
      "PMASS,8,3.,9,.5\nCMASS1,5,8,2,1\nCMASS1,6,8,2,2\nCMASS1,7,8,2,3\n"
      "CMASS1,11,9,2,4\nCMASS1,12,9,2,5\nCMASS1,13,9,2,6\n",
      "CONM2,5,2,,3.\n,.5,,.5,,,.5\n");
  // Principal axes are those of the displacements of the node.
  expect_same_rigid_mass("CMASS2,6,.4,2,4\nCMASS2,7,.3,2,5\nCMASS2,8,.2,2,6\n",
                         "CONM2,5,2,7,0.\n,.4,,.3,,,.2\n");
}

// A mass of 2 at (.1, .2, .3) in the system 7, and inertia about it.
TEST(NastranMasses, MatrixOfARigidBody) {
  const char* const by_centre = "CONM2,5,2,7,2.,.1,.2,.3,\n,.5,-.01,.6,.02,.03,.7\n";
  // m skew(c): (4, 2) -.6, (4, 3) .4, (5, 1) .6, (5, 3) -.2, (6, 1) -.4, (6, 2) .2
  // J + m (c^2 - c c^T), products negative: .5 + .26, .6 + .2, .7 + .1
  expect_same_rigid_mass(
      "CONM1,5,2,7,2.,,2.,,\n,2.,,-.6,.4,.76,.6,,-.2\n,-.03,.8,-.4,.2,,-.08,-.15,.8\n", by_centre);
}

TEST(NastranMasses, Errors) {
  EXPECT_EQ(invalid_bdf(bar + "CMASS2,5,3.,1,1\nCMASS2,6,3.,1,2\n"), "arm.bdf:8: unsupported");
  EXPECT_EQ(invalid_bdf(bar + "CMASS2,5,3.,1,1,2,1\n"), "arm.bdf:8: unsupported");
  EXPECT_EQ(invalid_bdf(bar + "CMASS2,5,3.,1,12\n"), "arm.bdf:8: out_of_range");
  EXPECT_EQ(invalid_bdf(bar + "CMASS1,5,3,1,1\n"), "arm.bdf:8: not_found");
  EXPECT_EQ(invalid_bdf(bar + "CONM1,5,1,,2.,,2.,,\n,2.,.3\n"), "arm.bdf:8: unsupported");
}

// What only the reduction refuses has the place of its card too.
TEST(NastranMasses, NoBodies) {
  EXPECT_EQ(invalid_bdf(bar + "CONM2,5,2,,3.\n,1.,,1.,,,3.\n"), "arm.bdf:8: out_of_range");
  EXPECT_EQ(invalid_bdf(bar + "CMASS2,6,3.,2,4\n"), "arm.bdf:8: out_of_range");
  EXPECT_EQ(invalid_bdf(bar + "PARAM,WTMASS,1.+9\nCONM2,5,2,,3.+300\n"), "arm.bdf:9: not_finite");
  EXPECT_EQ(invalid_bdf(bar + "PARAM,WTMASS,1.+9\nCONM2,5,2,,3.\n,1.+300,,1.+300\n"),
            "arm.bdf:9: not_finite");
  EXPECT_EQ(invalid_bdf(bar + "CONM2,5,2,,3.\n,1.,,1.,,,2.\n"), "no error");  // a flat one
}

const std::string shell =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "PSHELL,1,1,.01,1,,1,,2.\nMAT1,1,2.+11,,.3,8000.\n";

TEST(NastranMasses, CornersOfShells) {
  const auto section = [](const std::string& text) {
    const FeModel m = valid_bdf(shell + text);
    const FeSystem system = assemble(m);
    VecX u = VecX::Zero(system.size());
    for (int i = 0; i < m.nodes(); ++i)
      if (const int row = system.row(i, 0); row >= 0) u(row) = 1.0;
    const double t = m.shells.at(0).thickness;
    EXPECT_NEAR(m.shells.at(0).shear, 5. / 6 * t, 1e-8 * t);
    EXPECT_NEAR(u.dot(system.M * u) / m.materials.at(0).density, t, 1e-15);
    EXPECT_NEAR(m.materials.at(0).density, 8000. + 2. / t, 1e-9);
    const auto uneven = std::count_if(m.notes.begin(), m.notes.end(), [](const std::string& n) {
      return n ==
             "arm.bdf:7: 1 shells have corners of different thickness, by 100.0 % at most: "
             "each has the mean of its corners";
    });
    return std::pair{std::round(1e9 * t) / 1e9, uneven};
  };
  EXPECT_EQ(section("CQUAD4,1,1,1,2,3,4\n"), (std::pair{.01, 0l}));
  EXPECT_EQ(section("CQUAD4,1,1,1,2,3,4,,,\n,,,.02,.02,.02,.02\n"), (std::pair{.02, 0l}));
  EXPECT_EQ(section("CQUAD4,1,1,1,2,3,4,,,\n,,1,2.,2.,2.,2.\n"), (std::pair{.02, 0l}));
  EXPECT_EQ(section("CQUAD4,1,1,1,2,3,4,,,\n,,,.03,.03\n"), (std::pair{.02, 1l}));
  EXPECT_EQ(invalid_bdf(shell + "CQUAD4,1,1,1,2,3,4,,,\n,,2,.03,.03\n"), "arm.bdf:7: out_of_range");
  EXPECT_EQ(invalid_bdf(shell + "CQUAD4,1,1,1,2,3,4,,,\n,,,.03,0.\n"), "arm.bdf:7: out_of_range");
  EXPECT_EQ(invalid_bdf(shell + "PCOMP,2\n,1,.01\nCQUAD4,1,2,1,2,3,4,,,\n,,,.03,.03\n"),
            "arm.bdf:9: contradiction");
}

}  // namespace
}  // namespace floatframe::test

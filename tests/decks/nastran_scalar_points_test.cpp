// Scalar points of Nastran bulk data: the same part by springs and equations between nodes.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/fe/unit_system.hpp"

namespace floatframe::test {
namespace {

/// Two tetrahedra, with displacements of node 8 about a cylinder, and two bodies with rotations.
const std::string two_tetrahedra =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"    // 1 to 4
    "GRID,5,,3.,0.,0.\nGRID,6,,4.,0.,0.\nGRID,7,,3.,1.,0.\nGRID,8,,3.,4.,1.,5\n"  // 5 to 8
    "CORD2C,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"                                    // 9, 10
    "CTETRA,1,1,1,2,3,4\nCTETRA,2,1,5,6,7,8\nPSOLID,1,1\nMAT1,1,2.+5,,.3,8.-9\n"  // 11 to 14
    "GRID,9,,5.,0.,0.\nGRID,10,,6.,0.,0.\nCONM2,91,9,,2.\n,3.,,3.,,,3.\n"         // 15 to 18
    "CONM2,92,10,,2.\n,3.,,3.,,,3.\n"                                             // 19, 20
    // What gives the bodies their rotations.
    "CBUSH,93,93,9,10,0.,1.,0.\nPBUSH,93,K,10.,20.,30.,40.,50.,60.\n";  // 21, 22

/// Stiffness of the dofs of the ten nodes of the file.
MatX stiffness_of(FeModel model, double length = 1.0) {
  if (length != 1.0) to_si(model, *find_unit_system("mm-t-s"));
  validate(model);
  const FeSystem system = assemble(model);
  MatX K = MatX::Zero(60, 60);
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) {
      const int row = system.row(i / 6, i % 6), column = system.row(j / 6, j % 6);
      if (row >= 0 && column >= 0) K(i, j) = system.K.coeff(row, column);
    }
  return K;
}

/// The same stiffness, in the units of the file and in SI; what other dofs there are is none.
void expect_same_stiffness(const std::string& points, const std::string& nodes) {
  const FeModel a = read_bdf(two_tetrahedra + points), b = read_bdf(two_tetrahedra + nodes);
  EXPECT_EQ(assemble(a).size(), assemble(b).size()) << points;
  EXPECT_LT((assemble(a).M - assemble(b).M).norm(), 1e-15 * assemble(b).M.norm()) << points;
  const MatX plain = stiffness_of(read_bdf(two_tetrahedra));
  for (const double length : {1.0, 1e-3}) {
    const MatX K = stiffness_of(a, length), expected = stiffness_of(b, length);
    EXPECT_LT((K - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff())
        << points;
  }
  EXPECT_GT((stiffness_of(a) - plain).cwiseAbs().maxCoeff(), 1.0) << points;
}

TEST(NastranScalarPoints, ChainsOfSprings) {
  // 1/(1/3 + 1/6 + 1/2) 1e5: SPOINT, and points that only CELAS3 and CELAS4 name.
  const std::string single = "CELAS2,11,1.+5,2,1,5,3\n";
  expect_same_stiffness(
      "SPOINT,21\nPELAS,3,6.+5\nCELAS2,11,3.+5,2,1,21\nCELAS3,12,3,21,22\nCELAS1,13,4,22,0,5,3\n"
      "PELAS,4,2.+5\n",
      single);
  expect_same_stiffness(
      "SPOINT,20,THRU,30\nCELAS2,11,3.+5,5,3,21\nCELAS4,12,6.+5,22,21\nCELAS2,13,2.+5,22,1,2,1\n",
      single);
  // Springs that end in the air, at one point twice, and points that nothing uses.
  expect_same_stiffness("SPOINT,20,40\nCELAS4,13,3.+5,20,21\nCELAS2,14,4.,1,1,20\n" + single +
                            "CELAS4,15,3.+5,20,20\n",
                        single);
  // In the directions of CD, and rotations.
  expect_same_stiffness("SPOINT,21\nCELAS2,11,3.+5,8,2,21\nCELAS2,12,6.+5,21,,3,3\n",
                        "CELAS2,11,2.+5,8,2,3,3\n");
  expect_same_stiffness("SPOINT,21\nCELAS2,11,3.+5,9,4,21\nCELAS2,12,6.+5,21,,10,5\n",
                        "CELAS2,11,2.+5,9,4,10,5\n");
}

// A star of springs k is a triangle of springs k_i k_j / sum k.
TEST(NastranScalarPoints, Star) {
  expect_same_stiffness(
      "SPOINT,21\nCELAS2,11,2.+5,1,1,21\nCELAS2,12,3.+5,21,,5,2\nCELAS2,13,5.+5,7,3,21\n",
      "CELAS2,11,.6+5,1,1,5,2\nCELAS2,12,1.+5,1,1,7,3\nCELAS2,13,1.5+5,5,2,7,3\n");
}

TEST(NastranScalarPoints, HeldPointsAreTheGround) {
  for (const std::string held : {"SPC1,1,,21\n", "SPC,1,21,1\n", "SPC1,1,0,20,THRU,30\n"}) {
    const std::string chain = two_tetrahedra + "SPOINT,21\nCELAS2,11,2.+5,1,1,21\n" + held;
    EXPECT_EQ(invalid_bdf(chain), "arm.bdf:24: unsupported");
    FeModel model = read_bdf(chain + "CELAS4,12,3.,21\nCELAS4,13,3.,21,21\n");
    EXPECT_EQ(remove_grounded_springs(model), 1);
    EXPECT_EQ(stiffness_of(model), stiffness_of(read_bdf(two_tetrahedra)));
  }
  EXPECT_EQ(invalid_bdf(two_tetrahedra + "CELAS4,11,2.+5,21\nCELAS2,12,3.,1,1,21\n"),
            "arm.bdf:23: unsupported");
}

/// Only supports that the case control selects hold points.
TEST(NastranScalarPoints, SelectedSupports) {
  const std::string bulk = two_tetrahedra +
                           "SPOINT,21\nCELAS2,11,2.+5,1,1,21\nSPC1,9,,21\n"
                           "SPCADD,4,9\n";
  const auto grounded = [&](const std::string& control) {
    FeModel model = read_bdf("CEND\n" + control + "BEGIN BULK\n" + bulk);
    return remove_grounded_springs(model);
  };
  EXPECT_EQ(grounded("SPC = 9\n"), 1);
  EXPECT_EQ(grounded("SPC = 4\n"), 1);
  EXPECT_EQ(grounded("SPC = 3\n"), 0);
  EXPECT_EQ(grounded(""), 0);
}

TEST(NastranScalarPoints, Equations) {
  // The point moves as a node does; two nodes as one point; a lever.
  expect_same_stiffness("SPOINT,21\nMPC,1,21,,1.,1,1,-1.\nCELAS2,11,2.+5,21,,5,1\n",
                        "CELAS2,11,2.+5,1,1,5,1\n");
  expect_same_stiffness("SPOINT,21\nMPC,1,2,2,1.,21,,-1.\nMPC,1,21,0,-1.,7,2,1.\n",
                        "MPC,1,7,2,1.,2,2,-1.\n");
  expect_same_stiffness(
      "SPOINT,21,22\nMPC,1,21,,2.,1,1,-1.\nMPC,1,22,1,-.5,21,,1.\nCELAS2,11,2.+5,22,,9,1\n"
      "MPC,1,9,1,1.,10,1,-1.\nMPC,1,5,1,1.,1,1,-1.\n",
      "CELAS2,11,2.+5,1,1,9,1\nMPC,1,9,1,1.,10,1,-1.\nMPC,1,5,1,1.,1,1,-1.\n");
  // In the direction of CD. What only says where a point goes does nothing.
  expect_same_stiffness(
      "MPC,1,21,,1.,8,2,-1.\nCELAS4,11,2.+5,21,22\nMPC,1,22,,1.,1,2,-1.\nSPOINT,"
      "31\nMPC,1,31,,1.,21,,-1.\n",
      "CELAS2,11,2.+5,8,2,1,2\n");
  // The difference of nodes, on a spring to the ground; of rotations too.
  expect_same_stiffness("SPOINT,21\nMPC,1,21,,1.,1,1,-1.\n,,5,1,1.\nCELAS4,11,2.+5,21\n",
                        "CELAS2,11,2.+5,1,1,5,1\n");
  expect_same_stiffness("SPOINT,21\nMPC,1,21,,1.,9,4,-1.\n,,10,4,1.\nCELAS4,11,2.+5,21\n",
                        "CELAS2,11,2.+5,9,4,10,4\n");
  // A held point.
  expect_same_stiffness("SPOINT,21\nSPC1,5,,21\nMPC,1,21,,1.,1,1,-1.\n,,5,1,1.\n",
                        "MPC,1,1,1,1.,5,1,-1.\n");
}

TEST(NastranScalarPoints, Errors) {
  const std::pair<std::string, const char*> wrong[] = {
      {"CELAS2,11,5.,1,1,21", "arm.bdf:23: not_found"},
      {"CELAS2,11,5.,1,1,2", "arm.bdf:23: missing"},
      {"SPOINT,21\nCELAS2,11,5.,1,1,21,3", "arm.bdf:24: wrong_value"},
      {"CELAS4,11,5.,21,2", "arm.bdf:2: duplicate"},
      {"CELAS3,11,7,21,22", "arm.bdf:23: not_found"},
      {"CELAS4,11,5.", "arm.bdf:23: missing"},
      {"CELAS4,11,,21", "arm.bdf:23: missing"},
      {"CELAS4,11,-5.,21,22", "arm.bdf:23: out_of_range"},
      {"SPOINT,21\nCELAS2,11,5.,1,1,21\nCELAS2,12,5.,9,4,21", "arm.bdf:25: dependent"},
      {"SPOINT,21\nRBE2,11,1,123,21", "arm.bdf:24: not_found"},
      {"CMASS4,11,2.,21", "arm.bdf:23: unsupported"},
      {"CMASS3,11,3,21,22\nPMASS,3,2.", "arm.bdf:23: unsupported"},
      {"CMASS3,11,3,21", "arm.bdf:23: not_found"},
      {"CMASS2,11,3.,1", "arm.bdf:23: missing"},
      {"MPC,1,1,,1.,2,1,-1.", "arm.bdf:23: missing"},
      {"SPOINT,21\nMPC,1,21,2,1.,2,1,-1.", "arm.bdf:24: wrong_value"},
      {"SPOINT,21,22\nMPC,1,21,,1.,22,,-1.\n,,2,1,1.\nCELAS4,11,5.,21,23\nCELAS4,12,6.,22,23",
       "arm.bdf:24: unsupported"},
  };
  for (const auto& [card, expected] : wrong)
    EXPECT_EQ(invalid_bdf(two_tetrahedra + card + "\n"), expected) << card;
  const FeModel held = read_bdf(two_tetrahedra + "CMASS4,11,2.,21\nSPC1,1,,21\nCMASS4,12,0.,22\n");
  EXPECT_EQ(held.notes.back(),
            "arm.bdf:23: 1 masses of scalar points that are held (SPC) or of the ground are left "
            "out");
}

// A few bytes name very many points, again and again.
TEST(NastranScalarPoints, VeryManyInFewBytes) {
  std::string text = two_tetrahedra;
  for (int i = 0; i < 2000; ++i) text += "SPOINT,100,THRU,2000000000\n";
  const FeModel model = read_bdf(text + "CELAS2,11,5.,1,1,1999999999\n");
  EXPECT_EQ(model.nodes(), 11);
}

}  // namespace
}  // namespace floatframe::test

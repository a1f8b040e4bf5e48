// Membranes of Nastran: PSHELL without MID2, PCOMP with LAM = MEM.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/reduction/connectivity.hpp"

namespace floatframe::test {
namespace {

constexpr double sheet_young = 7e10, sheet_poisson = 0.25, sheet_thickness = 0.002,
                 sheet_density = 2700.0;

/// A strip of two squares 0.5 wide.
std::string membrane_strip(const std::string& property) {
  return "GRID,1,,0.,0.,0.\nGRID,2,,.5,0.,0.\nGRID,3,,1.,0.,0.\nGRID,4,,0.,.5,0.\n"
         "GRID,5,,.5,.5,0.\nGRID,6,,1.,.5,0.\nCQUAD4,1,1,1,2,5,4\nCTRIA3,2,1,2,3,6\n"
         "CTRIA3,3,1,2,6,5\n" +
         property + "MAT1,1,7.+10,,.25,2700.\n";
}

// Stretched with free contraction: E t b/L. Mass as lumped, with that of NSM.
TEST(NastranMembranes, StretchedStrip) {
  const FeModel m = valid_bdf(membrane_strip("PSHELL,1,1,.002,,,,,.6\n"));
  ASSERT_EQ(m.elements.size(), 3u);
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane4s);
  EXPECT_EQ(m.elements[1].type, FeElementType::membrane3);
  const FeSystem system = assemble(m);
  EXPECT_EQ(system.size(), 18);  // no rotations
  VecX u = VecX::Zero(18), z = u;
  for (int k = 0; k < 6; ++k) {
    u(system.row(k, 0)) = m.positions[static_cast<std::size_t>(k)](0);
    u(system.row(k, 1)) = -sheet_poisson * m.positions[static_cast<std::size_t>(k)](1);
    z(system.row(k, 2)) = 1.0;
  }
  EXPECT_NEAR(u.dot(system.K * u), sheet_young * sheet_thickness * .5, 1e-12 * sheet_young);
  EXPECT_NEAR(z.dot(system.M * z), .5 * (sheet_density * sheet_thickness + .6), 1e-14);
  EXPECT_NEAR(system.M.coeff(0, 0), .25 / 4 * (sheet_density * sheet_thickness + .6), 1e-14);
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_EQ(m.notes[0],
            "arm.bdf:10: PSHELL: its nonstructural mass is added to the density of its material");
  const FeSystem coupled =
      assemble(valid_bdf(membrane_strip("PARAM,COUPMASS,1\nPSHELL,1,1,.002\n")));
  EXPECT_NEAR(coupled.M.coeff(0, 0), .25 / 9 * sheet_density * sheet_thickness, 1e-14);
}

// As a pre-processor punches blank materials.
TEST(NastranMembranes, MaterialZeroIsBlank) {
  const FeModel m = valid_bdf(membrane_strip("PSHELL,1,1,.002,0,,0,,,\n,,,0\n"));
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane4s);
  const FeModel plate = valid_bdf(membrane_strip("PSHELL,1,1,.002,1,,1,,,\n,,,0\n"));
  EXPECT_EQ(element_kernel(plate.elements[0].type).dofs_per_node, 6);
}

// Equal plies at 0 and 90 degrees: the same as a sheet of their mean stiffness.
TEST(NastranMembranes, Plies) {
  const FeModel m = valid_bdf(membrane_strip("PCOMP,1,,,,,,,MEM\n,1,.001,0.,,1,.001,90.\n"));
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane4s);
  const FeSystem plies = assemble(m),
                 plain = assemble(valid_bdf(membrane_strip("PSHELL,1,1,.002\n")));
  EXPECT_LT(MatX(plies.K - plain.K).norm(), 1e-12 * MatX(plain.K).norm());
  EXPECT_LT(MatX(plies.M - plain.M).norm(), 1e-12 * MatX(plain.M).norm());
}

// Elements with nodes on their edges: no note about the triangles that shells of them are.
TEST(NastranMembranes, NodesOnEdges) {
  const FeModel m = valid_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,.5,0.,0.\n"
      "GRID,6,,1.,.5,0.\nGRID,7,,.5,1.,0.\nGRID,8,,0.,.5,0.\nGRID,9,,.5,.5,0.\n"
      "GRID,10,,0.,0.,1.\nGRID,11,,0.,.5,.5\nGRID,12,,0.,0.,.5\n"
      "CQUAD8,1,1,1,2,3,4,5,6,+\n+,7,8\nCTRIA6,2,1,1,4,10,8,11,12\n"
      "PSHELL,1,1,.002\nMAT1,1,7.+10,,.25,2700.\n");
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane8);
  EXPECT_EQ(m.elements[1].type, FeElementType::membrane6);
  for (const std::string& note : m.notes) EXPECT_FALSE(contains(note, "triangles"));
}

TEST(NastranMembranes, Errors) {
  std::string text = membrane_strip("PSHELL,1,1,.002\n");
  text.replace(text.find("1,2,5,4\n"), 7, "1,2,5,4,,.1");
  EXPECT_EQ(invalid_bdf(text), "arm.bdf:7: geometry");
  EXPECT_EQ(invalid_bdf(membrane_strip("PSHELL,1,1,.002,,,,\n,,,1\n")),
            "arm.bdf:10: contradiction");
  // A sheet that flies freely.
  const FeModel sheet = valid_bdf(membrane_strip("PSHELL,1,1,.002\n"));
  EXPECT_EQ(error_of([&] { check_connected(sheet); }).substr(0, 49), "wrong_value");
}

// On a solid a skin is held: it adds E t to the face, and the part is reduced.
TEST(NastranMembranes, SkinOfASolid) {
  const std::string block =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,.5,0.\nGRID,4,,0.,.5,0.\nGRID,5,,0.,0.,.2\n"
      "GRID,6,,1.,0.,.2\nGRID,7,,1.,.5,.2\nGRID,8,,0.,.5,.2\nCHEXA,1,2,1,2,3,4,5,6,+\n+,7,8\n"
      "PSOLID,2,1\nMAT1,1,7.+10,,.25,2700.\n";
  const FeSystem bare = assemble(valid_bdf(block)),
                 skinned = assemble(valid_bdf(block + "CQUAD4,9,1,5,6,7,8\nPSHELL,1,1,.002\n"));
  ASSERT_EQ(bare.size(), skinned.size());
  const MatX K = MatX(skinned.K - bare.K);
  VecX u = VecX::Zero(24);
  for (const int k : {5, 6}) u(skinned.row(k, 0)) = 1.0;
  for (const int k : {6, 7}) u(skinned.row(k, 1)) = -sheet_poisson * .5;
  EXPECT_NEAR(u.dot(K * u), sheet_young * sheet_thickness * .5,
              1e-6 * sheet_young * sheet_thickness);
  EXPECT_LT(K.topLeftCorner(12, 12).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace floatframe::test

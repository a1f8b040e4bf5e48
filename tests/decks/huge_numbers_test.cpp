// Numbers that a deck may write, but whose sums, products or squares are not finite: an error with
// its line, not a part without them.
#include <gtest/gtest.h>

#include "decks/ansys_deck.hpp"
#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string huge_material = "*MATERIAL, NAME=M\n*ELASTIC\n7e10, .25\n*DENSITY\n2700.\n";

std::string huge_error(const std::string& text) { return inp_error(text, {}, "huge.inp"); }

/// A beam along x; the section begins in line 11.
std::string huge_stick(const std::string& section) {
  return "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=S\n1, 1, 2\n" +
         huge_material + section;
}

TEST(HugeNumbers, OffsetsOfBeams) {
  const std::string square = "*BEAM SECTION, ELSET=S, MATERIAL=M, SECTION=RECT\n.1, .1\n";
  EXPECT_EQ(huge_error(huge_stick(square + "0., 1., 0.\n*BEAM SECTION OFFSET\n1e300, 0.\n")),
            "huge.inp:11: not_finite");
  EXPECT_EQ(huge_error(huge_stick("*BEAM SECTION, ELSET=S, MATERIAL=M, SECTION=RECT, "
                                  "OFFSET2=1e308\n100., 100.\n0., 1., 0.\n")),
            "huge.inp:11: not_finite");
  EXPECT_EQ(huge_error(huge_stick("*BEAM GENERAL SECTION, ELSET=S, SECTION=GENERAL\n.01, 1e-5, 0., "
                                  "2e-5, 1e-6\n0., 1., 0.\n2e11, 8e10\n*CENTROID\n0., 1e300\n"
                                  "*SHEAR CENTER\n0., 2.\n")),
            "huge.inp:11: not_finite");
  // A direction 1 of that size is a direction.
  const FeModel m = read_inp(huge_stick(square + "0., 1e300, 0.\n*BEAM SECTION OFFSET\n.5, 0.\n"));
  ASSERT_EQ(m.nodes(), 4);
  EXPECT_LE((m.positions[2] - Vec3(0, .5, 0)).norm(), 1e-15);
}

TEST(HugeNumbers, SectionsOfBeams) {
  EXPECT_EQ(
      huge_error(huge_stick("*BEAM SECTION, ELSET=S, MATERIAL=M, SECTION=RECT\n1e80, 1e80\n")),
      "huge.inp:11: not_finite");
}

/// A cube and a plate apart from it; sections begin in line 20.
const std::string huge_things =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
    "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n*ELEMENT, TYPE=C3D8, ELSET=CUBE\n"
    "1, 1, 2, 3, 4, 5, 6, 7, 8\n*ELEMENT, TYPE=S4, ELSET=PLATE\n2, 1, 2, 3, 4\n" +
    huge_material + "*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n";

TEST(HugeNumbers, LayersOfShells) {
  const auto error = [](const std::string& plate) { return huge_error(huge_things + plate); };
  EXPECT_EQ(error("*SHELL SECTION, ELSET=PLATE, COMPOSITE\n1e308, 3, M\n1e308, 3, M\n"),
            "huge.inp:20: not_finite");
  EXPECT_EQ(error("*SHELL SECTION, ELSET=PLATE, MATERIAL=M, NODAL THICKNESS\n*NODAL THICKNESS\n"
                  "1, 1e308\n2, 1e308\n3, 1e308\n4, 1e308\n"),
            "huge.inp:20: not_finite");
}

TEST(HugeNumbers, NonstructuralMass) {
  const std::string plate = "*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n.01\n";
  const auto error = [&](const std::string& more) {
    return huge_error(huge_things + plate + "*NONSTRUCTURAL MASS, ELSET=" + more);
  };
  EXPECT_EQ(error("PLATE, UNITS=TOTAL MASS, DISTRIBUTION=VOLUME PROPORTIONAL\n1.7e308\n"),
            "huge.inp:22: not_finite");
  EXPECT_EQ(huge_error("*NODE\n1, 0., 0.\n2, 4., 0.\n3, 4., 4.\n4, 0., 4.\n*ELEMENT, TYPE=S4, "
                       "ELSET=PLATE\n2, 1, 2, 3, 4\n" +
                       huge_material + plate +
                       "*NONSTRUCTURAL MASS, ELSET=PLATE, UNITS=MASS PER AREA\n1e308\n"),
            "huge.inp:15: not_finite");
  EXPECT_EQ(error("CUBE, UNITS=MASS PER VOLUME\n1e308\n*NONSTRUCTURAL MASS, ELSET=CUBE, "
                  "UNITS=MASS PER VOLUME\n1e308\n"),
            "huge.inp:24: not_finite");
}

const std::string huge_block = cdb_square + cdb_steel;  // 18 lines

TEST(HugeNumbers, LayersOfAnsys) {
  const std::string layers = "SECTYPE,1,SHELL\nSECDATA,1e308,1\nSECDATA,1e308,1,90\n";
  EXPECT_EQ(ansys_error("ET,1,190\n" + huge_block + layers + "E,1,2,3,4,5,6,7,8\n"),
            "a.cdb:20: not_finite");
  EXPECT_EQ(ansys_error("ET,1,181\n" + huge_block + layers + "E,1,2,3,4\n"),
            "a.cdb:20: not_finite");
}

TEST(HugeNumbers, PlacesAndMaterials) {
  EXPECT_EQ(huge_error("*NODE\n1, 0., 0., 0.\n2, 1e308, 0., 0.\n*ELEMENT, TYPE=B31, ELSET=S\n1, 1, "
                       "2\n"),
            "huge.inp:3: not_finite");
  EXPECT_EQ(ansys_error("ET,1,185\nN,1,0,1e160\n"), "a.cdb:2: not_finite");
  const auto stick_of = [](const std::string& material) {
    return huge_error(
        "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*ELEMENT, TYPE=T3D2, ELSET=S\n1, 1, 2\n"
        "*MATERIAL, NAME=M\n" +
        material + "*SOLID SECTION, ELSET=S, MATERIAL=M\n1.\n");
  };
  EXPECT_EQ(stick_of("*ELASTIC\n1., 0.\n*DENSITY\n1e308\n"), "huge.inp:6: not_finite");
  EXPECT_EQ(stick_of("*ELASTIC\n1e300, 0.\n*DENSITY\n1.\n"), "huge.inp:6: not_finite");
  EXPECT_EQ(ansys_error(cdb_brick + "MP,EX,1,2e5\nMP,PRXY,1,.3\nMP,DENS,1,1e200\n"),
            "a.cdb:11: not_finite");
}

TEST(HugeNumbers, PointMasses) {
  EXPECT_EQ(
      huge_error(huge_stick("*BEAM SECTION, ELSET=S, MATERIAL=M, SECTION=RECT\n.1, .1\n0., 1., "
                            "0.\n*ELEMENT, TYPE=MASS, ELSET=P\n2, 1\n*MASS, ELSET=P\n1e308\n")),
      "huge.inp:16: not_finite");
  EXPECT_EQ(ansys_error(cdb_brick + cdb_steel + "ET,2,21\nKEYOPT,2,3,2\nTYPE,2\nR,1,1e308\nE,1\n"),
            "a.cdb:25: not_finite");
}

TEST(HugeNumbers, BeamsOfAnsys) {
  const std::string beam = "ET,1,188\n" + huge_block + "SECTYPE,1,BEAM,RECT\nSECDATA,";
  EXPECT_EQ(ansys_error(beam + "1e160,1\nE,1,2\n"), "a.cdb:20: geometry");
  EXPECT_EQ(ansys_error(beam + "1,1\nSECOFFSET,USER,1e200\nE,1,2\n"), "a.cdb:23: not_finite");
  EXPECT_EQ(ansys_error("ET,1,180\n" + huge_block + "R,1,1e-10,1e300\nE,1,2\n"),
            "a.cdb:21: not_finite");
}

TEST(HugeNumbers, MatricesOfAnsys) {
  for (const char* kind : {"4", "2"}) {
    EXPECT_EQ(ansys_error(cdb_brick + cdb_steel + "ET,2,27\nKEYOPT,2,3," + kind +
                          "\nR,7,1e308\nTYPE,2\nREAL,7\nE,1,2\n"),
              "a.cdb:23: not_finite");
  }
}

}  // namespace
}  // namespace floatframe::test

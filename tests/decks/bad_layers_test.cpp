// Invalid materials with axes, orientations and layers, each with the whole sentence it must give.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

struct LayerCase {
  const char *from, *to, *sentence;
};

const std::string inp =
    "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.\n"  // 1 to 5
    "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n"                       // 6, 7
    "*MATERIAL, NAME=PLY\n"                                                // 8
    "*ELASTIC, TYPE=LAMINA\n"                                              // 9
    "1.4e5, 1.e4, .3, 5000., 5000., 3000.\n"                               // 10
    "*DENSITY\n1.6e-9\n"                                                   // 11, 12
    "*ORIENTATION, NAME=O\n"                                               // 13
    "1., 0., 0., 0., 1., 0.\n3, 10.\n"                                     // 14, 15
    "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=O\n"               // 16
    "1., 3, PLY, 0.\n2., 3, PLY, 45.\n";                                   // 17, 18

const std::string bdf =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\n"  // 1 to 4
    "MAT8,1,1.4+5,1.+4,.3,5000.,5000.,3000.,1.6-9\n"                            // 5
    "MAT1,2,500.,,.25,1.-10\n"                                                  // 6
    "CQUAD4,1,3,1,2,3,4,10.\n"                                                  // 7
    "PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n";                                          // 8, 9

std::string layers_with(std::string text, const LayerCase& c) {
  const std::size_t at = text.find(c.from);
  EXPECT_NE(at, std::string::npos) << c.from;
  return at == std::string::npos ? text : text.replace(at, std::string(c.from).size(), c.to);
}

std::string inp_error(const std::string& text, DeckDialect dialect = DeckDialect::by_content) {
  return error_of([&] {
    TextSource source(text, "deck.inp");
    FeReadOptions options;
    options.dialect = dialect;
    validate(read_abaqus(source, options));
  });
}

std::string bdf_error(const std::string& text) {
  return error_of([&] {
    TextSource source(text, "deck.bdf");
    validate(read_nastran(source, false, {}));
  });
}

const char* const lamina = "*ELASTIC, TYPE=LAMINA\n1.4e5, 1.e4, .3, 5000., 5000., 3000.\n";
const char* const section = "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=O\n";
const char* const ortho = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n";

TEST(BadLayers, AbaqusDecks) {
  ASSERT_EQ(inp_error(inp), "no error");
  const std::string constants = std::string(ortho) + "1e5, 1e4, 1e4, .3, .3, .4, 5e3, 5e3,\n3e3\n";
  ASSERT_EQ(inp_error(layers_with(inp, {lamina, constants.c_str(), ""})), "no error");
  const LayerCase cases[] = {
      {"TYPE=LAMINA", "TYPE=SHEAR",
       "deck.inp:9: *ELASTIC has the type 'SHEAR', expected ISOTROPIC, ENGINEERING CONSTANTS, "
       "ORTHOTROPIC, ANISOTROPIC or LAMINA"},
      {"1.4e5, 1.e4, .3, 5000., 5000., 3000.\n", "1.4e5, 1.e4, .3\n",
       "deck.inp:9: *ELASTIC has no constant 4 of 6: eight stand in a line"},
      {"1.4e5, 1.e4, .3", "0., 1.e4, .3",
       "deck.inp:9: *ELASTIC TYPE=LAMINA: E1 is 0, expected more than 0"},
      {"1.4e5, 1.e4, .3", "1.4e5, -1.e4, .3",
       "deck.inp:9: *ELASTIC TYPE=LAMINA: E2 is -10000, expected more than 0"},
      {"1.4e5, 1.e4, .3", "1.4e5, 1.e4, 4.",
       "deck.inp:9: *ELASTIC TYPE=LAMINA: NU12 is 4, expected a size below 3.74166, the root of "
       "E1/E2"},
      {".3, 5000.,", ".3, 0.,", "deck.inp:9: *ELASTIC TYPE=LAMINA: G12 is 0, expected more than 0"},
      {"1.e4, .3", "1.e4, a", "deck.inp:10: elastic constant 3: 'a' is not a number"},
      {"5000., 3000.\n", "5000., 3000., 20.\n1.3e5, 1.e4, .3, 5000., 5000., 3000., 80.\n",
       "deck.inp:9: *ELASTIC depends on the temperature (20 to 80): say at which one with "
       "--temperature (key `temperature`)"},
      {"*DENSITY\n", "*ELASTIC\n2e5, .3\n*DENSITY\n",
       "deck.inp:11: *ELASTIC is given a second time for its material"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e4, 1e4, .3, .3, .4, 5e3, 5e3\n",
       "deck.inp:9: *ELASTIC has 8 constants, expected 9"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e4, 1e4, .3, .3, 1.2, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: *ELASTIC TYPE=ENGINEERINGCONSTANTS: NU23 is 1.2, expected a size below 1, the "
       "root of E2/E3"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e5, 1e5, .6, .6, .6, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: *ELASTIC TYPE=ENGINEERINGCONSTANTS: NU12, NU13 and NU23 are 0.6, 0.6 and 0.6, "
       "which together are too large: 1 - NU12 NU21 - NU23 NU32 - NU13 NU31 - 2 NU21 NU32 NU13 is "
       "-0.512, expected more than 0"},
      {lamina, "*ELASTIC, TYPE=ORTHO\n1e5, 2e5, 1e5, 1e4, 1e4, 1e5, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: *ELASTIC TYPE=ORTHO: D1122 is 200000, expected a size below 100000, the root "
       "of D1111 D2222"},
      {lamina, "*ELASTIC, TYPE=ORTHOTROPIC\n1e5, 1e4, 1e5, 1e4, 1e4, 1e5, 5e3, 5e3,\n-3e3\n",
       "deck.inp:9: *ELASTIC TYPE=ORTHOTROPIC: D2323 is -3000, expected more than 0"},
      {lamina, "*ELASTIC, TYPE=ORTHO\n1e5, 9e4, 1e5, 9e4, -9e4, 1e5, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: *ELASTIC TYPE=ORTHO: D3333 is 100000, too small for the constants before it: "
       "the matrix is not positive definite"},
      {lamina,
       "*ELASTIC, TYPE=ANISO\n9e4, 3e4, 8e4, 3e4, 3e4, 7e4, 0., 0.,\n0., 3e4, 0., 0., 0., 0., 2e4, "
       "0.,\n0., 0., 9e4, 0., 2e4\n",
       "deck.inp:9: *ELASTIC TYPE=ANISO: D1223 is 90000, expected a size below 24494.9, the root "
       "of "
       "D1212 D2323"},
      {"*ORIENTATION, NAME=O\n", "*ORIENTATION\n",
       "deck.inp:13: *ORIENTATION needs the parameter NAME"},
      {"NAME=O\n", "NAME=O, NAME=P\n", "deck.inp:13: *ORIENTATION has the parameter NAME twice"},
      {"NAME=O\n", "NAME=O, SYSTEM=SPHERICAL\n",
       "deck.inp:13: *ORIENTATION has the system 'SPHERICAL', expected RECTANGULAR, Z RECTANGULAR "
       "or CYLINDRICAL"},
      {"NAME=O\n", "NAME=O, DEFINITION=OFFSET TO NODES\n",
       "deck.inp:13: *ORIENTATION has the definition 'OFFSET TO NODES', expected COORDINATES"},
      {"1., 0., 0., 0., 1., 0.\n3, 10.", "1., 0., 0., 2., 0., 0.\n3, 10.",
       "deck.inp:13: *ORIENTATION has its points a, b and the origin on a line"},
      {"NAME=O\n1., 0., 0., 0., 1., 0.", "NAME=O, SYSTEM=CYLINDRICAL\n1., 0., 0., 1., 0., 0.",
       "deck.inp:13: *ORIENTATION has the same point for a and b"},
      {"1., 0., 0., 0., 1., 0.\n3, 10.", "1., 0., 0.\n3, 10.",
       "deck.inp:13: *ORIENTATION has 3 coordinates, expected those of the points a and b"},
      {"3, 10.", "4, 10.", "deck.inp:13: *ORIENTATION turns about axis 4, expected 1, 2 or 3"},
      {"3, 10.", "3, x", "deck.inp:15: additional rotation: 'x' is not a number"},
      {"3, 10.\n", "3, 10.\n*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n",
       "deck.inp:16: *ORIENTATION names the orientation 'O' a second time (deck.inp:13)"},
      {"ORIENTATION=O\n", "ORIENTATION=P\n",
       "deck.inp:16: *SHELL SECTION names the orientation 'P', which does not exist"},
      {"1., 3, PLY, 0.\n2., 3, PLY, 45.\n", "", "deck.inp:16: *SHELL SECTION has no plies"},
      {"1., 3, PLY, 0.", "0., 3, PLY, 0.",
       "deck.inp:17: thickness of ply 1 is 0, expected more than 0"},
      {"2., 3, PLY, 45.", "2., 3", "deck.inp:18: ply 2 names no material (third entry)"},
      {"2., 3, PLY, 45.", "2., 3, PLI, 45.",
       "deck.inp:16: *SHELL SECTION names the material 'PLI', which does not exist, did you mean "
       "'PLY'?"},
      {"2., 3, PLY, 45.", "2., 3, PLY, Q",
       "deck.inp:16: *SHELL SECTION names the orientation 'Q', which does not exist"},
      {"COMPOSITE, ORIENTATION=O\n", "COMPOSITE, MATERIAL=PLY\n",
       "deck.inp:16: *SHELL SECTION has COMPOSITE and a material: those of the plies are in its "
       "lines"},
      {"COMPOSITE, ORIENTATION=O\n1., 3, PLY, 0.\n2., 3, PLY, 45.\n",
       "MATERIAL=PLY, SYMMETRIC\n1.\n",
       "deck.inp:16: *SHELL SECTION is SYMMETRIC without COMPOSITE"},
      {"ORIENTATION=O\n1.", "ORIENTATION=O, OFFSET=TOP\n1.",
       "deck.inp:16: *SHELL SECTION has the offset 'TOP', expected SPOS, SNEG or a number"},
      {"*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n",
       "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n*NODE\n9, 0., 0., 1.\n*ELEMENT, TYPE=C3D4, "
       "ELSET=B\n2, 1, 2, 3, 9\n*SOLID SECTION, ELSET=B, MATERIAL=PLY\n",
       "deck.inp:12: *SOLID SECTION: material 'PLY' is a lamina, which only shells can have"},
      {"*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n",
       "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=B31, ELSET=B\n2, 1, 2\n*BEAM "
       "SECTION, ELSET=B, MATERIAL=PLY, SECTION=RECT\n1., 1.\n",
       "deck.inp:10: *BEAM SECTION: material 'PLY' is not isotropic, which beams must be"},
      {section, "*SOLID SECTION, ELSET=SKIN, COMPOSITE\n",
       "deck.inp:16: *SOLID SECTION has the parameter 'COMPOSITE', which is not supported"},
  };
  for (const LayerCase& c : cases) EXPECT_EQ(inp_error(layers_with(inp, c)), c.sentence) << c.to;
  const std::string first = layers_with(inp, {"3, 10.\n", "", ""});
  EXPECT_EQ(inp_error(first), "no error");
  EXPECT_EQ(inp_error(first, DeckDialect::abaqus),
            "deck.inp:13: orientation 'O' is used for shells and has no second line (axis and "
            "angle of the additional rotation)");
  EXPECT_EQ(inp_error(layers_with(inp, {"3, 10.", "1, 10.", ""}), DeckDialect::calculix),
            "deck.inp:13: orientation 'O' is used for shells and turns about axis 1; of CalculiX "
            "decks only turns about axis 3, the normal, are read");
}

TEST(BadLayers, NastranDecks) {
  ASSERT_EQ(bdf_error(bdf), "no error");
  const char* const mat8 = "MAT8,1,1.4+5,1.+4,.3,5000.,5000.,3000.,1.6-9";
  const LayerCase cases[] = {
      {"MAT8,1,1.4+5,", "MAT8,1,,", "deck.bdf:5: MAT8 1: E1 is missing"},
      {"MAT8,1,1.4+5,1.+4", "MAT8,1,1.4+5,-1.+4",
       "deck.bdf:5: MAT8 1: E2 is -10000, expected more than 0"},
      {".3,5000.,", ".3,,", "deck.bdf:5: MAT8 1: G12 is 0, expected more than 0"},
      {"1.+4,.3,", "1.+4,3.8,",
       "deck.bdf:5: MAT8 1: NU12 is 3.8, expected a size below 3.74166, the root of E1/E2"},
      {"3000.,1.6-9", "3000.,-1.6-9",
       "deck.bdf:5: MAT8 1: RHO is -1.6e-09, expected no negative density"},
      {mat8, "MAT2,1,1.+5,1.+5,,1.+4,,5000.,1.6-9",
       "deck.bdf:5: MAT2 1: G12 is 100000, expected a size below 31622.8, the root of G11 G22"},
      {mat8, "MAT2,1,1.+5,,,1.+4,,,1.6-9", "deck.bdf:5: MAT2 1: G33 is 0, expected more than 0"},
      {mat8, "MAT9,1,1.+5", "deck.bdf:5: MAT9 1: G22 is 0, expected more than 0"},
      {"MAT1,2,500.,,.25,1.-10\n", "MAT8,1,1.4+5,1.+4,.3,5000.\n",
       "deck.bdf:6: MAT8 1: this number is in the file twice, first in line 5"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PCOMP,3\n", "deck.bdf:8: PCOMP 3: it has no plies"},
      {",1,1.,0.", ",,1.,0.", "deck.bdf:9: PCOMP 3: the material of ply 1 is missing"},
      {",1,1.,0.", ",1,,0.", "deck.bdf:9: PCOMP 3: the thickness of ply 1 is missing"},
      {"2,2.,0.\n", "2,-2.,0.\n",
       "deck.bdf:8: PCOMP 3: the thickness of ply 2 is -2, expected more than 0"},
      {"2,2.,0.\n", "2,2.,a\n", "deck.bdf:9: PCOMP 3: the angle of ply 2: 'a' is not a number"},
      {"2,2.,0.\n", "5,2.,0.\n", "deck.bdf:8: PCOMP: material 5 is not in the file"},
      {"PCOMP,3\n", "PCOMP,3,,,,,,,BEND\n",
       "deck.bdf:8: PCOMP 3: LAM is 'BEND', expected blank, SYM, MEM or SMEAR (BEND has no "
       "stiffness in the plane)"},
      {"CQUAD4,1,3,1,2,3,4,10.", "CQUAD4,1,3,1,2,3,4,9",
       "deck.bdf:7: coordinate system 9 is not in the file"},
      {"CQUAD4,1,3,1,2,3,4,10.", "CORD2C,9,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCQUAD4,1,3,1,2,3,4,9",
       "deck.bdf:9: CQUAD4 1: its material system MCID 9 is cylindrical or spherical, expected a "
       "rectangular one"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n", "CQUAD4,1,3,1,2,3,4,10.,.5\nPCOMP,3,-1.\n",
       "deck.bdf:7: CQUAD4 1: it has an offset ZOFFS, and its PCOMP 3 a Z0 of -1: give one of "
       "them"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,,,1\n",
       "deck.bdf:8: PSHELL 3: MID3 is '1', but MID2 is blank: a membrane has neither bending nor "
       "transverse shear"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,,1.,1\n",
       "deck.bdf:8: PSHELL 3: MID1 is blank: a plate without stiffness in its plane is not "
       "supported"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,-2.\n",
       "deck.bdf:8: PSHELL 3: 12I/T**3 is -2, expected more than 0"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,1,-1.\n",
       "deck.bdf:8: PSHELL 3: TS/T is '-1.', expected more than 0"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,2\n",
       "deck.bdf:8: PSHELL 3: MID3 is not MID1: that is read of MAT1 only"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,,\n,,,2\n",
       "deck.bdf:8: PSHELL 3: MID4 is 2, expected a MAT2"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,-1\n",
       "deck.bdf:8: PSHELL 3: MID2 is -1: plane strain is not supported"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "GRID,5,,0.,0.,1.\nCTETRA,1,3,1,2,3,5\nPSOLID,3,1\n",
       "deck.bdf:9: PSOLID: material 1 is a MAT8, expected a MAT1 or MAT9"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "CBAR,1,3,1,2,0.,0.,1.\nPBAR,3,1,1.,1.,1.,1.\n",
       "deck.bdf:8: PBAR: material 1 is a MAT8, expected a MAT1"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "MAT9,5,9.,,,,,,9.\n,,,,,9.\n,9.,,,9.,,9.,1.\nGRID,5,,0.,0.,1.\nCTETRA,1,3,1,2,3,5\n"
       "PSOLID,3,5,-1\n",
       "deck.bdf:12: PSOLID: CORDM is -1: axes of the element are not read, give a coordinate "
       "system"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "PSHELL,3,5,1.,5\nMAT9,5,9.,,,,,,9.\n,,,,,9.\n,9.,,,9.,,9.,1.\n",
       "deck.bdf:8: PSHELL: material 5 is a MAT9, expected a MAT1, MAT2 or MAT8"},
  };
  for (const LayerCase& c : cases) EXPECT_EQ(bdf_error(layers_with(bdf, c)), c.sentence) << c.to;
}

}  // namespace
}  // namespace floatframe::test

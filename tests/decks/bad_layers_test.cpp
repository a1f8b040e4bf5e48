// Invalid materials with axes, orientations and layers, each with the code and place of its error.
#include <gtest/gtest.h>

#include <string>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

struct LayerCase {
  const char *from, *to, *expected;
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

const char* const lamina = "*ELASTIC, TYPE=LAMINA\n1.4e5, 1.e4, .3, 5000., 5000., 3000.\n";
const char* const section = "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=O\n";
const char* const ortho = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n";

TEST(BadLayers, AbaqusDecks) {
  ASSERT_EQ(invalid_inp(inp), "no error");
  const std::string constants = std::string(ortho) + "1e5, 1e4, 1e4, .3, .3, .4, 5e3, 5e3,\n3e3\n";
  ASSERT_EQ(invalid_inp(layers_with(inp, {lamina, constants.c_str(), ""})), "no error");
  const LayerCase cases[] = {
      {"TYPE=LAMINA", "TYPE=SHEAR", "deck.inp:9: wrong_value"},
      {"1.4e5, 1.e4, .3, 5000., 5000., 3000.\n", "1.4e5, 1.e4, .3\n", "deck.inp:9: missing"},
      {"1.4e5, 1.e4, .3", "0., 1.e4, .3", "deck.inp:9: wrong_value"},
      {"1.4e5, 1.e4, .3", "1.4e5, -1.e4, .3", "deck.inp:9: wrong_value"},
      {"1.4e5, 1.e4, .3", "1.4e5, 1.e4, 4.", "deck.inp:9: wrong_value"},
      {".3, 5000.,", ".3, 0.,", "deck.inp:9: wrong_value"},
      {"1.e4, .3", "1.e4, a", "deck.inp:10: not_a_number"},
      {"5000., 3000.\n", "5000., 3000., 20.\n1.3e5, 1.e4, .3, 5000., 5000., 3000., 80.\n",
       "deck.inp:9: incomplete"},
      {"*DENSITY\n", "*ELASTIC\n2e5, .3\n*DENSITY\n", "deck.inp:11: duplicate"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e4, 1e4, .3, .3, .4, 5e3, 5e3\n",
       "deck.inp:9: wrong_count"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e4, 1e4, .3, .3, 1.2, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: wrong_value"},
      {lamina, "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1e5, 1e5, 1e5, .6, .6, .6, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: wrong_value"},
      {lamina, "*ELASTIC, TYPE=ORTHO\n1e5, 2e5, 1e5, 1e4, 1e4, 1e5, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: wrong_value"},
      {lamina, "*ELASTIC, TYPE=ORTHOTROPIC\n1e5, 1e4, 1e5, 1e4, 1e4, 1e5, 5e3, 5e3,\n-3e3\n",
       "deck.inp:9: wrong_value"},
      {lamina, "*ELASTIC, TYPE=ORTHO\n1e5, 9e4, 1e5, 9e4, -9e4, 1e5, 5e3, 5e3,\n3e3\n",
       "deck.inp:9: wrong_value"},
      {lamina,
       "*ELASTIC, TYPE=ANISO\n9e4, 3e4, 8e4, 3e4, 3e4, 7e4, 0., 0.,\n0., 3e4, 0., 0., 0., 0., 2e4, "
       "0.,\n0., 0., 9e4, 0., 2e4\n",
       "deck.inp:9: wrong_value"},
      {"*ORIENTATION, NAME=O\n", "*ORIENTATION\n", "deck.inp:13: incomplete"},
      {"NAME=O\n", "NAME=O, NAME=P\n", "deck.inp:13: duplicate"},
      {"NAME=O\n", "NAME=O, SYSTEM=SPHERICAL\n", "deck.inp:13: wrong_value"},
      {"NAME=O\n", "NAME=O, DEFINITION=OFFSET TO NODES\n", "deck.inp:13: wrong_value"},
      {"1., 0., 0., 0., 1., 0.\n3, 10.", "1., 0., 0., 2., 0., 0.\n3, 10.",
       "deck.inp:13: wrong_value"},
      {"NAME=O\n1., 0., 0., 0., 1., 0.", "NAME=O, SYSTEM=CYLINDRICAL\n1., 0., 0., 1., 0., 0.",
       "deck.inp:13: wrong_value"},
      {"1., 0., 0., 0., 1., 0.\n3, 10.", "1., 0., 0.\n3, 10.", "deck.inp:13: wrong_count"},
      {"3, 10.", "4, 10.", "deck.inp:13: out_of_range"},
      {"3, 10.", "3, x", "deck.inp:15: not_a_number"},
      {"3, 10.\n", "3, 10.\n*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n",
       "deck.inp:16: duplicate"},
      {"ORIENTATION=O\n", "ORIENTATION=P\n", "deck.inp:16: not_found"},
      {"1., 3, PLY, 0.\n2., 3, PLY, 45.\n", "", "deck.inp:16: missing"},
      {"1., 3, PLY, 0.", "0., 3, PLY, 0.", "deck.inp:17: out_of_range"},
      {"2., 3, PLY, 45.", "2., 3", "deck.inp:18: missing"},
      {"2., 3, PLY, 45.", "2., 3, PLI, 45.", "deck.inp:16: not_found"},
      {"2., 3, PLY, 45.", "2., 3, PLY, Q", "deck.inp:16: not_found"},
      {"COMPOSITE, ORIENTATION=O\n", "COMPOSITE, MATERIAL=PLY\n", "deck.inp:16: exclusive"},
      {"COMPOSITE, ORIENTATION=O\n1., 3, PLY, 0.\n2., 3, PLY, 45.\n",
       "MATERIAL=PLY, SYMMETRIC\n1.\n", "deck.inp:16: incomplete"},
      {"ORIENTATION=O\n1.", "ORIENTATION=O, OFFSET=TOP\n1.", "deck.inp:16: wrong_value"},
      {"*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n",
       "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n*NODE\n9, 0., 0., 1.\n*ELEMENT, TYPE=C3D4, "
       "ELSET=B\n2, 1, 2, 3, 9\n*SOLID SECTION, ELSET=B, MATERIAL=PLY\n",
       "deck.inp:12: unsupported"},
      {"*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n",
       "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=B31, ELSET=B\n2, 1, 2\n*BEAM "
       "SECTION, ELSET=B, MATERIAL=PLY, SECTION=RECT\n1., 1.\n",
       "deck.inp:10: unsupported"},
      {section, "*SOLID SECTION, ELSET=SKIN, COMPOSITE\n", "deck.inp:16: unsupported"},
  };
  for (const LayerCase& c : cases) EXPECT_EQ(invalid_inp(layers_with(inp, c)), c.expected) << c.to;
  const std::string first = layers_with(inp, {"3, 10.\n", "", ""});
  EXPECT_EQ(invalid_inp(first), "no error");
  EXPECT_EQ(invalid_inp(first, of_dialect(DeckDialect::abaqus)), "deck.inp:13: missing");
  EXPECT_EQ(
      invalid_inp(layers_with(inp, {"3, 10.", "1, 10.", ""}), of_dialect(DeckDialect::calculix)),
      "deck.inp:13: unsupported");
}

TEST(BadLayers, NastranDecks) {
  ASSERT_EQ(invalid_bdf(bdf), "no error");
  const char* const mat8 = "MAT8,1,1.4+5,1.+4,.3,5000.,5000.,3000.,1.6-9";
  const LayerCase cases[] = {
      {"MAT8,1,1.4+5,", "MAT8,1,,", "arm.bdf:5: missing"},
      {"MAT8,1,1.4+5,1.+4", "MAT8,1,1.4+5,-1.+4", "arm.bdf:5: wrong_value"},
      {".3,5000.,", ".3,,", "arm.bdf:5: wrong_value"},
      {"1.+4,.3,", "1.+4,3.8,", "arm.bdf:5: wrong_value"},
      {"3000.,1.6-9", "3000.,-1.6-9", "arm.bdf:5: out_of_range"},
      {mat8, "MAT2,1,1.+5,1.+5,,1.+4,,5000.,1.6-9", "arm.bdf:5: wrong_value"},
      {mat8, "MAT2,1,1.+5,,,1.+4,,,1.6-9", "arm.bdf:5: wrong_value"},
      {mat8, "MAT9,1,1.+5", "arm.bdf:5: wrong_value"},
      {"MAT1,2,500.,,.25,1.-10\n", "MAT8,1,1.4+5,1.+4,.3,5000.\n", "arm.bdf:6: duplicate"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PCOMP,3\n", "arm.bdf:8: missing"},
      {",1,1.,0.", ",,1.,0.", "arm.bdf:9: missing"},
      {",1,1.,0.", ",1,,0.", "arm.bdf:9: missing"},
      {"2,2.,0.\n", "2,-2.,0.\n", "arm.bdf:8: out_of_range"},
      {"2,2.,0.\n", "2,2.,a\n", "arm.bdf:9: not_a_number"},
      {"2,2.,0.\n", "5,2.,0.\n", "arm.bdf:8: not_found"},
      {"PCOMP,3\n", "PCOMP,3,,,,,,,BEND\n", "arm.bdf:8: wrong_value"},
      {"CQUAD4,1,3,1,2,3,4,10.", "CQUAD4,1,3,1,2,3,4,9", "arm.bdf:7: not_found"},
      {"CQUAD4,1,3,1,2,3,4,10.", "CORD2C,9,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCQUAD4,1,3,1,2,3,4,9",
       "arm.bdf:9: unsupported"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n", "CQUAD4,1,3,1,2,3,4,10.,.5\nPCOMP,3,-1.\n",
       "arm.bdf:7: exclusive"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,,,1\n", "arm.bdf:8: contradiction"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,,1.,1\n", "arm.bdf:8: unsupported"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,-2.\n", "arm.bdf:8: out_of_range"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,1,-1.\n", "arm.bdf:8: out_of_range"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,2\n", "arm.bdf:8: unsupported"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,1,,,\n,,,2\n", "arm.bdf:8: wrong_value"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n", "PSHELL,3,1,1.,-1\n", "arm.bdf:8: unsupported"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "GRID,5,,0.,0.,1.\nCTETRA,1,3,1,2,3,5\nPSOLID,3,1\n", "arm.bdf:9: wrong_value"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "CBAR,1,3,1,2,0.,0.,1.\nPBAR,3,1,1.,1.,1.,1.\n", "arm.bdf:8: wrong_value"},
      {"CQUAD4,1,3,1,2,3,4,10.\nPCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "MAT9,5,9.,,,,,,9.\n,,,,,9.\n,9.,,,9.,,9.,1.\nGRID,5,,0.,0.,1.\nCTETRA,1,3,1,2,3,5\n"
       "PSOLID,3,5,-1\n",
       "arm.bdf:12: unsupported"},
      {"PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n",
       "PSHELL,3,5,1.,5\nMAT9,5,9.,,,,,,9.\n,,,,,9.\n,9.,,,9.,,9.,1.\n", "arm.bdf:8: wrong_value"},
  };
  for (const LayerCase& c : cases) EXPECT_EQ(invalid_bdf(layers_with(bdf, c)), c.expected) << c.to;
}

}  // namespace
}  // namespace floatframe::test

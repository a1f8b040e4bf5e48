// Invalid decks and matrices of Nastran: each gives the whole sentence with file and line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

std::string deck_error(const std::string& text) {
  return error_of([&] {
    TextSource source(text, "arm.bdf");
    read_nastran(source, has_begin_bulk(text), {});
  });
}

struct Error {
  const char* from;
  const char* to;
  const char* sentence;
};

const char* const deck =
    "$ a bar, a tetrahedron and what holds them\n"  // 1
    "GRID,1,,0.,0.,0.\n"                            // 2
    "GRID,2,,1.,0.,0.\n"                            // 3
    "GRID,3,,0.,1.,0.\n"                            // 4
    "GRID,4,,0.,0.,1.\n"                            // 5
    "CTETRA,1,1,1,2,3,4\n"                          // 6
    "CBAR,2,2,1,2,0.,0.,1.\n"                       // 7
    "PSOLID,1,1\n"                                  // 8
    "PBAR,2,1,1.-3,1.-7,1.-7,2.-7\n"                // 9
    "MAT1,1,2.+11,,.3,8000.\n"                      // 10
    "CONM2,7,2,,1.5\n"                              // 11
    "RBE2,8,1,123456,3,4\n"                         // 12
    "SPC1,1,123,1\n"                                // 13
    "ENDDATA\n";

TEST(BadNastran, Decks) {
  ASSERT_EQ(deck_error(deck), "no error");
  const Error errors[] = {
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,44",
       "arm.bdf:6: CTETRA 1 has node 44, which is not in the file"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3", "arm.bdf:6: CTETRA 1: a node is missing"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,4,1,2",
       "arm.bdf:6: CTETRA 1: 2 of its 6 mid-side nodes are given; all or none must be"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,x",
       "arm.bdf:6: CTETRA 1: a node is 'x', expected a whole number from 1"},
      {"CTETRA,1,1", "CHEXX,1,1", "arm.bdf:6: CHEXX is not read and may change stiffness or mass"},
      {"CTETRA,1,1", "CBEND,1,1",
       "arm.bdf:6: CBEND is not read: curved beams are not supported; divide the arc into CBAR "
       "elements"},
      {"CTETRA,1,1", "CTETRA,2,1",
       "arm.bdf:7: CBAR 2: this element number is in the file twice, first in line 6"},
      {"CTETRA,1,1", "CTETRA,1,2", "arm.bdf:6: CTETRA 1: property 2 is a PBAR, expected a PSOLID"},
      {"CTETRA,1,1", "CTETRA,1,5", "arm.bdf:6: CTETRA 1: property 5 is not in the file"},
      {"GRID,2,,1.,0.,0.", "GRID,1,,1.,0.,0.",
       "arm.bdf:3: node 1 is in the file twice, first in line 2"},
      {"GRID,2,,1.,0.,0.", "GRID,99999999999,,1.,0.,0.",
       "arm.bdf:3: GRID: the number of the node is '99999999999', expected a whole number from 1"},
      {"GRID,2,,1.,0.,0.", "GRID,2,,1.,0.,0.,,777",
       "arm.bdf:3: GRID 2: the held components PS are '777', expected some of the digits 1 to 6"},
      {"GRID,2,,1.,0.,0.", "GRID,2,5,1.,0.,0.",
       "arm.bdf:3: coordinate system 5 is not in the file"},
      {"GRID,2,,1.,0.,0.", "CORD2R,6,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,2,6,1.,0.,0.",
       "arm.bdf:3: coordinate system 6 refers to itself through its reference systems, or these "
       "are "
       "more than 100 deep"},
      {"GRID,2,,1.,0.,0.", "CORD2R,6,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,2,6,1.,0.,0.",
       "arm.bdf:3: coordinate system 6: its points A, B and C are on a line"},
      {"GRID,2,,1.,0.,0.", "GRID,2,,1.0.0,0.,0.",
       "arm.bdf:3: GRID 2: a coordinate: '1.0.0' is not a number"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,,8000.",
       "arm.bdf:10: MAT1 1: one of E, G and NU given, expected two"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,-2.+11,,.3,8000.",
       "arm.bdf:10: MAT1 1: E is -2e+11, expected more than 0"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,.5,8000.",
       "arm.bdf:10: MAT1 1: NU is 0.5, expected more than -1 and less than 0.5"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.1+11,7.+10,,8000.",
       "arm.bdf:10: MAT1 1: NU is 0.5 (from E = 2.1e+11 and G = 7e+10), expected more than -1 and "
       "less than 0.5"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,,-7.+10,.3,8000.",
       "arm.bdf:10: MAT1 1: E is -1.82e+11 (from G = -7e+10 and NU = 0.3), expected more than 0"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,-7.+10,,8000.",
       "arm.bdf:10: MAT1 1: G is -7e+10, expected more than 0 where it gives NU with E"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,.3,-1.",
       "arm.bdf:10: MAT1 1: RHO is -1, expected no negative density"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,3,2.+11,,.3,8000.",
       "arm.bdf:8: PSOLID: material 1 is not in the file"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT9,1,2.+11,,.3,8000.",
       "arm.bdf:10: MAT9 1: G22 is 0, expected more than 0"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,DBOX\n,.1,.1,.1,.1",
       "arm.bdf:9: PBARL 2: the section 'DBOX' is not read (BAR, BOX, BOX1, CHAN, CHAN1, CHAN2, "
       "CROSS, H, HAT, I, I1, L, ROD, T, T1, T2, TUBE, TUBE2 and Z are); give A, I1, I2 and J with "
       "PBAR"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,CHAN\n,.1,.1,.1,.1",
       "arm.bdf:9: PBARL 2: the dimensions of the CHAN do not fit: a wall of it would be 0.1 by 0"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,L\n,.1,-.1,.1,.1",
       "arm.bdf:9: PBARL 2: a dimension of the section is negative"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,BOX1\n,.1,.1,.01,.01,.06,.05",
       "arm.bdf:9: PBARL 2: the walls of the BOX1 are thicker than the box"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,BAR\n,.1,.1,0.,3.",
       "arm.bdf:9: PBARL 2: found '3.' after the section, expected YES or NO of a station"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,0.,0.,1.\n,7",
       "arm.bdf:8: CBAR 2: the pins PA are '7', expected some of the digits 1 to 6"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,0.,0.,1.\n,,,x",
       "arm.bdf:8: CBAR 2: the offset WA: 'x' is not a number"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,1.,0.,0.\n,,,-1.,,,-2.",
       "arm.bdf:7: CBAR 2: it has no length, or its orientation vector is along its axis"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBAR,2,1,-1.-3,1.-7",
       "arm.bdf:9: PBAR 2: A is -0.001, expected more than 0\n"
       "arm.bdf:9: PBAR 2: I2 is 0, expected more than 0\n"
       "arm.bdf:9: PBAR 2: J is 0, expected more than 0"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBAR,2,1,1.,.2,.3,.4\n,\n,,,-.4",
       "arm.bdf:9: PBAR 2: I12 is -0.4, I1 is 0.2 and I2 is 0.3, expected I1 and I2 of more than "
       "0 and an I12^2 of less than I1 I2"},
      {"CBAR,2,2,1,2,0.,0.,1.\nPSOLID,1,1\nPBAR,2,1,1.-3,1.-7,1.-7,2.-7",
       "CBEAM,2,2,1,2,0.,0.,1.\nPSOLID,1,1\nPBEAM,2,1,1.,-.2,-.3,.1,.4",
       "arm.bdf:9: PBEAM 2: I12 is 0.1, I1 is -0.2 and I2 is -0.3, expected I1 and I2 of more "
       "than 0 and an I12^2 of less than I1 I2"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,4\nPSHELL,4,1,-.01,1\nCTRIA3,9,4,1,2,3",
       "arm.bdf:7: PSHELL 4: the thickness is -0.01, expected more than 0"},
      {"CONM2,7,2,,1.5", "CONM2,7,2,,-1.5",
       "arm.bdf:11: CONM2 7: the mass is -1.5, expected no negative number"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2",
       "arm.bdf:7: CBAR 2: the orientation vector is missing"},
      {"CONM2,7,2,,1.5", "CONM2,7,4,,1.5,.1", "no error"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,3.,0.,0.",
       "arm.bdf:7: CBAR 2: it has no length, or its orientation vector is along its axis"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456,3,THRU,4",
       "arm.bdf:12: RBE2 8: its list of nodes has THRU, which RBE2 does not know; expected each "
       "node "
       "by its number"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456", "arm.bdf:12: RBE2 8 has no nodes"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,3,123456,4,3",
       "arm.bdf:12: RBE2 8: node 3 depends on itself"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,3,3,123456", "arm.bdf:12: RBAR 8: node 3 depends on itself"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,12,1.,23,3,4\n,2",
       "arm.bdf:12: RBE3 8: the components of its nodes do not define how component 1 of the "
       "reference moves"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,123,0.,123,3,4\n,2",
       "arm.bdf:12: RBE3 8: a weight is 0, expected more than 0"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,123,1.,,3,4",
       "arm.bdf:12: RBE3 8: the components of a weight are missing"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456,3,4\nRBE3,9,,1,3,1.,3,3,4\nMPC,1,1,3,1.,2,3,-1.",
       "arm.bdf:13: RBE3 9: too many of its nodes depend on other rigid elements or equations "
       "already"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,1,2,123,23",
       "arm.bdf:12: RBAR 8: it has 5 independent components, expected 6 in all"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,1,2,123,123",
       "arm.bdf:12: RBAR 8: its six independent components do not define a rigid motion"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123456,2,,\n,UM,3,123",
       "arm.bdf:12: RBE1 8: the components of node 2 are missing"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123,2,123\n,UM,3,123",
       "arm.bdf:12: RBE1 8: its six independent components do not define a rigid motion"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123456",
       "arm.bdf:12: RBE1 8: UM with the dependent components is missing"},
      {"RBE2,8,1,123456,3,4", "RROD,8,2,2", "arm.bdf:12: RROD 8: it has no length"},
      {"SPC1,1,123,1", "SPC1,1,123,50,THRU,60", "arm.bdf:13: SPC1: there is no node from 50 to 60"},
      {"SPC1,1,123,1", "SPC1,1,123,4,THRU,1",
       "arm.bdf:13: SPC1 1: found 4 THRU 1, expected the first to be at most the last"},
      {"SPC1,1,123,1", "SPC1,1,123,1,THRU,x",
       "arm.bdf:13: SPC1 1: the last number after THRU is 'x', expected a whole number from 1"},
      {"SPC1,1,123,1", "SET3,5,GRID,1,\n,4,THRU,2",
       "arm.bdf:14: SET3 5: found 4 THRU 2, expected the first to be at most the last"},
      {"SPC1,1,123,1", "SPOINT,30,THRU,20",
       "arm.bdf:13: SPOINT 30: found 30 THRU 20, expected the first to be at most the last"},
      {"SPC1,1,123,1", "SET3,5,GRID,1,9", "arm.bdf:13: set 5 has node 9, which is not in the file"},
      {"SPC1,1,123,1", "INCLUDE 'none.bdf'",
       "arm.bdf:13: the include file 'none.bdf' cannot be read here"},
      {"SPC1,1,123,1", "CELASX,4,4,1,1,2,1\nCELASX,5,4,1,2,2,2",
       "arm.bdf:13: CELASX is not read and may change stiffness or mass (2 cards in the file)"},
  };
  for (const Error& error : errors) {
    std::string text = deck;
    const std::size_t at = text.find(error.from);
    ASSERT_NE(at, std::string::npos) << error.from;
    text.replace(at, std::string(error.from).size(), error.to);
    EXPECT_EQ(deck_error(text), error.sentence) << error.to;
  }
}

TEST(BadNastran, WordsInLatin1) {
  EXPECT_EQ(deck_error("GRID,1,,0.,0.,\xe4\n"),
            "arm.bdf:1: GRID 1: a coordinate: '\xc3\xa4' is not a number");
  EXPECT_EQ(deck_error("GRID,1,,0.,0.,0.\nTR\xc4GER,1\n"),
            "arm.bdf:2: TR\xc3\x84GER is not read and may change stiffness or mass");
}

TEST(BadNastran, Lines) {
  EXPECT_EQ(deck_error("+A      1\n"), "arm.bdf:1: found a continuation '+A', expected a card");
  EXPECT_EQ(
      deck_error("CTETRA  1       1       1       2       3       4       5       6       +A\n"
                 "+B      7       8       9       10\n"),
      "arm.bdf:2: the continuation '+B' does not follow the card with this mark; the card "
      "before (CTETRA in line 1) has '+A'");
  EXPECT_EQ(deck_error("GRID,1,,0.,0.,0.,,,,,,,,1\n"),
            "arm.bdf:1: the line has 14 fields; a line in free field has at most 10");
  EXPECT_EQ(deck_error("$ nothing\n"), "arm.bdf: the file has no nodes (GRID)");
  EXPECT_EQ(deck_error("GRID,1,,0.,0.,0.\rGRID,2,,0.,0.,0.\r"),
            "arm.bdf: its lines end with a carriage return alone, expected a line feed (LF or "
            "CRLF)");
  EXPECT_EQ(deck_error(std::string("GRID,1,,0.\0\1\2", 14)),
            "arm.bdf: the file is binary, not text: byte 0x00 in line 1");
}

/// One node with two degrees of freedom.
const char* const good_punch =
    "DMIG    KAAX           0       6       2       0                       2\n"  // 1
    "DMIG*   KAAX                           1               1\n"                  // 2
    "*                      1               1 2.000000000D+06\n"                  // 3
    "DMIG*   KAAX                           1               2\n"                  // 4
    "*                      1               1-1.000000000D+06\n"                  // 5
    "*                      1               2 3.000000000D+06\n"                  // 6
    "DMIG    MAAX           0       6       2       0                       2\n"  // 7
    "DMIG*   MAAX                           1               1\n"                  // 8
    "*                      1               1 1.000000000D+00\n"                  // 9
    "DMIG*   MAAX                           1               2\n"                  // 10
    "*                      1               2 1.000000000D+00\n";                 // 11

std::string punch_error(const std::string& text) {
  return error_of([&] {
    TextSource nodes("GRID,1,,0.,0.,0.\n", "arm.bdf"), source(text, "arm.pch");
    read_dmig(source, nullptr, read_nastran(nodes, false, {}, NastranPart::nodes));
  });
}

TEST(BadNastran, Matrices) {
  ASSERT_EQ(punch_error(good_punch), "no error");
  const Error errors[] = {
      {"KAAX           0       6", "KAAX           0       9",
       "arm.pch:1: KAAX: IFO is 9, expected 1 (square) or 6 (symmetric)"},
      {"MAAX           0       6       2", "MAAX           0       6       4",
       "arm.pch:7: MAAX: TIN is 4, expected 1 or 2 (real)"},
      {"2 3.000000000D+06", "2 3.0000000z0D+06",
       "arm.pch:6: DMIG: an entry: '3.0000000z0D+06' is not a number"},
      {"*                      1               2 3.000000000D+06\n",
       "*                      1               2 3.000000000D+06\n"
       "DMIG*   KAAX                           1               0\n"
       "*                      1               0 1.000000000D+00\n",
       "arm.pch: node 1 has a row without a component, expected 1 to 6"},
      {"*                      1               2 3.000000000D+06\n", "",
       "arm.pch:10: the stiffness ends without a diagonal entry for 1.2 and 0 more: the file is "
       "truncated or "
       "does not belong to these degrees of freedom"},
      {"DMIG*   MAAX                           1               2",
       "DMIG*   MAAX                           1               3",
       "arm.pch:11: degree of freedom 1.3 of MAAX is not in KAAX"},
      {"*                      1               1-1.000000000D+06",
       "*                      1               2-1.000000000D+06",
       "arm.pch:6: the stiffness entry (1.2, 1.2) is there already (line 5)\n"
       "arm.pch:5: the stiffness entry (1.2, 1.2) on the diagonal is -1e+06, expected no negative "
       "value"},
  };
  for (const Error& error : errors) {
    std::string text = good_punch;
    const std::size_t at = text.find(error.from);
    ASSERT_NE(at, std::string::npos) << error.from;
    text.replace(at, std::string(error.from).size(), error.to);
    EXPECT_EQ(punch_error(text), error.sentence) << error.to;
  }
  EXPECT_EQ(
      punch_error(std::string(good_punch).substr(0, std::string(good_punch).find("DMIG    MAAX"))),
      "arm.pch: the file has no mass matrix (its matrices: KAAX); expected one whose name begins "
      "with M; or give the mass file");
}

}  // namespace
}  // namespace floatframe::test

// Decks that end too early, counts that do not fit, and what decks of a session and of other
// analyses hold besides: errors and notes.
#include <gtest/gtest.h>

#include "decks/ansys_deck.hpp"
#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string cut_types = "ET,1,185\nMP,EX,1,2.1e5\nMP,PRXY,1,0.3\nMP,DENS,1,7.8e-9\n";
const std::string cut_nodes =
    "NBLOCK,6,SOLID,5,5\n(3i9,6e20.13)\n"
    "        1        0        0\n        2        0        0 1.0000000000000E+00\n"
    "        3        0        0 0.0000000000000E+00 1.0000000000000E+00\n"
    "        4        0        0 0.0000000000000E+00 0.0000000000000E+00 1.0000000000000E+00\n"
    "        5        0        0 1.0000000000000E+00 1.0000000000000E+00 1.0000000000000E+00\n";
const std::string cut_elements =
    "EBLOCK,19,SOLID,2,2\n(19i9)\n"
    "        1        1        1        1        0        0        0        0        8        0    "
    " "
    "   1        1        2        3        3        4        4        4        4\n"
    "        1        1        1        1        0        0        0        0        8        0    "
    " "
    "   2        2        5        3        3        4        4        4        4\n";

TEST(CutDecks, AnsysBlocksEndWithMinusOne) {
  const std::string deck = cut_types + cut_nodes + "N,R5.3,LOC,-1\n" + cut_elements;
  const FeModel whole = ansys_of(deck + "      -1\n");
  EXPECT_EQ(whole.elements.size(), 2u);
  EXPECT_FALSE(contains(whole.notes, "cut short"));
  EXPECT_EQ(ansys_error(deck), "a.cdb:16: damaged");
  EXPECT_EQ(ansys_error(cut_types + cut_nodes), "a.cdb:11: damaged");
}

TEST(CutDecks, CountsOfAnsysBlocksAreCompared) {
  std::string nodes = cut_nodes, elements = cut_elements;
  nodes.replace(nodes.find("5,5"), 3, "9,7");
  elements.replace(elements.find("2,2"), 3, "9,3");
  const FeModel m = ansys_of(cut_types + nodes + "N,R5.3,LOC,-1\n" + elements + "      -1\n");
  EXPECT_TRUE(contains(m.notes,
                       "a.cdb:5: NBLOCK announces 7 nodes, 5 follow: if the file is not cut short, "
                       "nothing is missing"));
  EXPECT_TRUE(contains(m.notes, "a.cdb:13: EBLOCK announces 3 elements, 2 follow"));
}

TEST(CutDecks, WhatWorkbenchWritesAroundTheMesh) {
  const std::string mesh = cut_types + cut_nodes + "-1\n" + cut_elements + "-1\n";
  const FeModel m = ansys_of(
      "/batch\n*get,_wallstrt,active,,time,wall\n/nolist\netcon,set\nkeyw,pr_sgui,1\n/"
      "wb,file,start\n" +
      mesh + "/golist\n/auto,1\n/dist,1,5\ncm,_X,node\ntblist\n*abset,'Working','MSG'\nfinish\n");
  EXPECT_EQ(m.elements.size(), 2u);
  // A value of the session is an error where it is used.
  EXPECT_EQ(ansys_error("*get,h,active,,time,wall\n" + mesh + "R,1,h\nMP,EX,1,h\n"),
            "a.cdb:19: unsupported");
  EXPECT_EQ(ansys_error(mesh + "PSMESH,1,bolt\n"), "a.cdb:18: unsupported");
}

const std::string nastran_cut =
    "MAT1,1,2.1+11,,.3,7800.\nPSOLID,1,1\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
    "GRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n";

TEST(CutDecks, NastranReportsMissingAndIgnoredCards) {
  const FeModel whole = read_bdf("SOL 103\nCEND\nBEGIN BULK\n" + nastran_cut + "ENDDATA\n");
  EXPECT_FALSE(contains(whole.notes, "ENDDATA"));
  EXPECT_FALSE(contains(whole.notes, "WTMASS"));
  const FeModel m =
      read_bdf("SOL 103\nCEND\nSTATSUB(PRELOAD) = 1\nBEGIN BULK\nPARAM,WTMASS,.5\n" + nastran_cut);
  EXPECT_TRUE(
      contains(m.notes, "the file has no ENDDATA: if it is not cut short, nothing is missing"));
  EXPECT_TRUE(contains(m.notes, "PARAM WTMASS: the mass of the part is multiplied by 0.5"));
  EXPECT_TRUE(contains(m.notes,
                       "arm.bdf:3: STATSUB is ignored: the part is free of the stress of a "
                       "preload, the frequencies of Nastran are not"));
  EXPECT_EQ(m.materials[0].density, 3900.0);
}

TEST(CutDecks, ALongLineOfNastranIsOneError) {
  const std::string text =
      "SOL 103\nCEND\nBEGIN BULK\n" + nastran_cut + "GRID,5,,1.,1.,1.,,,,,,7\nENDDATA\n";
  EXPECT_EQ(error_of([&] { read_bdf(text); }), "arm.bdf:11: wrong_count");
}

const std::string two_blocks =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., "
    "1.\n"
    "7, 1., 1., 1.\n8, 0., 1., 1.\n11, 0., 0., 1.\n12, 1., 0., 1.\n13, 1., 1., 1.\n14, 0., 1., 1.\n"
    "15, 0., 0., 2.\n16, 1., 0., 2.\n17, 1., 1., 2.\n18, 0., 1., 2.\n"
    "21, 2., 0., 1.\n22, 2., 1., 1.\n23, 2., 0., 2.\n24, 2., 1., 2.\n"
    "*ELEMENT, TYPE=C3D8, ELSET=LOW\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
    "*ELEMENT, TYPE=C3D8, ELSET=UP\n2, 11, 12, 13, 14, 15, 16, 17, 18\n3, 12, 21, 22, 13, 16, 23, "
    "24, 17\n"
    "*SURFACE, NAME=TOP\nLOW, S2\n*SURFACE, NAME=FOOT\nUP, S1\n*MATERIAL, NAME=M\n*ELASTIC\n1., "
    ".3\n*DENSITY\n1.\n"
    "*SOLID SECTION, ELSET=LOW, MATERIAL=M\n*SOLID SECTION, ELSET=UP, MATERIAL=M\n";

FeModel blocks_with(const std::string& more, DeckContact contact) {
  TextSource source(two_blocks + more, "a.inp");
  FeReadOptions options;
  options.contact = contact;
  return read_abaqus(source, options);
}

TEST(CutDecks, TiesCountNodesOnce) {
  const FeModel m =
      blocks_with("*TIE, NAME=T, POSITION TOLERANCE=0.1\nFOOT, TOP\n", DeckContact::refuse);
  EXPECT_TRUE(contains(
      m.notes, "4 of 6 nodes of 'FOOT' are tied to 'TOP' (within 0.1); not tied: node 22, ..."));
}

TEST(CutDecks, GeneralContactIsLeftOutOnRequest) {
  const std::string contact = "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n";
  const FeModel m = blocks_with(contact, DeckContact::ignore);
  EXPECT_EQ(m.elements.size(), 3u);
  EXPECT_TRUE(contains(m.notes, "*CONTACT is ignored, as the options say: its surfaces are free"));
  const auto refusal = [&](DeckContact how) {
    return error_of([&] { blocks_with(contact, how); });
  };
  EXPECT_EQ(refusal(DeckContact::refuse), "a.inp:38: unsupported");
  EXPECT_EQ(refusal(DeckContact::tied), "a.inp:38: unsupported");
}

}  // namespace
}  // namespace floatframe::test

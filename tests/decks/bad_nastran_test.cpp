// Invalid decks and matrices of Nastran: each with the code and place of its error.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"

namespace floatframe::test {
namespace {

struct Error {
  const char* from;
  const char* to;
  const char* expected;
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
  ASSERT_EQ(bdf_error(deck), "no error");
  const Error errors[] = {
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,44", "arm.bdf:6: not_found"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3", "arm.bdf:6: missing"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,4,1,2", "arm.bdf:6: incomplete"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,x", "arm.bdf:6: not_a_number"},
      {"CTETRA,1,1", "CHEXX,1,1", "arm.bdf:6: unsupported"},
      {"CTETRA,1,1", "CBEND,1,1", "arm.bdf:6: unsupported"},
      {"CTETRA,1,1", "CTETRA,2,1", "arm.bdf:7: duplicate"},
      {"CTETRA,1,1", "CTETRA,1,2", "arm.bdf:6: wrong_value"},
      {"CTETRA,1,1", "CTETRA,1,5", "arm.bdf:6: not_found"},
      {"GRID,2,,1.,0.,0.", "GRID,1,,1.,0.,0.", "arm.bdf:3: duplicate"},
      {"GRID,2,,1.,0.,0.", "GRID,99999999999,,1.,0.,0.", "arm.bdf:3: not_a_number"},
      {"GRID,2,,1.,0.,0.", "GRID,2,,1.,0.,0.,,777", "arm.bdf:3: wrong_value"},
      {"GRID,2,,1.,0.,0.", "GRID,2,5,1.,0.,0.", "arm.bdf:3: not_found"},
      {"GRID,2,,1.,0.,0.", "CORD2R,6,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,2,6,1.,0.,0.",
       "arm.bdf:3: cycle"},
      {"GRID,2,,1.,0.,0.", "CORD2R,6,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,2,6,1.,0.,0.",
       "arm.bdf:3: geometry"},
      {"GRID,2,,1.,0.,0.", "GRID,2,,1.0.0,0.,0.", "arm.bdf:3: not_a_number"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,,8000.", "arm.bdf:10: wrong_count"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,-2.+11,,.3,8000.", "arm.bdf:10: out_of_range"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,.5,8000.", "arm.bdf:10: out_of_range"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.1+11,7.+10,,8000.", "arm.bdf:10: contradiction"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,,-7.+10,.3,8000.", "arm.bdf:10: contradiction"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,-7.+10,,8000.", "arm.bdf:10: out_of_range"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,1,2.+11,,.3,-1.", "arm.bdf:10: out_of_range"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT1,3,2.+11,,.3,8000.", "arm.bdf:8: not_found"},
      {"MAT1,1,2.+11,,.3,8000.", "MAT9,1,2.+11,,.3,8000.", "arm.bdf:10: wrong_value"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,DBOX\n,.1,.1,.1,.1", "arm.bdf:9: unsupported"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,CHAN\n,.1,.1,.1,.1", "arm.bdf:9: geometry"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,L\n,.1,-.1,.1,.1", "arm.bdf:9: out_of_range"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,BOX1\n,.1,.1,.01,.01,.06,.05",
       "arm.bdf:9: geometry"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,BAR\n,.1,.1,0.,3.", "arm.bdf:9: wrong_value"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,0.,0.,1.\n,7", "arm.bdf:8: wrong_value"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,0.,0.,1.\n,,,x", "arm.bdf:8: not_a_number"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,1.,0.,0.\n,,,-1.,,,-2.", "arm.bdf:7: geometry"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBAR,2,1,-1.-3,1.-7",
       "arm.bdf:9: out_of_range\narm.bdf:9: out_of_range\narm.bdf:9: out_of_range"},
      {"PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBAR,2,1,1.,.2,.3,.4\n,\n,,,-.4",
       "arm.bdf:9: out_of_range"},
      {"CBAR,2,2,1,2,0.,0.,1.\nPSOLID,1,1\nPBAR,2,1,1.-3,1.-7,1.-7,2.-7",
       "CBEAM,2,2,1,2,0.,0.,1.\nPSOLID,1,1\nPBEAM,2,1,1.,-.2,-.3,.1,.4", "arm.bdf:9: out_of_range"},
      {"CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,4\nPSHELL,4,1,-.01,1\nCTRIA3,9,4,1,2,3",
       "arm.bdf:7: out_of_range"},
      {"CONM2,7,2,,1.5", "CONM2,7,2,,-1.5", "arm.bdf:11: out_of_range"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2", "arm.bdf:7: missing"},
      {"CONM2,7,2,,1.5", "CONM2,7,4,,1.5,.1", "no error"},
      {"CBAR,2,2,1,2,0.,0.,1.", "CBAR,2,2,1,2,3.,0.,0.", "arm.bdf:7: geometry"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456,3,THRU,4", "arm.bdf:12: unsupported"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456", "arm.bdf:12: missing"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,3,123456,4,3", "arm.bdf:12: cycle"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,3,3,123456", "arm.bdf:12: cycle"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,12,1.,23,3,4\n,2", "arm.bdf:12: singular"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,123,0.,123,3,4\n,2", "arm.bdf:12: out_of_range"},
      {"RBE2,8,1,123456,3,4", "RBE3,8,,1,123,1.,,3,4", "arm.bdf:12: missing"},
      {"RBE2,8,1,123456,3,4", "RBE2,8,1,123456,3,4\nRBE3,9,,1,3,1.,3,3,4\nMPC,1,1,3,1.,2,3,-1.",
       "arm.bdf:13: dependent"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,1,2,123,23", "arm.bdf:12: wrong_count"},
      {"RBE2,8,1,123456,3,4", "RBAR,8,1,2,123,123", "arm.bdf:12: dependent"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123456,2,,\n,UM,3,123", "arm.bdf:12: missing"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123,2,123\n,UM,3,123", "arm.bdf:12: dependent"},
      {"RBE2,8,1,123456,3,4", "RBE1,8,1,123456", "arm.bdf:12: missing"},
      {"RBE2,8,1,123456,3,4", "RROD,8,2,2", "arm.bdf:12: geometry"},
      {"SPC1,1,123,1", "SPC1,1,123,50,THRU,60", "arm.bdf:13: not_found"},
      {"SPC1,1,123,1", "SPC1,1,123,4,THRU,1", "arm.bdf:13: out_of_range"},
      {"SPC1,1,123,1", "SPC1,1,123,1,THRU,x", "arm.bdf:13: not_a_number"},
      {"SPC1,1,123,1", "SET3,5,GRID,1,\n,4,THRU,2", "arm.bdf:14: out_of_range"},
      {"SPC1,1,123,1", "SPOINT,30,THRU,20", "arm.bdf:13: out_of_range"},
      {"SPC1,1,123,1", "SET3,5,GRID,1,9", "arm.bdf:13: not_found"},
      {"SPC1,1,123,1", "INCLUDE 'none.bdf'", "arm.bdf:13: unreadable"},
      {"SPC1,1,123,1", "CELASX,4,4,1,1,2,1\nCELASX,5,4,1,2,2,2", "arm.bdf:13: unsupported"},
  };
  for (const Error& error : errors) {
    std::string text = deck;
    const std::size_t at = text.find(error.from);
    ASSERT_NE(at, std::string::npos) << error.from;
    text.replace(at, std::string(error.from).size(), error.to);
    EXPECT_EQ(bdf_error(text), error.expected) << error.to;
  }
}

TEST(BadNastran, WordsInLatin1) {
  EXPECT_EQ(bdf_error("GRID,1,,0.,0.,\xe4\n"), "arm.bdf:1: not_a_number");
  EXPECT_EQ(bdf_error("GRID,1,,0.,0.,0.\nTR\xc4GER,1\n"), "arm.bdf:2: unsupported");
}

TEST(BadNastran, Lines) {
  EXPECT_EQ(bdf_error("+A      1\n"), "arm.bdf:1: wrong_value");
  EXPECT_EQ(bdf_error("CTETRA  1       1       1       2       3       4       5       6       +A\n"
                      "+B      7       8       9       10\n"),
            "arm.bdf:2: incomplete");
  EXPECT_EQ(bdf_error("GRID,1,,0.,0.,0.,,,,,,,,1\n"), "arm.bdf:1: wrong_count");
  EXPECT_EQ(bdf_error("$ nothing\n"), "arm.bdf: missing");
  EXPECT_EQ(bdf_error("GRID,1,,0.,0.,0.\rGRID,2,,0.,0.,0.\r"), "arm.bdf: unreadable");
  EXPECT_EQ(bdf_error(std::string("GRID,1,,0.\0\1\2", 14)), "arm.bdf: unreadable");
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
      {"KAAX           0       6", "KAAX           0       9", "arm.pch:1: wrong_value"},
      {"MAAX           0       6       2", "MAAX           0       6       4",
       "arm.pch:7: wrong_value"},
      {"2 3.000000000D+06", "2 3.0000000z0D+06", "arm.pch:6: not_a_number"},
      {"*                      1               2 3.000000000D+06\n",
       "*                      1               2 3.000000000D+06\n"
       "DMIG*   KAAX                           1               0\n"
       "*                      1               0 1.000000000D+00\n",
       "arm.pch:8: out_of_range"},
      {"*                      1               2 3.000000000D+06\n", "", "arm.pch:10: damaged"},
      {"DMIG*   MAAX                           1               2",
       "DMIG*   MAAX                           1               3", "arm.pch:11: not_found"},
      {"*                      1               1-1.000000000D+06",
       "*                      1               2-1.000000000D+06",
       "arm.pch:6: duplicate\narm.pch:5: out_of_range"},
  };
  for (const Error& error : errors) {
    std::string text = good_punch;
    const std::size_t at = text.find(error.from);
    ASSERT_NE(at, std::string::npos) << error.from;
    text.replace(at, std::string(error.from).size(), error.to);
    EXPECT_EQ(punch_error(text), error.expected) << error.to;
  }
  EXPECT_EQ(
      punch_error(std::string(good_punch).substr(0, std::string(good_punch).find("DMIG    MAAX"))),
      "arm.pch: wrong_value");
}

}  // namespace
}  // namespace floatframe::test

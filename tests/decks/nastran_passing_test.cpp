// Cards and forms of cards that change nothing of a part are ignored, whatever program wrote
// them; those that cannot be read say why.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "decks/deck_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const std::string tetra =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"  // 1 to 4
    "CTETRA,1,1,1,2,3,4\nPSOLID,1,1\nMAT1,1,2.+11,,.25,8000.\n";                // 5 to 7

TEST(NastranPassing, HarmlessCards) {
  for (const char* card :
       {"DEBUG,192,2",       "CAERO1,1,1",      "SPLINE1,1",        "AEROS,,,1.,1.",
        "AELIST,1,2",        "AECOMP,A,AELIST", "MKAERO1,.5",       "CHBDYG,1,,AREA4",
        "CONV,1,2",          "QBDY1,1,2.,3",    "RADBC,1,1.,,2",    "RADLST,1,2",
        "MATT4,1,2",         "MAT4,1,2.",       "TABLED1,5",        "TABDMP1,5",
        "RANDPS,1,1,1",      "DESVAR,1,A,1.",   "DVPREL1,1,PSOLID", "TOPVAR,1,A,PSOLID",
        "DRESP1,1,W,WEIGHT", "DSCREEN,STRESS",  "DOPTPRM,DESMAX,3", "BSURF,1,1",
        "BCBODY,1",          "BCRPARA,1",       "BCTPARM,1",        "CDAMP1,1,1,1,1",
        "PDAMP,1,2.",        "PMASS,9,1.",      "ECHOOFF",          "PLOTEL,1,1,2",
        "SPOINT,77",         "EPOINT,78",       "NLPARM,1",         "TSTEPNL,1,10,.1",
        "EIGRL,1,,,10",      "RFORCE,1,1",      "PLOAD4,1,1,1.",    "ROTORG,1,1,2",
        "BOLT,1,1",          "CBARAO,1,FR",     "CVISC,8,8,1,2",    "PGAP,1",
        "PELAST,1,2",        "DTI,SPECSEL,1,2", "DMI,W2GJ,0,2",     "USETADD,1,2",
        "MATS1,1,,PLASTIC",  "MATHP,9,1.",      "TEMPD,1,20.",      "CORD3G,9,E321,1,2,3",
        "NLSTEP,1",          "echoon",          "SET2,1,2"}) {
    EXPECT_EQ(bdf_error(tetra + card + "\n"), "no error") << card;
  }
  for (const char* name : {"SOLLIB", "SPARSTOR", "EQCHECK", "RCONDK", "PRTSTIFF", "GRIDSEQ"}) {
    EXPECT_EQ(bdf_error(tetra + "PARAM," + name + ",1\n"), "no error") << name;
  }
}

// Solution sequences are includes of the executive control that users do not have.
TEST(NastranPassing, MissingIncludesOfTheExecutiveControl) {
  const TemporaryFolder folder;
  folder.write("control.dat", "METHOD = 1\n");
  const std::string alter = "SOL 103\nINCLUDE '/dmap/alter.v9'\n",
                    control = "include control.dat\n";
  folder.write("arm.bdf", alter + "CEND\n" + control + "BEGIN BULK\n" + tetra + "ENDDATA\n");
  const FeModel m = read_fe_file(folder / "arm.bdf");
  const std::string note = (folder / "arm.bdf").string() +
                           ": files that the executive control includes are missing and "
                           "ignored: /dmap/alter.v9";
  EXPECT_EQ(std::count(m.notes.begin(), m.notes.end(), note), 1);
  folder.write("arm.bdf", "SOL 103\nCEND\nINCLUDE 'alter.v9'\nBEGIN BULK\n" + tetra);
  EXPECT_EQ(test::without_folders(error_of([&] { read_fe_file(folder / "arm.bdf"); })),
            "arm.bdf:3: not_found");
}

TEST(NastranPassing, RefusedCards) {
  const char* const refused[] = {"CBEND",   "CBEAM3",  "RSPLINE", "RSSCON", "RTRPLT1", "CGAP",
                                 "CBUSH2D", "GENEL",   "CFAST",   "CWELD",  "CSEAM",   "PBMSECT",
                                 "PBRSECT", "TF",      "CHACAB",  "CAABSF", "CFLUID3", "BGSET",
                                 "SESET",   "SECONCT", "CSUPER",  "EXTRN",  "CYJOIN",  "CCONEAX",
                                 "CTRIAX6", "CPLSTN4", "BCONP",   "BCTSET", "BCTABLE"};
  for (const char* const card : refused)
    EXPECT_EQ(bdf_error(tetra + card + ",9,9,1,2\n"), "arm.bdf:8: unsupported") << card;
  EXPECT_EQ(bdf_error(tetra + "CGAP,9\nCGAP,10\n"), "arm.bdf:8: unsupported");
}

// Matrices and nonstructural mass count only where the case control selects them.
TEST(NastranPassing, CardsThatAreNotSelected) {
  const std::string cards = "NSM1,3,PSOLID,.2,1\nDMIG,K1,1,1,1.\n";
  EXPECT_EQ(bdf_error("SOL 101\nCEND\nBEGIN BULK\n" + tetra + cards), "no error");
  EXPECT_EQ(bdf_error(tetra + cards), "arm.bdf:9: unsupported\narm.bdf:8: unsupported");
  EXPECT_EQ(bdf_error("CEND\nNSM=3\nBEGIN BULK\n" + tetra + cards), "arm.bdf:2: unsupported");
}

// Each would stand for cards that are not written out; an equation may hold the sign.
TEST(NastranPassing, FieldsThatRepeatTheCardBefore) {
  const std::string repeats = "unsupported";
  for (const char* card : {"GRID,5,=,*(1.),==", "GRID,5,,==", "=,*(1),==", "=3"})
    EXPECT_EQ(bdf_error(tetra + card + "\n"), "arm.bdf:8: " + repeats) << card;
  EXPECT_EQ(bdf_error(tetra + "DEQATN,1,F(A),=,A\n"), "no error");
}

// A line BEGIN BULK alone is no case control that could select something.
TEST(NastranPassing, BeginBulkIsNoCaseControl) {
  EXPECT_EQ(bdf_error("BEGIN BULK\n" + tetra + "NSM1,3,PSHELL,.2,1\n"), "arm.bdf:9: unsupported");
  EXPECT_EQ(read_bdf("BEGIN BULK\n" + tetra + "MPC,3,1,1,1.,2,1,-1.\n").equations.size(), 1u);
  EXPECT_TRUE(read_bdf("CEND\nBEGIN BULK\n" + tetra + "MPC,3,1,1,1.,2,1,-1.\n").equations.empty());
}

TEST(NastranPassing, IgnoredCardsAreNoted) {
  const FeModel m = read_bdf("CEND\nBEGIN BULK\n" + tetra + "NSM1,3,PSHELL,.2,1\nPBUSHT,9,K,3\n");
  ASSERT_GE(m.notes.size(), 2u);
  EXPECT_TRUE(
      contains(m.notes,
               "tables of stiffness and damping over frequency or load are ignored, the part "
               "has the constant ones: PBUSHT"));
  EXPECT_TRUE(contains(m.notes, "cards that the case control does not select are ignored: NSM1"));
  EXPECT_FALSE(contains(m.notes, "change neither stiffness nor mass"));
}

TEST(NastranPassing, MassesAndRigidElementsGivenTwice) {
  for (const char* card : {"CONM2,9,1,,5.", "CMASS2,9,5.,1,1", "CONM1,9,1", "RBE2,9,1,123,2",
                           "RBE3,9,,1,123,1.,123,2,3,4", "RBAR,9,1,2,123456"}) {
    const std::string line = std::string(card) + "\n";
    EXPECT_EQ(bdf_error(tetra + line + line), "arm.bdf:9: duplicate");
  }
  // Masses and rigid elements have numbers of their own.
  EXPECT_EQ(bdf_error(tetra + "CONM2,9,1,,5.\nRBE2,9,1,123,2\n"), "no error");
}

TEST(NastranPassing, FormsOfCards) {
  const FeModel plain = read_bdf(tetra + "SPC1,1,123,1\n");
  const std::string spc[] = {"SPC1    1       1 2 3   1\n",  // blanks between components
                             "spc1,1,321,1\nenddata\nwhatever\n",
                             "SPC1,1,1 23,1,,,,,,,,\n",  // more commas than fields
                             "SPC1\t1\t123\t1\n",
                             "SPC1    1       123     1" + std::string(47, ' ') + "a, b\n"};
  for (const std::string& card : spc) {
    const FeModel model = read_bdf(tetra + card);
    ASSERT_EQ(model.supports.size(), 1u) << card;
    EXPECT_EQ(model.supports[0].mask, plain.supports[0].mask) << card;
    EXPECT_EQ(model.supports[0].node, plain.supports[0].node) << card;
  }
}

TEST(NastranPassing, MarksWhoseFirstCharacterDiffers) {
  const auto conm = [](const std::string& mark, const std::string& follows) {
    return bdf_error(tetra + "RBE2,7,1,123,2\nCONM2   9       1               1.      " +
                     std::string(32, ' ') + mark + "\n" + follows + "1.\n");
  };
  EXPECT_EQ(conm("+C1     ", "+C1     "), "no error");
  EXPECT_EQ(conm(" C1     ", "+C1     "), "no error");
  EXPECT_EQ(conm("AC1     ", "+C1     "), "no error");
  EXPECT_EQ(conm("+C1     ", "+c1     "), "no error");
  EXPECT_EQ(conm("+C1     ", "        "), "no error");
  EXPECT_EQ(conm("+C1     ", "+D1     "), "arm.bdf:10: incomplete");
}

}  // namespace
}  // namespace floatframe::test

// What of a Nastran file changes the part: parameters, case control, a shear modulus of its own,
// superelements. Nothing of it is ignored.
#include <gtest/gtest.h>

#include <string>

#include "decks/deck_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const std::string bulk =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"  // 1 to 4
    "CTETRA,1,1,1,2,3,4\nCBAR,2,2,1,2,0.,0.,1.\n"                               // 5, 6
    "PSOLID,1,1\nPBAR,2,1,1.-3,1.-7,1.-7,2.-7\n"                                // 7, 8
    "MAT1,1,2.+11,,.25,8000.\n";                                                // 9

std::string with(const std::string& from, const std::string& to) {
  std::string text = bulk;
  return text.replace(text.find(from), from.size(), to);
}

TEST(NastranRules, SuperelementsAreRefused) {
  EXPECT_EQ(
      bdf_error("SOL 103\nCEND\nBEGIN SUPER=1\n" + bulk + "BEGIN BULK\n" + bulk + "ENDDATA\n"),
      "arm.bdf:3: unsupported");
  EXPECT_EQ(bdf_error("SOL 103\nCEND\nBEGIN BULK SUPER=2\n" + bulk), "arm.bdf:3: unsupported");
  EXPECT_EQ(bdf_error("BEGIN BULK\n" + bulk + "begin super = 3\n" + bulk),
            "arm.bdf:11: unsupported");
  EXPECT_EQ(bdf_error("SOL 103\nCEND\n  BEGIN BULK $ comment\n" + bulk), "no error");
  EXPECT_EQ(bdf_error("BEGIN BULK\n" + bulk + "BEGIN BULK\n"), "arm.bdf:11: unsupported");
}

TEST(NastranRules, FactorsOfMassAndStiffness) {
  const FeModel plain = read_bdf(bulk), mass = read_bdf(bulk + "PARAM,CM1,2.5\n"),
                stiffness = read_bdf(bulk + "PARAM*,CK1,.5,0.\n"),
                both = read_bdf(bulk + "PARAM,WTMASS,.1\nPARAM,CM1,3.\nPARAM,CM1,3.\n");
  EXPECT_DOUBLE_EQ(mass.materials.at(0).density, 2.5 * plain.materials.at(0).density);
  EXPECT_EQ(mass.materials.at(0).young, plain.materials.at(0).young);
  EXPECT_EQ(mass.notes.back(), "arm.bdf: PARAM CM1: the mass of the part is multiplied by 2.5");
  EXPECT_DOUBLE_EQ(stiffness.materials.at(0).young, 0.5 * plain.materials.at(0).young);
  EXPECT_EQ(stiffness.materials.at(0).poisson, plain.materials.at(0).poisson);
  EXPECT_EQ(stiffness.materials.at(0).density, plain.materials.at(0).density);
  EXPECT_NEAR(both.materials.at(0).density, 0.3 * plain.materials.at(0).density, 1e-12);
  EXPECT_EQ(bdf_error(bulk + "PARAM,CM1,0.\n"), "arm.bdf:10: out_of_range");
  EXPECT_EQ(bdf_error(bulk + "PARAM,CK1,1.,.1\n"), "arm.bdf:10: unsupported");
}

TEST(NastranRules, ParametersOfTheCaseControlCount) {
  const FeModel plain = read_bdf(bulk);
  const FeModel model = read_bdf(
      "PARAM //C,N,ADD $ of an alter\nCEND\nTITLE = PARAM\nPARAM,WTMASS,.5\nparam, post, -1\nBEGIN "
      "BULK\n" +
      bulk);
  EXPECT_DOUBLE_EQ(model.materials.at(0).density, 0.5 * plain.materials.at(0).density);
}

TEST(NastranRules, FactorsThatDisagreeStop) {
  const auto subcases = [](const std::string& first, const std::string& second) {
    return "SOL 103\nCEND\nSUBCASE 1\n PARAM," + first + "\nSUBCASE 2\n PARAM," + second +
           "\nBEGIN BULK\n" + bulk;
  };
  EXPECT_EQ(bdf_error(subcases("CM1,2.0", "CM1,5.0")), "arm.bdf:6: exclusive");
  for (const char* word : {"WTMASS", "CK1"}) {
    const std::string name = word;
    EXPECT_EQ(bdf_error(subcases(name + ",2.", name + ",1.")), "arm.bdf:6: exclusive");
  }
  EXPECT_EQ(bdf_error(bulk + "PARAM,CM1,2.\nPARAM,CM1,3.\n"), "arm.bdf:11: exclusive");
  EXPECT_DOUBLE_EQ(read_bdf(subcases("CM1,2.0", "CM1,2.")).materials.at(0).density, 16000.0);
}

TEST(NastranRules, BeginAloneBeginsTheBulkData) {
  const FeModel plain = read_bdf(bulk);
  for (const char* begin : {"BEGIN\n", "  begin $ bulk\n"}) {
    const FeModel model = read_bdf(std::string("SOL 103\nCEND\nPARAM,WTMASS,.5\n") + begin + bulk);
    EXPECT_DOUBLE_EQ(model.materials.at(0).density, 0.5 * plain.materials.at(0).density);
  }
  EXPECT_EQ(bdf_error("BEGIN\n" + bulk + "BEGIN\n"), "arm.bdf:11: unsupported");
}

// Sets of large models are written out in the case control; its end is where it is.
TEST(NastranRules, ControlOfAnyLengthIsRead) {
  std::string control = "SOL 103\nCEND\nPARAM,WTMASS,.5\nSET 1 = 1";
  while (control.size() < std::size_t{3} << 20) control += ",\n 1000, 1001, 1002, 1003, 1004";
  const TemporaryFolder folder;
  const auto file = folder.write("arm.bdf", control + "\nBEGIN BULK\n" + bulk);
  EXPECT_DOUBLE_EQ(read_nastran(file, {}).materials.at(0).density, 4000.0);
  EXPECT_DOUBLE_EQ(read_fe_file(file, {}, "").materials.at(0).density, 4000.0);
}

TEST(NastranRules, UnknownParametersStop) {
  EXPECT_EQ(bdf_error(bulk + "PARAM,STIFFER,2.\n"), "arm.bdf:10: unsupported");
  for (const char* name :
       {"POST",  "AUTOSPC", "GRDPNT",   "PRGPST", "MAXRATIO", "BAILOUT", "COUPMASS",
        "K6ROT", "SNORM",   "OGEOM",    "RESVEC", "CM2",      "CK2",     "CB1",
        "G",     "W3",      "USETSTR1", "lgdisp", "EXTOUT",   "CHECKEL"}) {
    EXPECT_EQ(bdf_error(bulk + "PARAM," + name + ",1\n"), "no error") << name;
  }
  EXPECT_EQ(bdf_error(bulk + "MATT1,1,7\n"), "arm.bdf:10: unsupported");
  EXPECT_EQ(bdf_error(bulk + "DTI,UNITS,1,KG,N,M,S\n"), "no error");
}

TEST(NastranRules, MatricesAndMassOfTheCaseControlStop) {
  EXPECT_EQ(bdf_error("SOL 103\nCEND\nK2GG = STIFF\nM2GG(X)=HEAVY\nNSM = 3\nBEGIN BULK\n" + bulk),
            "arm.bdf:3: unsupported\narm.bdf:4: unsupported");
}

TEST(NastranRules, BarsTwistByTheirOwnShearModulus) {
  const double J = 2e-7, from_E = 2e11 / 2.5;
  EXPECT_DOUBLE_EQ(read_bdf(bulk).sections.at(0).J, J);
  const FeModel model = read_bdf(with("MAT1,1,2.+11,,.25", "MAT1,1,2.+11,2.+10,.25"));
  const Material& m = model.materials.at(0);
  EXPECT_DOUBLE_EQ(m.shear(), from_E);  // of the tetrahedron
  EXPECT_DOUBLE_EQ(m.shear() * model.sections.at(0).J, 2e10 * J);
  EXPECT_EQ(model.notes.at(0),
            "arm.bdf:9: MAT1 1: G is 2e+10, but E and NU give 8e+10: bars twist by G, shells and "
            "solids have E and NU, as in Nastran");
  EXPECT_EQ(bdf_error(with("MAT1,1,2.+11,,.25", "MAT1,1,2.+11,0.,.25")), "arm.bdf:9: out_of_range");
}

const std::string equations = "MPC,8,1,1,1.,2,1,-.5\nMPC,9,1,2,1.,2,2,-1.\n";

TEST(NastranRules, TheCaseControlSelectsEquations) {
  const std::string control = "SOL 103\nCEND\n", begin = "BEGIN BULK\n";
  const FeModel model = read_bdf(control + "MPC = 9\n" + begin + bulk + equations);
  ASSERT_EQ(model.equations.size(), 1u);
  EXPECT_EQ(model.equations[0].terms[0].axis, 1);
  EXPECT_EQ(
      read_bdf(control + "MPC=5\n" + begin + bulk + equations + "MPCADD,5,8,9\n").equations.size(),
      2u);
  const FeModel none = read_bdf(control + begin + bulk + equations);
  EXPECT_TRUE(none.equations.empty());
  EXPECT_EQ(none.notes.at(0),
            "arm.bdf:13: 2 MPC equations are in sets that the case control does not select: they "
            "are not applied");
  EXPECT_EQ(bdf_error(control + "MPC = 3\n" + begin + bulk + equations), "arm.bdf:3: not_found");
  EXPECT_EQ(bdf_error(control + "MPC = 8\nSUBCASE 2\nMPC = 9\n" + begin + bulk + equations),
            "arm.bdf:5: exclusive");
}

TEST(NastranRules, NodesThatAreThereTwice) {
  const FeModel model = read_bdf(bulk + "GRID,3,,0.,1.,0.\nGRID,3,,0.,1.,0.\n");
  EXPECT_EQ(model.nodes(), 4);
  EXPECT_EQ(model.notes.back(),
            "arm.bdf: 2 nodes are in the file twice with the same numbers, first in line 10: each "
            "is one, as in Nastran");
  EXPECT_EQ(bdf_error(bulk + "GRID,3,,0.,1.,.1\n"), "arm.bdf:10: duplicate");
}

TEST(NastranRules, WholeNumbersForRealOnes) {
  const FeModel model = read_bdf(bulk + "CONM2,5,2,,3\nCONM2,6,2,,4,\n");
  EXPECT_EQ(model.masses.at(0).mass, 3.0);
  EXPECT_EQ(
      model.notes.at(0),
      "arm.bdf:10: CONM2 5: the mass is '3', a whole number where a real one is expected, and "
      "1 more such fields: Nastran stops there; they are read as real ones");
  for (const std::string& note : read_bdf(bulk).notes)
    EXPECT_FALSE(contains(note, "a whole number"));
}

TEST(NastranRules, SectionsWithUnusualDimensions) {
  const FeModel other =
      read_bdf(bulk + "MAT1,2,1.+9,,.25,8000.\nCTRIA3,3,3,1,2,3\nPSHELL,3,1,.01,1,,2,.4\n");
  EXPECT_NEAR(other.shells.at(0).shear, .4 * .01 / 200.0, 1e-12);
  EXPECT_EQ(bdf_error(bulk + "CTRIA3,3,3,1,2,3\nPSHELL,3,1,.01,1,,1,.833333\n"), "no error");
  EXPECT_EQ(bdf_error(with("PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBARL,2,1,,TUBE2\n,.01,.015")),
            "arm.bdf:8: contradiction");
  const FeModel bar =
      read_bdf(with("PBAR,2,1,1.-3,1.-7,1.-7,2.-7", "PBAR,2,1,1.-3,1.-7,1.-7,2.-7\n,\n,.5,.5"));
  EXPECT_EQ(bar.sections.at(0).shear_z, 5e-4);
}

}  // namespace
}  // namespace floatframe::test

// Nonstructural mass that the case control selects (NSM), against closed forms and against that of
// the properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "floatframe/fe/fe_system.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/formats/nastran/read_nastran.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

FeModel heavy_deck(const std::string& text) {
  TextSource source(text, "arm.bdf");
  FeModel model = read_nastran(source, has_begin_bulk(text), {});
  validate(model);
  return model;
}

/// A frame 2 x 3 of a bar and a beam of length 2, of a rod, a CONROD and a tube of length 3, with a
/// plate, a laminate and a panel of area 6 each; numbers 11 to 18.
const std::string frame =
    "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,3.,0.\nGRID,4,,0.,3.,0.\n"
    "CBAR,11,1,1,2,0.,1.,0.\nPBAR,1,9,.1,.2,.3,.4\nCBEAM,12,2,3,4,0.,1.,0.\n"
    "PBEAM,2,9,.1,.2,.3,,.4\nCROD,13,3,2,3\nPROD,3,9,.1\nCONROD,14,4,1,9,.1\n"
    "CTUBE,15,5,2,3\nPTUBE,5,9,.3,.1\nCQUAD4,16,6,1,2,3,4\nPSHELL,6,9,.1,9\n"
    "CQUAD4,17,7,1,2,3,4\nPCOMP,7\n,9,.1,0.,,9,.1,90.\nCSHEAR,18,8,1,2,3,4\nPSHEAR,8,9,.1\n"
    "MAT1,9,100.,,.25,2.\nPARAM,WTMASS,.5\n";

std::string with_mass(const std::string& cards, const std::string& control = "NSM = 5\n") {
  return "SOL 103\nCEND\n" + control + frame + cards;
}

double mass_of(const FeModel& model) {
  const FeSystem system = assemble(model);
  VecX u = VecX::Zero(system.size());
  for (int i = 0; i < system.size(); ++i)
    if (system.dofs[static_cast<std::size_t>(i)].axis == 2) u(i) = 1.0;
  return u.dot(system.M * u);
}

/// What the cards add, over WTMASS.
double mass_added(const std::string& cards) {
  const double plain = mass_of(heavy_deck(with_mass("", "")));
  return (mass_of(heavy_deck(with_mass(cards))) - plain) / .5;
}

TEST(NastranNonstructural, ClosedForms) {
  EXPECT_NEAR(mass_added("NSM1,5,PBAR,7.,1\n"), 7. * 2, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PBARL,7.,1\n"), 7. * 2, 1e-12);  // the same bars
  EXPECT_NEAR(mass_added("NSM1,5,PBEAM,7.,2\n"), 7. * 2, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PROD,7.,3\n"), 7. * 3, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,CONROD,7.,14\n"), 7. * 3, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PTUBE,7.,ALL\n"), 7. * 3, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PSHELL,7.,6\n"), 7. * 6, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PCOMP,7.,7\n"), 7. * 6, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,PSHEAR,7.,8\n"), 7. * 6, 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,ELEMENT,7.,11,THRU,18,BY,2\n"), 7. * (2 + 3 + 3 + 6), 1e-12);
  EXPECT_NEAR(mass_added("NSM1,5,ELEMENT,7.,ALL\n"), 7. * (2 + 2 + 9 + 18), 1e-12);
  // Pairs over lines; cards of one set add up, elements of a list count once.
  EXPECT_NEAR(mass_added("NSM,5,ELEMENT,11,1.,12,10.,13,100.\n,14,1000.\n"), 2 + 20 + 300 + 3000,
              1e-9);
  EXPECT_NEAR(mass_added("NSM,5,PBAR,1,3.\nNSM1,5,ELEMENT,4.,11,11,10,THRU,11\n"), 2 * 7., 1e-12);
  EXPECT_NEAR(mass_added("NSMADD,5,6,7\nNSM1,6,PROD,1.,3\nNSM1,7,PROD,10.,3\nNSM1,8,PROD,100.,3\n"),
              33., 1e-12);
  // Totals, spread over what they are for.
  EXPECT_NEAR(mass_added("NSML,5,ELEMENT,11,1.,16,10.\n"), 11., 1e-12);
  EXPECT_NEAR(mass_added("NSML1,5,ELEMENT,10.,11,13\n"), 10., 1e-12);
  EXPECT_NEAR(mass_added("NSML1,5,PSHELL,10.,6\n"), 10., 1e-12);
  EXPECT_NEAR(mass_added("NSML1,5,PCOMP,10.,7\nNSML,5,PSHEAR,8,4.\n"), 14., 1e-12);
}

TEST(NastranNonstructural, SpreadByLength) {
  // 10 over a bar of 2 and a rod of 3: the nodes get 2, 2 + 3 and 3.
  const FeModel plain = heavy_deck(with_mass("", "")),
                heavy = heavy_deck(with_mass("NSML1,5,ELEMENT,10.,11,13\n"));
  const SparseMatrix M = assemble(heavy).M - assemble(plain).M;
  const FeSystem system = assemble(heavy);
  const double expected[] = {2, 5, 3, 0};
  for (int node = 0; node < 4; ++node)
    EXPECT_NEAR(M.coeff(system.row(node, 0), system.row(node, 0)), .5 * expected[node], 1e-12);
}

// The same matrices as by the field of the property, here also of a laminate.
TEST(NastranNonstructural, LikeThatOfTheProperty) {
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = with_mass("", "");
    return text.replace(text.find(from), from.size(), to);
  };
  const std::tuple<const char*, const char*, const char*> pairs[] = {
      {"PBAR,1,9,.1,.2,.3,.4", "PBAR,1,9,.1,.2,.3,.4,7.", "NSM1,5,PBAR,7.,1\n"},
      {"PSHELL,6,9,.1,9", "PSHELL,6,9,.1,9,,,,7.", "NSM1,5,PSHELL,7.,6\n"},
      {"PCOMP,7", "PCOMP,7,,7.", "NSM1,5,PCOMP,7.,7\n"}};
  for (const auto& [from, to, card] : pairs) {
    const FeSystem a = assemble(heavy_deck(replaced(from, to))),
                   b = assemble(heavy_deck(with_mass(card)));
    EXPECT_LT((a.M - b.M).norm(), 1e-14 * a.M.norm()) << card;
    EXPECT_LT((a.K - b.K).norm(), 1e-14 * a.K.norm()) << card;
  }
}

TEST(NastranNonstructural, Notes) {
  const FeModel model = heavy_deck(with_mass("NSM1,5,PROD,7.,3,33,1\n"));
  EXPECT_EQ(model.notes.at(model.notes.size() - 4),
            "arm.bdf:27: 2 numbers of nonstructural mass (NSM) are no elements or properties of "
            "their type in the file: they are ignored, as in Nastran");
  EXPECT_EQ(model.notes.at(model.notes.size() - 3),
            "arm.bdf:3: the nonstructural mass of set 5 (NSM) is added, 10.5 in all");
  // Without a selection they are not applied.
  const FeModel none = heavy_deck(with_mass("NSM1,5,PROD,7.,3\n", ""));
  EXPECT_NE(none.notes.back().find("are ignored: NSM1"), std::string::npos);
}

/// A material without density gets that of the options, and the nonstructural mass besides.
TEST(NastranNonstructural, WithADensityOfTheOptions) {
  const TemporaryFolder folder;
  std::string text = with_mass("NSM1,5,PBAR,7.,1\n");
  text.replace(text.find(",.25,2.\n"), 8, ",.25\n");
  FeReadOptions options;
  options.densities[""] = 4.;
  const double plain = mass_of(heavy_deck(with_mass("", "")));
  const FeModel model = read_fe_file(folder.write("arm.bdf", text), options);
  EXPECT_NEAR(mass_of(model) / .5, 2. * plain / .5 + 14., 1e-9);  // 4 in place of 2
}

/// So it does beside that of a property, which is no density by itself.
TEST(NastranNonstructural, OfAPropertyWithoutDensity) {
  const TemporaryFolder folder;
  const auto bar = [](const std::string& density) {
    return "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\n"
           "PBAR,1,9,.1,.2,.3,.4,7.\nMAT1,9,100.,,.25" +
           density + "\nPARAM,WTMASS,.5\n";
  };
  EXPECT_NEAR(mass_of(heavy_deck(bar(",0."))), .5 * 7. * 2., 1e-12);
  EXPECT_EQ(error_of([&] { heavy_deck(bar("")); }),
            "arm.bdf:5: material 'MAT1 9' has no density: give one in the file or as an option "
            "(--density, key `density`; 0 if all mass is in point masses)");
  const std::filesystem::path file = folder.write("arm.bdf", bar(""));
  for (const double density : {0., 4.}) {
    FeReadOptions options;
    options.densities[""] = density;
    EXPECT_NEAR(mass_of(read_fe_file(file, options)), .5 * (density * .1 + 7.) * 2., 1e-12);
  }
  // Once, whatever the mass of each property is.
  const std::string two = bar("") + "CBAR,2,2,1,2,0.,1.,0.\nPBAR,2,9,.1,.2,.3,.4,8.\n";
  EXPECT_EQ(error_of([&] { heavy_deck(two); }), error_of([&] { heavy_deck(bar("")); }));
  FeReadOptions options;
  options.densities[""] = 4.;
  const FeModel model = read_fe_file(folder.write("two.bdf", two), options);
  EXPECT_EQ(std::count_if(model.notes.begin(), model.notes.end(),
                          [](const std::string& note) {
                            return note.ends_with("has no density: 4 is taken, as the options say");
                          }),
            1);
}

/// More than the structure weighs is refused where it stands.
TEST(NastranNonstructural, Negative) {
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = with_mass("", "");
    text.replace(text.find(from), from.size(), to);
    return error_of([&] { heavy_deck(text); });
  };
  EXPECT_EQ(replaced("PBAR,1,9,.1,.2,.3,.4", "PBAR,1,9,.1,.2,.3,.4,-.1"), "no error");  // A RHO: .2
  EXPECT_EQ(replaced("PBAR,1,9,.1,.2,.3,.4", "PBAR,1,9,.1,.2,.3,.4,-.3"),
            "arm.bdf:9: PBAR: its nonstructural mass makes the density of material 9 -1, expected "
            "no negative number");
  EXPECT_EQ(replaced("PBAR,1,9,.1,.2,.3,.4", "PBAR,1,9,0.,.2,.3,.4,-.3"),
            "arm.bdf:9: PBAR 1: A is 0, expected more than 0");
  EXPECT_EQ(replaced("PCOMP,7", "PCOMP,7,,-7."),
            "arm.bdf:20: PCOMP 7: the nonstructural mass is -7, expected no negative number");
  const auto error = [](const std::string& cards) {
    return error_of([&] { heavy_deck(with_mass(cards)); });
  };
  EXPECT_EQ(error("NSM1,5,PBAR,-.1,1"), "no error");
  EXPECT_EQ(error("NSM1,5,PBAR,.1,1\nNSM1,5,PBAR,-.4,1"),
            "arm.bdf:28: NSM1 5: its mass makes the density of element 11 -1, expected no negative "
            "number");
  EXPECT_EQ(error("NSM1,5,PCOMP,-.4,7"),
            "arm.bdf:27: NSM1 5: its mass makes the mass beside its plies of element 17 -0.4, "
            "expected no negative number");
}

TEST(NastranNonstructural, JoinedSets) {
  const auto error = [](const std::string& cards) {
    return error_of([&] { heavy_deck(with_mass(cards)); });
  };
  EXPECT_NE(error("NSMADD,5,1,2\nNSM1,1,PBAR,7.,1\n")
                .find("NSMADD 5 joins set 2, which is not in the file"),
            std::string::npos);
  EXPECT_NE(error("NSMADD,5,1\nNSM1,1,PBAR,7.,1\nNSM1,5,PBAR,7.,1\n")
                .find("the set 5 is one of NSM cards and one of NSMADD, expected only one of both"),
            std::string::npos);
}

TEST(NastranNonstructural, Errors) {
  const auto error = [](const std::string& cards, const std::string& control = "NSM = 5\n") {
    return error_of([&] { heavy_deck(with_mass(cards, control)); });
  };
  const std::pair<const char*, const char*> wrong[] = {
      {"NSM1,5,PBCOMP,7.,1",
       "NSM1 5: the type is 'PBCOMP', expected PSHELL, PCOMP, PBAR, PBARL, "
       "PBEAM, PBEAML, PROD, CONROD, PTUBE, PSHEAR or ELEMENT; others are not "
       "read"},
      {"NSM1,5,PBAR,,1", "NSM1 5: the value is missing"},
      {"NSM1,5,PBAR,7.", "NSM1 5: it has no elements or properties"},
      {"NSM1,5,PBAR,7.,x", "NSM1 5: a number of the list is 'x', expected a whole number from 1"},
      {"NSM1,5,ELEMENT,7.,18,THRU,11,BY,2",
       "NSM1 5: found 18 THRU 11, expected the first to be at most the last"},
      {"NSM,5,PBAR,1", "NSM 5: the value of a number is missing"},
      {"NSML,5,PBAR,1,2.\n,DISTR,MASS", "NSML 5: DISTR is not read"},
      {"NSM1,5,PSHELL,7.,ALL",
       "NSM1 5: it is for ALL PSHELL, but the file has PCOMP too, which may "
       "or may not be meant; list the properties by number"},
      {"NSML1,5,ELEMENT,7.,11,16",
       "NSML1 5: some of its elements have a length and others an area; "
       "a mass is spread over one of both"}};
  for (const auto& [card, sentence] : wrong)
    EXPECT_EQ(error(card), std::string("arm.bdf:27: ") + sentence);
  EXPECT_EQ(error("NSM1,6,PBAR,7.,1"),
            "arm.bdf:3: the case control selects NSM set 5, which is not in the file");
  EXPECT_EQ(error("NSM1,5,PBAR,7.,1", "NSM = 5\nSUBCASE 2\nNSM = 6\n"),
            "arm.bdf:5: the case control selects NSM sets 5 and 6; only one can be read, remove "
            "the other");
}

}  // namespace
}  // namespace floatframe::test

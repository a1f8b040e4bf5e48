// Abaqus decks: nodes in axes of *SYSTEM and in cylindrical coordinates; beams whose section says
// constants and moduli (*BEAM GENERAL SECTION).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

FeModel deck_read(const std::string& text) {
  return read_inp(text, of_dialect(DeckDialect::abaqus));
}

std::string coordinate_deck_error(const std::string& text) {
  return error_of([&] { validate(deck_read(text)); });
}

const std::string body =
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e5, .3\n"
    "*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";

void expect_at(const FeModel& m, int index, const Vec3& p) {
  EXPECT_LT((m.positions[index] - p).norm(), 1e-14) << index;
}

TEST(DeckCoordinates, SystemsOfNodes) {
  // Turned by three points; by two, of which the first axis is seen along z; moved; ended.
  const FeModel m = deck_read(
      "*SYSTEM\n10., 0., 0., 10., 2., 0.\n10., 5., 3.\n*NODE\n1, 1., 2., 3.\n"
      "*SYSTEM\n0., 0., 1., 3., 4., 9.\n*NODE\n2, 5., 0., 2.\n"
      "*SYSTEM\n0., 0., 7.\n*NODE\n3, 1., 1., 1.\n*SYSTEM\n*NODE\n4, 9., 9., 9.\n" +
      body);
  expect_at(m, 0, {13.0, 1.0, 2.0});
  expect_at(m, 1, {3.0, 4.0, 3.0});
  expect_at(m, 2, {1.0, 1.0, 8.0});
  expect_at(m, 3, {9.0, 9.0, 9.0});
}

TEST(DeckCoordinates, Cylindrical) {
  const FeModel m = deck_read(
      "*NODE\n1\n*NODE, SYSTEM=C\n2, 2., 90., 5.\n3, 2., 210.\n*SYSTEM\n1., 0., 0.\n*NODE, "
      "SYSTEM=C\n"
      "4, 3., 180., 1.\n" +
      body);
  expect_at(m, 1, {0.0, 2.0, 5.0});
  expect_at(m, 2, {-std::sqrt(3.0), -1.0, 0.0});
  expect_at(m, 3, {-2.0, 0.0, 1.0});
}

TEST(DeckCoordinates, ASystemEndsWithItsPart) {
  const FeModel m =
      deck_read("*PART, NAME=P\n*SYSTEM\n1., 0., 0.\n*NODE\n1\n2, 1.\n3, 0., 1.\n4, 0., 0., 1.\n" +
                body.substr(0, body.find("*MATERIAL")) +
                "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n*END PART\n*ASSEMBLY, "
                "NAME=A\n*INSTANCE, NAME=I, PART=P\n"
                "0., 0., 5.\n*END INSTANCE\n*NODE\n1, 8., 8., 8.\n*END ASSEMBLY\n"
                "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e5, .3\n*DENSITY\n7.85e-9\n");
  expect_at(m, 0, {1.0, 0.0, 5.0});
  expect_at(m, 4, {8.0, 8.0, 8.0});
}

std::string beams(const std::string& section) {
  return "*NODE\n1\n2, 100., 20.\n3, 200., 30., 40.\n*ELEMENT, TYPE=B31, ELSET=BEAM\n1, 1, 2\n2, "
         "2, 3\n" +
         section;
}

TEST(DeckCoordinates, GeneralSectionsAreThoseOfTheirConstants) {
  // A rectangle of 12 by 20 with E = 210000, nu = 0.3.
  const BeamSection r = BeamSection::rectangle(12.0, 20.0);
  const double G = 210000.0 / 2.6;
  const FeModel plain = deck_read(
      beams("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n12., 20.\n0., 1., 1.\n"
            "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., .3\n*DENSITY\n7.85e-9\n"));
  const std::string constants =
      fmt::format("{:.17g}, {:.17g}, 0., {:.17g}, {:.17g}\n", r.A, r.Iy, r.Iz, r.J);
  const std::string moduli = fmt::format("210000., {:.17g}\n", G);
  for (const std::string& section :
       {"*BEAM GENERAL SECTION, ELSET=BEAM, SECTION=GENERAL, DENSITY=7.85e-9\n" + constants +
            "0., 1., 1.\n" + moduli,
        "*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=7.85e-9\n" + constants + "0., 1., 1.\n" +
            moduli,
        "*BEAM GENERAL SECTION, ELSET=BEAM, SECTION=RECT, DENSITY=7.85e-9\n12., 20.\n0., 1., 1.\n" +
            moduli}) {
    SCOPED_TRACE(section);
    FeModel m = deck_read(beams(section));
    validate(m);
    // The shear area of a rectangle is 0.85 A, that of constants A.
    const bool constant = section.find("RECT") == std::string::npos;
    EXPECT_NEAR(m.sections[0].shear_y, (constant ? 1.0 : 0.85) * r.A, 1e-12 * r.A);
    m.sections[0].shear_y = m.sections[0].shear_z = plain.sections[0].shear_y;
    const SparseMatrix K = assemble_stiffness(plain), M = assemble_mass(plain, true, 6);
    EXPECT_LE((assemble_stiffness(m) - K).norm(), 1e-13 * K.norm());
    EXPECT_LE((assemble_mass(m, true, 6) - M).norm(), 1e-13 * M.norm());
  }
  // Without direction 1 it is -z, as in *BEAM SECTION.
  const FeModel m =
      deck_read(beams("*BEAM GENERAL SECTION, ELSET=BEAM\n" + constants + "\n" + moduli));
  EXPECT_EQ(m.elements[0].reference, -Vec3::UnitZ());
  EXPECT_EQ(m.without_density.size(), 1u);
}

TEST(DeckCoordinates, Errors) {
  struct Case {
    std::string text, message;
  };
  const std::string general = "*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=1.\n";
  const Case cases[] = {
      {"*SYSTEM\n0., 0., 0., 1., 0., 0.\n2., 0., 0.\n*NODE\n1\n", "deck.inp:1: geometry"},
      {"*SYSTEM\n0., 0., 0., 0., 0., 1.\n*NODE\n1\n", "deck.inp:1: geometry"},
      {"*SYSTEM\n0., zero, 0.\n*NODE\n1\n", "deck.inp:2: not_a_number"},
      {"*NODE, SYSTEM=S\n1, 1., 2., 3.\n", "deck.inp:1: wrong_value"},
      {"*NODE\n1\n5, 1.\n*SYSTEM\n1., 1., 1.\n*NGEN, LINE=C\n1, 5, 1, , 0., 0., 0.\n",
       "deck.inp:6: unsupported"},
      {"*NODE, NSET=A\n1\n*SYSTEM\n1., 1., 1.\n*NCOPY, CHANGE NUMBER=10, OLD SET=A, SHIFT\n1., 1., "
       "1.\n\n",
       "deck.inp:5: unsupported"},
      {beams(general + "1., 1., 0., 1.\n"), "deck.inp:8: wrong_count"},
      {beams(general + "1., 1., .5, 1., 1.\n1., .4\n"), "deck.inp:9: out_of_range"},
      {beams(general + "1., 0., 0., 1., 1.\n1., .4\n"), "deck.inp:9: out_of_range"},
      {beams(general + "1., 1., 0., 1., 1., 0., 2.\n1., .4\n"), "deck.inp:9: unsupported"},
      {beams(general + "1., 1., 0., 1., 1.\n"), "deck.inp:8: unsupported"},
      {beams(general + "1., 1., 0., 1., 1.\n0., 1., 0.\n1., .4\n2., .4\n"),
       "deck.inp:8: unsupported"},
      {beams(general + "1., 1., 0., 1., 1.\n0., 0., 0.\n1., .4\n"), "deck.inp:10: geometry"},
      {beams(general + "1., 1., 0., 1., 1.\n3.\n"), "deck.inp:8: wrong_count"},
      {beams(general + "1., 1., 0., 1., 1.\n3., .5\n"), "deck.inp:8: contradiction"},
      {beams("*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=1., LUMPED=NO\n1., 1., 0., 1., 1.\n1., "
             ".4\n"),
       "deck.inp:8: unsupported"},
      {beams("*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=nan\n1., 1., 0., 1., 1.\n1., .4\n"),
       "deck.inp:8: out_of_range"},
      {beams("*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=heavy\n1., 1., 0., 1., 1.\n1., .4\n"),
       "deck.inp:8: out_of_range"},
      {beams("*MATERIAL, NAME=M\n*ELASTIC\n1., .3\n*BEAM SECTION, ELSET=BEAM, MATERIAL=M, "
             "SECTION=RECT, "
             "DENSITY=1.\n1., 1.\n"),
       "deck.inp:11: exclusive"},
      // One error, not those that follow from it.
      {"*MATERIAL, NAME=A\n*ELASTIC\n1., .3\n*DENSITY\n1.\n*MATERIAL, NAME=A\n*ELASTIC\n2., "
       ".3\n*DENSITY\n1.\n",
       "deck.inp:6: duplicate"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string found = coordinate_deck_error(c.text);
    EXPECT_EQ(found.substr(0, found.find('\n')), c.message);
    if (c.message.find("a second time") != std::string::npos) {
      EXPECT_FALSE(contains(found, "another"));
      EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << found;
    }
  }
}

}  // namespace
}  // namespace floatframe::test

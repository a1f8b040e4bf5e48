// Keywords of decks that are not read: the harmless ones are known by name, all others stop. Whose
// deck it is, Abaqus or CalculiX, where the two read a section differently.
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>
#include <string>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string known_deck =
    "*NODE\n1\n2, 1.\n3, 0., 1.\n4, 0., 0., 1.\n"       // 1 to 5
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n"  // 6, 7
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e5, .3\n"      // 8 to 10
    "*DENSITY\n7.85e-9\n"                               // 11, 12
    "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";     // 13

FeModel parsed(const std::string& text, DeckDialect dialect = DeckDialect::by_content,
               DeckPart part = DeckPart::all) {
  TextSource source(text, "deck.inp");
  return read_abaqus(source, of_dialect(dialect), part);
}

std::string error(const std::string& text, DeckDialect dialect = DeckDialect::by_content) {
  return error_of([&] { parsed(text, dialect); });
}

TEST(DeckKeywords, UnknownOnesStop) {
  EXPECT_EQ(error(known_deck + "*SPECIAL LAYER\n1, 2\n*SPECIAL LAYER\n3\n"),
            "deck.inp:14: unknown_key");
}

TEST(DeckKeywords, MeansOfRotations) {
  const auto deck = [](const std::string& parameter) {
    return known_deck +
           "*NODE\n9, .1, .1, 2.\n*SURFACE, NAME=S\nBODY, S1\n*COUPLING, REF NODE=9, "
           "SURFACE=S, CONSTRAINT NAME=C\n*DISTRIBUTING" +
           parameter + "\n";
  };
  const auto said = [&](const std::string& parameter) {
    for (const std::string& note : parsed(deck(parameter)).notes)
      if (note.find("*DISTRIBUTING") != std::string::npos) return note;
    return std::string();
  };
  EXPECT_EQ(said(""), "");
  EXPECT_EQ(said(", COUPLING=CONTINUUM"), "");
  EXPECT_EQ(said(", COUPLING=STRUCTURAL"),
            "deck.inp:19: *DISTRIBUTING, COUPLING=STRUCTURAL is taken as CONTINUUM: the reference "
            "follows the displacements of its nodes, rotations of nodes of shells and beams do not "
            "count");
  EXPECT_EQ(error(deck(", COUPLING=BOTH")), "deck.inp:19: wrong_value");
}

TEST(DeckKeywords, ThoseThatMatterStopWithAdvice) {
  const std::pair<const char*, const char*> cases[] = {
      {"*REBAR, ELEMENT=CONTINUUM, MATERIAL=STEEL, NAME=R\nBODY, 1.\n", "unsupported"},
      {"*Surface Section, elset=BODY, density=0.1\n", "unsupported"},
      {"*FOUNDATION\nBODY, F1, 3.\n", "unsupported"},
      {"*CONNECTOR DAMPING, COMPONENT=1\n3.\n", "unsupported"},
      {"*ELEMENT, TYPE=CONN3D2, ELSET=HINGE\n2, 1, 2\n", "unsupported"},
      {"*TRANSVERSE SHEAR STIFFNESS\n1., 1., 1.\n", "unsupported"},
      {"*ELASTIC\n7.e4, .3\n", "duplicate"},
      {"*DENSITY\n1.\n", "duplicate"}};
  for (const auto& [keyword, expected] : cases)
    EXPECT_EQ(error(known_deck + keyword), std::string("deck.inp:14: ") + expected);
}

TEST(DeckKeywords, BoltsWithoutTheirPreload) {
  const FeModel model =
      parsed(known_deck +
             "*SURFACE, NAME=S\n1, S1\n*PRE-TENSION SECTION, SURFACE=S, NODE=4\n1., 0., 0.\n");
  ASSERT_EQ(model.notes.size(), 2u);  // and that of the mass
  EXPECT_EQ(model.notes[0],
            "deck.inp:16: *PRE-TENSION SECTION is ignored: the bolt is whole and without its "
            "preload");
}

TEST(DeckKeywords, BoltsOfASurfaceThatIsNotThere) {
  EXPECT_EQ(error(known_deck +
                  "*SURFACE, NAME=SHANK\n1, S1\n*PRE-TENSION SECTION, SURFACE=SHANC, NODE=4\n"),
            "deck.inp:16: not_found");
}

TEST(DeckKeywords, SurfaceSectionWithoutMassIsNoted) {
  const FeModel model = parsed(known_deck + "*SURFACE SECTION, ELSET=SKIN\n");
  ASSERT_EQ(model.notes.size(), 2u);  // and that of the mass
  EXPECT_EQ(model.notes[0], "deck.inp:14: *SURFACE SECTION of 'SKIN' is ignored: it has no mass");
}

TEST(DeckKeywords, HarmlessOnesAreKnown) {
  std::istringstream names(
      "AMPLITUDE,Physical Constants,INITIAL CONDITIONS,EXPANSION,CONDUCTIVITY,"
      "SPECIFIC HEAT,PLASTIC,CREEP,DAMPING,DAMAGE INITIATION,DEPVAR,PREPRINT,RESTART,"
      "TIME POINTS,FILTER,SURFACE INTERACTION,SURFACE BEHAVIOR,FRICTION,"
      "CONTACT CONTROLS,SECTION CONTROLS,SUBMODEL,USER DEFINED FIELD,CLOAD,DLOAD,"
      "TEMPERATURE,NODE FILE,EL FILE,NODE PRINT,EL PRINT,OUTPUT,NODE OUTPUT,"
      "ELEMENT OUTPUT,STATIC,FREQUENCY,END STEP,VALUES AT INFINITY,DESIGN VARIABLES,"
      "PSD-DEFINITION,FILE FORMAT,CAST IRON PLASTICITY,RETAINED NODAL DOFS,"
      "FILM PROPERTY,MODAL DAMPING");
  for (std::string name; std::getline(names, name, ',');) {
    EXPECT_EQ(error(known_deck + "*" + name + ", A=B\n1., 2.\nx, y\n"), "no error") << name;
  }
}

TEST(DeckKeywords, WithMatricesOnlyNodesAreRead) {
  const FeModel model = parsed(
      known_deck + "*SPECIAL LAYER\n1, 2\n*STEP\n*MODEL CHANGE, REMOVE, TYPE=ELEMENT\nBODY\n",
      DeckDialect::by_content, DeckPart::nodes);
  EXPECT_EQ(model.nodes(), 4);
  EXPECT_EQ(model.notes.at(0), "deck.inp:14: *SPECIAL LAYER is not known and is ignored");
}

TEST(DeckKeywords, StepsDoNotChangeThePart) {
  EXPECT_EQ(error(known_deck + "*STEP\n*STATIC\n*ELEMENT, TYPE=MASS, ELSET=M\n9, 1\n"),
            "deck.inp:16: contradiction");
  EXPECT_EQ(error(known_deck + "*STEP\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nBODY\n*END STEP\n"),
            "deck.inp:15: contradiction");
  EXPECT_EQ(error(known_deck + "*STEP\n*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nA, B\n"
                               "*CHANGE FRICTION\n*BOUNDARY\n1, 1, 3\n*EQUATION, REMOVE\n1, 1\n"
                               "*EQUATION, REMOVE ALL\n"
                               "*END STEP\n"),
            "no error");
}

// Three-node beams with a round section; line 13 is *BEAM SECTION.
std::string beam(const std::string& section, const std::string& more = "",
                 const std::string& type = "B32") {
  return "*NODE, NSET=N\n1\n2, .5\n3, 1.\n4, 2.\n"
         "*ELEMENT, TYPE=" +
         type + ", ELSET=E\n1, 1, " + (type.starts_with("B32") ? "2, 3" : "3") +
         "\n*MATERIAL, NAME=M\n*ELASTIC\n1., .25\n*DENSITY\n1.\n"
         "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" +
         section + "\n" + more;
}

constexpr double pi = std::numbers::pi;
const std::string calculix_clue = "*STEP\n*FREQUENCY, SOLVER=PARDISO\n3\n*END STEP\n";
const std::string abaqus_clue = "*STEP, NAME=Step-1\n*FREQUENCY\n3\n*END STEP\n";

TEST(DeckDialects, ARoundSectionWithoutClueIsRefused) {
  EXPECT_EQ(error(beam("CIRC\n2.")), "deck.inp:13: out_of_range");
  EXPECT_EQ(error(beam("CIRC\n2.", calculix_clue + abaqus_clue)), "deck.inp:13: out_of_range");
}

TEST(DeckDialects, UserOptionOverridesDetection) {
  EXPECT_NEAR(parsed(beam("CIRC\n2."), DeckDialect::abaqus).sections.at(0).A, 4.0 * pi, 1e-14);
  EXPECT_NEAR(parsed(beam("CIRC\n2."), DeckDialect::calculix).sections.at(0).A, pi, 1e-14);
  // Also against what the deck looks like.
  EXPECT_NEAR(parsed(beam("CIRC\n2.", abaqus_clue), DeckDialect::calculix).sections.at(0).A, pi,
              1e-14);
}

TEST(DeckDialects, DetectsDialectFromKeywords) {
  const FeModel calculix = parsed(beam("CIRC\n2.", calculix_clue));
  EXPECT_NEAR(calculix.sections.at(0).A, pi, 1e-14);
  EXPECT_EQ(calculix.notes.back(),
            "deck.inp:13: *BEAM SECTION, SECTION=CIRC: 2 is the diameter, as in CalculiX "
            "(*FREQUENCY, SOLVER=PARDISO in deck.inp:16)");
  EXPECT_NEAR(
      parsed(beam("CIRC\n2.", "*RIGID BODY, NSET=N, REF NODE=4, ROT NODE=1\n")).sections.at(0).A,
      pi, 1e-14);
  const FeModel abaqus = parsed(beam("CIRC\n2.", abaqus_clue));
  EXPECT_NEAR(abaqus.sections.at(0).A, 4.0 * pi, 1e-14);
  EXPECT_NEAR(parsed("*PREPRINT, ECHO=NO\n" + beam("CIRC\n2.")).sections.at(0).A, 4.0 * pi, 1e-14);
  // CalculiX takes round sections for elements of three nodes only.
  const FeModel linear = parsed(beam("CIRC\n2.", "", "B31"));
  EXPECT_NEAR(linear.sections.at(0).A, 4.0 * pi, 1e-14);
  EXPECT_TRUE(
      contains(linear.notes.front(), "2 is the radius, as in Abaqus (SECTION=CIRC for B31 in "));
}

TEST(DeckDialects, TwoNumbersAreAnEllipseOfCalculix) {
  const BeamSection s = parsed(beam("CIRC\n4., 2.")).sections.at(0);
  EXPECT_NEAR(s.A, 2.0 * pi, 1e-14);
  EXPECT_NEAR(s.Iz, pi * 64.0 * 2.0 / 64.0, 1e-14);  // 4 along direction 1, the local y
  EXPECT_NEAR(s.Iy, pi * 4.0 * 8.0 / 64.0, 1e-14);
  EXPECT_NEAR(s.J, pi * 64.0 * 8.0 / (16.0 * 20.0), 1e-13);
  const BeamSection circle = parsed(beam("CIRC\n2., 2.")).sections.at(0),
                    round_bar = BeamSection::solid_round(2.0);
  EXPECT_NEAR(circle.Iy, round_bar.Iy, 1e-14);
  EXPECT_NEAR(circle.J, round_bar.J, 1e-14);
  // A square, and the clue that it is one of CalculiX for the round section.
  const FeModel both = parsed(beam("RECT\n3.",
                                   "*ELEMENT, TYPE=B32, ELSET=F\n2, 1, 2, 3\n"
                                   "*BEAM SECTION, ELSET=F, MATERIAL=M, SECTION=CIRC\n"
                                   "2.\n"));
  EXPECT_NEAR(both.sections.at(0).A, 9.0, 1e-14);
  EXPECT_NEAR(both.sections.at(1).A, pi, 1e-14);
  EXPECT_EQ(error(beam("CIRC\n4., 2."), DeckDialect::abaqus), "deck.inp:13: wrong_count");
  EXPECT_EQ(error(beam("CIRC\n4., 2.", abaqus_clue)), "deck.inp:13: unsupported");
  EXPECT_EQ(error(beam("CIRC\n4., 2., 1.")), "deck.inp:13: wrong_count");
  EXPECT_EQ(error(beam("PIPE\n4.")), "deck.inp:13: wrong_count");
  // One error for a number that is wrong.
  EXPECT_EQ(error(beam("PIPE\n-4., 1.")), "deck.inp:14: out_of_range");
  EXPECT_EQ(error(beam("BOX\n1., 0., .1, .1, .1, .1")), "deck.inp:14: out_of_range");
  EXPECT_EQ(error(beam("RECT\nwide, 1.")), "deck.inp:14: not_a_number");
}

}  // namespace
}  // namespace floatframe::test

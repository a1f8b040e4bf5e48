// What CalculiX takes in decks beside the rules: fields too many, abbreviations, sections.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

FeModel habit_deck(const std::string& text) {
  const TemporaryFolder folder;
  FeModel model = read_fe_file(folder.write("deck.inp", text), of_dialect(DeckDialect::calculix));
  for (std::string& note : model.notes) note = folder.without(note);
  return model;
}

const char* const steel_of_deck =
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3\n*DENSITY\n7.8E-9\n";

TEST(CalculixHabits, FieldsBehindNodesAndElements) {
  const FeModel model = habit_deck(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0, 0, 0\n3, , 1, , 1\n4, 0, 0, 1\n"
      "*ELEMENT, TYPE=C3D4, ELSET=E\n7, 1, 2, 3, 4, 3, 3\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n" +
      std::string(steel_of_deck));
  EXPECT_EQ(model.positions[2], Vec3(0, 1, 0));
  ASSERT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.elements[0].nodes[3], 3);
  EXPECT_TRUE(has_note(model, "deck.inp:3: fields after the coordinates of 2 nodes are ignored"));
  EXPECT_TRUE(has_note(model,
                       "deck.inp:7: 1 element of type C3D4 with more than 4 nodes: the "
                       "others are ignored, as CalculiX does"));
}

TEST(CalculixHabits, FurtherNodesOfShellsAreAnError) {
  const std::string error = error_of([] {
    habit_deck(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=S3, ELSET=E\n"
        "7, 1, 2, 3, 4\n*SHELL SECTION, ELSET=E, MATERIAL=STEEL\n0.1\n" +
        std::string(steel_of_deck));
  });
  EXPECT_EQ(test::without_folders(error), "deck.inp:7: wrong_count") << error;
}

/// The same bar, its section written in two ways.
FeModel bar_with(const std::string& section) {
  return habit_deck(
      "*NODE\n1, 0, 0, 0\n2, 5, 0, 0\n3, 10, 0, 0\n*ELEMENT, TYPE=B32R, ELSET=E\n7, 1, 2, "
      "3\n" +
      section + "\n0, 1, 0\n" + steel_of_deck);
}

TEST(CalculixHabits, GeneralSectionsAndWholeWords) {
  const FeModel pipe = bar_with("*BEAM SECTION, SECTION=PIPE, ELSET=E, MATERIAL=STEEL\n1, 0.2");
  const FeModel general =
      bar_with("*BEAM GENERAL SECTION, SECTION=PIPE, ELSET=E, MATERIAL=STEEL\n1, 0.2");
  EXPECT_EQ(general.sections[0].Iy, pipe.sections[0].Iy);
  EXPECT_EQ(general.sections[0].J, pipe.sections[0].J);
  const FeModel word =
      bar_with("*BEAM SECTION, SECTION=RECTANGULAR, ELSET=E, MATERIAL=STEEL\n1, 2");
  EXPECT_EQ(word.sections[0].A, 2.0);
  EXPECT_EQ(word.sections[0].width, 1.0);
}

TEST(CalculixHabits, SurfacesOpenedAgainGrow) {
  const std::string deck =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4, ELSET=E\n"
      "7, 1, 2, 3, 4\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*SURFACE, NAME=S\n7, S1\n"
      "*SURFACE, NAME=S\n7, S3\n" +
      std::string(steel_of_deck);
  const FeModel model = habit_deck(deck);
  ASSERT_EQ(model.surfaces.at("S").size(), 2u);
  EXPECT_EQ(model.surfaces.at("S")[1].face, 2);
  EXPECT_TRUE(has_note(model,
                       "deck.inp:11: *SURFACE has 'S' again (deck.inp:9): what it names is "
                       "added, as in CalculiX"));
  // Nodes and faces are two surfaces there, of which those of faces have more to say.
  for (const char* both : {"*SURFACE, NAME=T, TYPE=NODE\n1\n*SURFACE, NAME=T\n7, S2\n",
                           "*SURFACE, NAME=T\n7, S2\n*SURFACE, NAME=T, TYPE=NODE\n1\n"}) {
    const FeModel faces = habit_deck(deck + both);
    ASSERT_EQ(faces.surfaces.at("T").size(), 1u);
    EXPECT_FALSE(faces.node_sets.contains("T"));
    EXPECT_EQ(faces.notes[1].substr(13),
              "*SURFACE has 'T' again (deck.inp:18): of nodes and of faces those of faces count");
  }
  EXPECT_EQ(inp_error(deck, of_dialect(DeckDialect::abaqus)), "deck.inp:11: duplicate");
}

TEST(CalculixHabits, TheLastSectionOfAnElementCounts) {
  const FeModel model = habit_deck(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4, ELSET=E\n"
      "7, 1, 2, 3, 4\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=AL\n*MATERIAL, NAME=AL\n*ELASTIC\n70000, .3\n" +
      std::string(steel_of_deck));
  EXPECT_EQ(model.materials[static_cast<std::size_t>(model.elements[0].material)].young, 70000);
  EXPECT_TRUE(has_note(model,
                       "deck.inp:9: *SOLID SECTION is the second one of element 7 (C3D4): the "
                       "last one counts, as in CalculiX"));
}

}  // namespace
}  // namespace floatframe::test

// SYSTEM=Z RECTANGULAR of *ORIENTATION: a lies on the third axis in Abaqus. CalculiX 2.20 takes it
// as RECTANGULAR, a on the first axis, without a word: a bar of six C3D8I held at one end has 49.97
// and 50.78 Hz there with either word.
#include <gtest/gtest.h>

#include <numbers>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

FeModel axes_deck(const std::string& system, const std::string& more = {},
                  DeckDialect dialect = DeckDialect::by_content) {
  return valid_inp(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 2, 0, 0\n"
      "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n"
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n2e11, 1e10, 1e10, .3, .3, .3, 5e9, 5e9\n3e9\n"
      "*DENSITY\n7800\n*ORIENTATION, NAME=O, SYSTEM=" +
          system + "\n0, 0, 1, 1, 0, 0\n*SOLID SECTION, ELSET=E, MATERIAL=M, ORIENTATION=O\n" +
          more,
      of_dialect(dialect), "axes.inp");
}

const std::string axes_of_abaqus =
    "axes.inp:15: orientation 'O': SYSTEM=Z RECTANGULAR is taken as in Abaqus; if the deck is one "
    "of CalculiX, which takes it as RECTANGULAR, give --dialect calculix";
const std::string axes_of_calculix =
    "axes.inp:15: orientation 'O': SYSTEM=Z RECTANGULAR is taken as RECTANGULAR, as CalculiX does; "
    "if the deck is one of Abaqus give --dialect abaqus";
const std::string axes_solver = "*STEP\n*FREQUENCY, SOLVER=PARDISO\n4\n*END STEP\n";

/// The notes about axes.
std::vector<std::string> axes_notes(const FeModel& m) {
  std::vector<std::string> out;
  for (const std::string& note : m.notes)
    if (note.find("RECTANGULAR") != std::string::npos) out.push_back(note);
  return out;
}

Mat3 first_axes(const FeModel& m) { return m.orientations.at(0).at(Vec3::Zero()); }

TEST(DeckAxes, OfAbaqusUnlessTheDeckIsOfCalculix) {
  Mat3 first, third;  // a on the first axis, on the third
  first << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  third << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  using Notes = std::vector<std::string>;
  const auto expect = [&](const FeModel& m, const Mat3& axes, const Notes& notes) {
    EXPECT_EQ(first_axes(m), axes);
    EXPECT_EQ(axes_notes(m), notes);
  };
  const std::string z = "Z RECTANGULAR", own = "*PREPRINT\n";
  expect(axes_deck("RECTANGULAR"), first, {});
  expect(axes_deck(z), third, {axes_of_abaqus});
  expect(axes_deck(z, own), third, {});
  expect(axes_deck(z, {}, DeckDialect::abaqus), third, {});
  expect(axes_deck(z, axes_solver, DeckDialect::abaqus), third, {});
  expect(axes_deck(z, {}, DeckDialect::calculix), first, {axes_of_calculix});
  expect(axes_deck(z, axes_solver), first, {axes_of_calculix});
  expect(axes_deck(z, own + axes_solver), third, {axes_of_abaqus});
}

// CalculiX 2.20: the bar with a point c, or with 30 degrees about a blank axis, has 45.31 and 67.23
// Hz as without them; with 30 degrees about axis 3 15.08 and 23.64 Hz.
TEST(DeckAxes, PointAndTurnThatCalculixPassesOver) {
  const auto deck = [](const std::string& lines, DeckDialect dialect) {
    return axes_deck("RECTANGULAR\n" + lines + "*ORIENTATION, NAME=UNUSED", {}, dialect);
  };
  Mat3 plain, moved, turned;
  plain << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  moved << 0, 1, 0, 0, 0, -1, -1, 0, 0;  // a - c = -z, b - c = x
  turned = plain * Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitX()).toRotationMatrix();
  const std::string c = "0, 0, 1, 1, 0, 2, 0, 0, 2\n", turn = "0, 0, 1, 1, 0, 0\n, 30.\n";
  const auto notes = [](const FeModel& m) {
    std::string text;
    for (const std::string& note : m.notes)
      if (note.starts_with("axes.inp:15: orientation")) text += note;
    return text;
  };
  const std::string which = "if the deck is one of ";
  const auto expect = [&](const FeModel& m, const Mat3& axes, const std::string& note) {
    EXPECT_LT((first_axes(m) - axes).norm(), 1e-14);
    EXPECT_EQ(notes(m), note.empty() ? "" : "axes.inp:15: orientation 'O': " + note);
  };
  const std::string point = "its point c at (0, 0, 2) is ";
  const std::string blank =
      "the additional rotation of 30 degrees, whose axis is blank (1 in Abaqus), is ";
  const std::string ours =
      "taken as in Abaqus; " + which + "CalculiX, which ignores it, give --dialect calculix";
  const std::string theirs = "ignored, as CalculiX does; " + which + "Abaqus give --dialect abaqus";
  expect(deck(c, DeckDialect::abaqus), moved, "");
  expect(deck(c, DeckDialect::by_content), moved, point + ours);
  expect(deck(c, DeckDialect::calculix), plain, point + theirs);
  expect(deck(turn, DeckDialect::abaqus), turned, "");
  expect(deck(turn, DeckDialect::by_content), turned, blank + ours);
  expect(deck(turn, DeckDialect::calculix), plain, blank + theirs);
  expect(deck("0, 0, 1, 1, 0, 0\n1, 30.\n", DeckDialect::calculix), turned, "");
}

// CalculiX 2.20: a plate of S4 has 285.29 and 421.70 Hz with and without ", 0.".
TEST(DeckAxes, BlankAxisOfShells) {
  const auto notes = [](const std::string& line, DeckDialect dialect) {
    const FeModel model = read_inp(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*ELEMENT, TYPE=S4, ELSET=E\n"
        "1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
        "2e11, 1e10, 1e10, .3, .3, .3, 5e9, 5e9\n3e9\n*DENSITY\n7800\n*ORIENTATION, NAME=O\n"
        "1, .2, .1, -.2, 1, .3\n" +
            line + "*SHELL SECTION, ELSET=E, MATERIAL=M, ORIENTATION=O\n.01\n",
        of_dialect(dialect), "shell.inp");
    std::string text;
    for (const std::string& note : model.notes)
      if (note.find("orientation") != std::string::npos) text += note + "\n";
    return text;
  };
  const std::string blank =
      "shell.inp:14: orientation 'O': the additional rotation of 0 degrees, whose axis is blank (1 "
      "in Abaqus), is ";
  EXPECT_EQ(notes(", 0.\n", DeckDialect::by_content),
            blank +
                "taken as in Abaqus; if the deck is one of CalculiX, which ignores it, give "
                "--dialect calculix\n");
  EXPECT_EQ(notes(", 0.\n", DeckDialect::calculix),
            blank +
                "ignored, as CalculiX does; if the deck is one of Abaqus give --dialect "
                "abaqus\n");
  EXPECT_EQ(notes("1, 0.\n", DeckDialect::by_content),
            "shell.inp:14: orientation 'O' of shells turns about axis 1, which is taken about the "
            "normal as in Abaqus; if the deck is one of CalculiX, which turns the axes in space, "
            "give --dialect calculix\n");
  EXPECT_EQ(notes("1, 0.\n", DeckDialect::abaqus), "");
  EXPECT_EQ(notes("3, 0.\n", DeckDialect::by_content), "");
}

// a and b on a line with c is an error in Abaqus, with the origin in CalculiX.
TEST(DeckAxes, PointsOnALine) {
  const auto deck = [](const std::string& points, DeckDialect dialect) {
    return error_of(
        [&] { axes_deck("RECTANGULAR\n" + points + "\n*ORIENTATION, NAME=UNUSED", {}, dialect); });
  };
  const std::string with_c = "1, 0, 0, 0, 1, 0, .5, .5, 0", without = "1, 0, 0, 2, 0, 0, 0, 0, 1";
  const std::string error = "axes.inp:15: wrong_value";
  EXPECT_EQ(deck(with_c, DeckDialect::abaqus), error);
  EXPECT_EQ(deck(with_c, DeckDialect::calculix), "no error");
  EXPECT_EQ(deck(without, DeckDialect::abaqus), "no error");
  EXPECT_EQ(deck(without, DeckDialect::calculix), error);
}

// Where nothing else shows whose deck it is.
TEST(DeckAxes, AreAMarkOfAbaqus) {
  const std::string beam =
      "*MATERIAL, NAME=S\n*ELASTIC\n2e11, .3\n*DENSITY\n7800\n*ELEMENT, TYPE=B32, ELSET=B\n"
      "2, 1, 2, 5\n*BEAM SECTION, ELSET=B, MATERIAL=S, SECTION=CIRC\n.03\n0, 1, 0\n";
  EXPECT_NEAR(axes_deck("ZRECTANGULAR", beam).sections[0].A, std::numbers::pi * 9e-4, 1e-15);
  EXPECT_NEAR(axes_deck("ZRECTANGULAR", beam + axes_solver).sections[0].A,
              std::numbers::pi * 2.25e-4, 1e-15);
}

}  // namespace
}  // namespace floatframe::test

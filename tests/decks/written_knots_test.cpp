// Decks written for CalculiX: rotations of nodes where beams meet, couplings of some directions,
// the number of modes. That CalculiX runs them as expected is in tests/cli/convert_test.py.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "decks/written_mesh.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {
namespace {

/// Two frames of two legs, one above the other, the turns of their corners 13 and 113 equal.
struct KnottedFrames {
  bool straight = false, reversed = false;
  std::string other_section = ".02, .03", further;

  FeModel read() const {
    std::string text = "*NODE\n";
    for (const int s : {0, 100})
      for (int k = 0; k <= 24; ++k) {
        const double x = 0.05 * (straight ? k : std::min(k, 12)), y = 0.05 * std::max(k - 12, 0);
        text += fmt::format("{}, {}, {}, {}\n", s + k + 1, x, straight ? 0.0 : y, s / 1000.0);
      }
    for (int e = 0; e < 12; ++e) {
      if (e % 6 == 0) text += fmt::format("*ELEMENT, TYPE=B32, ELSET={}\n", e == 0 ? "A" : "B");
      for (const int s : {0, 100}) {
        int first = s + 2 * e + 1, last = first + 2;
        if (reversed && e >= 6) std::swap(first, last);
        text += fmt::format("{}, {}, {}, {}\n", s + e + 1, first, s + 2 * e + 2, last);
      }
    }
    text += "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, .3\n*DENSITY\n7800.\n";
    for (const auto& [set, size] : {std::pair{"A", std::string(".02, .03")}, {"B", other_section}})
      text += fmt::format("*BEAM SECTION, ELSET={}, MATERIAL=M, SECTION=RECT\n{}\n0., 0., 1.\n",
                          set, size);
    for (int k = 1; k <= 3; ++k) text += fmt::format("*EQUATION\n2\n113,{0},1.,13,{0},-1.\n", k);
    const TemporaryFolder folder;
    return read_fe_file(folder.write("frames.inp", text + further),
                        of_dialect(DeckDialect::calculix));
  }
};

const std::string same_turns =
    "*EQUATION\n2\n113,4,1.,13,4,-1.\n*EQUATION\n2\n113,5,1.,13,5,-1.\n*EQUATION\n2\n113,6,1.,13,"
    "6,-1.\n";

TEST(WrittenKnots, TurnsOfNodesWhereBeamsMeetAreKept) {
  for (const KnottedFrames& frames :
       {KnottedFrames{.further = same_turns},
        KnottedFrames{.straight = true, .reversed = true, .further = same_turns},
        KnottedFrames{.straight = true, .other_section = ".02, .025", .further = same_turns}}) {
    const FeModel model = frames.read();
    const std::string text = written(model, ".inp").bytes;
    for (int axis = 4; axis <= 6; ++axis)
      EXPECT_TRUE(contains(text, fmt::format("113, {0}, -1, 13, {0}, 1\n", axis)));
    expect_same_system(model, there_and_back(model, ".inp"));
  }
  // In one line, with one section, CalculiX makes one row of solids.
  const FeModel line = KnottedFrames{.straight = true, .further = same_turns}.read();
  EXPECT_EQ(test::without_folders(error_of([&] { written(line, ".inp"); })),
            "frames.inp:90: unsupported");
  // A rod at the corner, at whose nodes CalculiX hinges what it makes.
  const FeModel rod =
      KnottedFrames{.further =
                        "*ELEMENT, TYPE=T3D2, ELSET=R\n500, 13, 125\n*SOLID SECTION, "
                        "ELSET=R, MATERIAL=M\n1e-4\n" +
                        same_turns}
          .read();
  EXPECT_EQ(test::without_folders(error_of([&] { written(rod, ".inp"); })),
            "frames.inp:90: unsupported");
}

// CalculiX 2.20 finds seven frequencies of zero of a beam that stands askew on the corner of a
// plate, where a shell of ours has some stiffness about its normal.
TEST(WrittenKnots, BeamsOnShellsAreNoted) {
  FeModel model = KnottedFrames{}.read();
  EXPECT_FALSE(contains(written_notes(model, ".inp"), "beams and shells share"));
  FeElement plate = model.elements[0];
  plate.type = FeElementType::tri3;
  plate.nodes = {0, 12, 24};
  plate.section = 0;
  plate.id = 900;
  model.elements.push_back(plate);
  model.shells = {{.thickness = 0.01, .shear = 0.01 * 5.0 / 6.0}};
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "beams and shells share 3 nodes: a shell of CalculiX does not resist that a "
                       "beam turns there about the normal of the shell, which is a frequency of "
                       "zero where nothing else does; first: node 1\n"));
}

// CalculiX 2.20 finds 43.9 Hz of a frame with a mass on three rods that have the larger numbers
// (43.8 here), and 132 Hz if they have the smaller ones: they come loose along z.
TEST(WrittenKnots, RodsAreNumberedAfterBeams) {
  const auto with_rod = [](int number) {
    return KnottedFrames{.further = fmt::format("*ELEMENT, TYPE=T3D2, ELSET=R\n{}, 1, 25\n*SOLID "
                                                "SECTION, ELSET=R, MATERIAL=M\n1e-6\n",
                                                number)}
        .read();
  };
  const std::string note = "1 rod is numbered anew, after the beams that they meet";
  EXPECT_FALSE(contains(written_notes(with_rod(500), ".inp"), note));
  const FeModel model = with_rod(13);  // beams have 1 to 12 and 101 to 112
  EXPECT_TRUE(contains(written_notes(model, ".inp"), note));
  EXPECT_TRUE(contains(written(model, ".inp").bytes, "*ELEMENT, TYPE=T3D2\n113, 1, 25\n"));
  expect_same_system(model, there_and_back(model, ".inp"));
}

TEST(WrittenKnots, SpringsReachTurnsByEquations) {
  std::string springs;
  for (int k = 4; k <= 6; ++k)
    springs += fmt::format(
        "*ELEMENT, TYPE=SPRING2, ELSET=S{0}\n90{0}, 13, 113\n*SPRING, ELSET=S{0}\n{0}, "
        "{0}\n{0}00.\n",
        k);
  const FeModel model = KnottedFrames{.further = springs}.read();
  const std::string text = written(model, ".inp").bytes;
  EXPECT_FALSE(contains(text, "\n4, 4\n"));
  EXPECT_TRUE(contains(text, ", 1, -1, 13, 4, 1\n"));
  expect_same_system(model, there_and_back(model, ".inp"));
}

/// Two bricks of 0.1 m, the upper nodes tied to node 12 in the directions of `mask`.
FeModel coupled_bricks(unsigned mask) {
  FeModel model;
  model.materials = {steel};
  for (int k = 0; k < 12; ++k)
    model.positions.push_back(0.1 * Vec3(k % 2, k / 2 % 2, static_cast<double>(k / 4)));
  for (const int a : {0, 4})
    add_element(model, FeElementType::hex8, {a, a + 1, a + 3, a + 2, a + 4, a + 5, a + 7, a + 6});
  model.positions.emplace_back(0.04, 0.06, 0.25);
  add_spider(model, 12, {8, 9, 10, 11}).mask = mask;
  return model;
}

TEST(WrittenKnots, CouplingsOfSomeDirections) {
  // In x and y of nodes in one plane: rx is uy there, ry is ux.
  const FeModel model = coupled_bricks(0b011);
  const std::string text = written(model, ".inp").bytes;
  EXPECT_TRUE(contains(text, "*BOUNDARY\n14, 1, 1\n14, 2, 2\n"));
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "2 directions are held of nodes without elements: what shows that motion"));
  // Three directions show all six motions; a mass makes them count.
  EXPECT_FALSE(contains(written(coupled_bricks(0b111), ".inp").bytes, "*BOUNDARY"));
  FeModel weighted = model;
  weighted.masses = {{12, 1.0, Mat3::Zero()}};
  EXPECT_FALSE(contains(written(weighted, ".inp").bytes, "*BOUNDARY"));
  // A spring along y at the reference tells rx from uy there, but not ry from ux.
  FeModel sprung = model;
  Spring s;
  s.nodes = {12, 0};
  s.directions[0] = -Vec6::Unit(1);
  s.directions[1] = Vec6::Unit(1);
  s.stiffness = 10.0;
  sprung.springs.push_back(s);
  EXPECT_TRUE(contains(written(sprung, ".inp").bytes, "*BOUNDARY\n13, 3, 3\n14, 2, 2\n"));
}

TEST(WrittenKnots, EquationsThatHoldThePartAreNoted) {
  FeModel model = coupled_bricks(0b111);
  LinearEquation nothing, held;
  nothing.terms = {{0, 0, 1.0}, {0, 0, -1.0}};
  held.terms = {{0, 1, 2.0}};
  model.equations = {nothing};
  EXPECT_EQ(written(model, ".inp").bytes, written(coupled_bricks(0b111), ".inp").bytes);
  model.equations = {nothing, held};
  EXPECT_TRUE(contains(written(model, ".inp").bytes, "*BOUNDARY\n1, 2, 2\n"));
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "1 direction is held by equations of the model, written as *BOUNDARY: the "
                       "part is not free; first: node 0 uy\n"));
}

// CalculiX 2.20 takes five vectors a mode and prints zeros if it has fewer degrees of freedom.
TEST(WrittenKnots, NoMoreModesThanCalculixFinds) {
  const FeModel model = coupled_bricks(0b111);
  EXPECT_TRUE(contains(written(model, ".inp", 20).bytes, "*FREQUENCY\n6\n"));
  EXPECT_TRUE(contains(written(model, ".inp", 4).bytes, "*FREQUENCY\n4\n"));
  const std::vector<std::string> notes = written(model, ".inp", 20).notes;
  EXPECT_EQ(notes.back(),
            "the step requests 6 modes, a fifth of the 30 degrees of freedom of the deck: if more "
            "are requested "
            "than exist, CalculiX prints zeros");
}

}  // namespace
}  // namespace floatframe::test

// Small inputs that would take unbounded time or memory: each ends with an error. What is bounded
// is the work, so the tests assert counts, not seconds; most of them did not end before.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "decks/ansys_deck.hpp"
#include "decks/deck_text.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

std::size_t lines_of(const std::string& text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Thirty files, each of which includes the next one ten times.
std::string include_errors(const TemporaryFolder& folder, const std::string& include,
                           const std::string& ending, const std::string& format) {
  for (int k = 0; k < 30; ++k) {
    std::string text;
    for (int i = 0; k < 29 && i < 10; ++i)
      text += fmt::format(fmt::runtime(include), fmt::format("f{}{}", k + 1, ending)) + '\n';
    folder.write(fmt::format("f{}{}", k, ending), text);
  }
  return error_of([&] { read_fe_file(folder / ("f0" + ending), {}, format); });
}

TEST(DeckLimits, IncludesThatMultiply) {
  const TemporaryFolder folder;
  const std::string abaqus = include_errors(folder, "*INCLUDE, INPUT={}", ".inp", "abaqus");
  EXPECT_TRUE(abaqus.ends_with(": too_large")) << abaqus;
  EXPECT_TRUE(contains(abaqus, ".inp:"));
  const std::string nastran = include_errors(folder, "INCLUDE '{}'", ".bdf", "nastran");
  EXPECT_TRUE(nastran.ends_with(": too_large")) << nastran;
}

TEST(DeckLimits, LongKeywordLines) {
  EXPECT_EQ(inp_error("*NODE\n1\n*" + std::string(20'000'000, 'A') + "\n1\n"),
            "deck.inp:3: too_large");
  std::string parameters = "*NODE";
  for (int k = 0; k < 90; ++k) parameters += ",\n" + std::string(1000, 'B') + "=1";
  EXPECT_EQ(inp_error("** many lines\n" + parameters + "\n1\n"), "deck.inp:2: too_large");
}

TEST(DeckLimits, UnknownKeywordsAreNamedOnce) {
  std::string text = "*NODE\n1\n";
  for (int k = 0; k < 200'000; ++k) text += "*SPECIAL LAYER, NAME=X\n";
  EXPECT_EQ(lines_of(inp_error(text)), 1u);
  std::string different = "*NODE\n1\n";
  for (int k = 0; k < 1000; ++k) different += fmt::format("*SPECIAL LAYER {}\n", k);
  const std::string errors = inp_error(different);
  EXPECT_EQ(lines_of(errors), TextSource::most_errors + 1);
  EXPECT_EQ(errors,
            "deck.inp:3: unknown_key\ndeck.inp:4: unknown_key\ndeck.inp:5: "
            "unknown_key\ndeck.inp:6: unknown_key\ndeck.inp:7: unknown_key\ndeck.inp:8: "
            "unknown_key\ndeck.inp:9: unknown_key\ndeck.inp:10: unknown_key\ndeck.inp:11: "
            "unknown_key\ndeck.inp:12: unknown_key\ndeck.inp:13: unknown_key\ndeck.inp:14: "
            "unknown_key\ndeck.inp:15: unknown_key\ndeck.inp:16: unknown_key\ndeck.inp:17: "
            "unknown_key\ndeck.inp:18: unknown_key\ndeck.inp:19: unknown_key\ndeck.inp:20: "
            "unknown_key\ndeck.inp:21: unknown_key\ndeck.inp:22: unknown_key\ndeck.inp:23: "
            "unknown_key\ndeck.inp:24: unknown_key\ndeck.inp:25: unknown_key\ndeck.inp:26: "
            "unknown_key\ndeck.inp:27: unknown_key\ndeck.inp:28: unknown_key\ndeck.inp:29: "
            "unknown_key\ndeck.inp:30: unknown_key\ndeck.inp:31: unknown_key\ndeck.inp:32: "
            "unknown_key\ndeck.inp:33: unknown_key\ndeck.inp:34: unknown_key\ndeck.inp:35: "
            "unknown_key\ndeck.inp:36: unknown_key\ndeck.inp:37: unknown_key\ndeck.inp:38: "
            "unknown_key\ndeck.inp:39: unknown_key\ndeck.inp:40: unknown_key\ndeck.inp:41: "
            "unknown_key\ndeck.inp:42: unknown_key\ndeck.inp:43: unknown_key\ndeck.inp:44: "
            "unknown_key\ndeck.inp:45: unknown_key\ndeck.inp:46: unknown_key\ndeck.inp:47: "
            "unknown_key\ndeck.inp:48: unknown_key\ndeck.inp:49: unknown_key\ndeck.inp:50: "
            "unknown_key\ndeck.inp:51: unknown_key\ndeck.inp:52: unknown_key\ntoo_large (0)")
      << errors;
  std::string cards;
  for (int k = 0; k < 100'000; ++k) cards += fmt::format("X{},1\n", k);
  EXPECT_EQ(lines_of(bdf_error(cards)), TextSource::most_errors + 1);
}

/// `count` nodes.
std::string nodes(int count) {
  std::string text = "*NODE, NSET=ALL\n";
  for (int k = 1; k <= count; ++k) text += fmt::format("{}, {}.\n", k, k);
  return text;
}

TEST(DeckLimits, SetsThatDouble) {
  // Each set names the one before it twice: the members are found once.
  std::string text = nodes(2) + "*NSET, NSET=S0\n1, 2\n";
  for (int k = 1; k < 150; ++k) text += fmt::format("*NSET, NSET=S{}\nS{}, S{}\n", k, k - 1, k - 1);
  EXPECT_EQ(inp_error(text), "deck.inp: missing");
}

TEST(DeckLimits, SetsOfAllNodesAgainAndAgain) {
  const std::string begin = nodes(1000);
  std::string sets, supports, ranges;
  for (int k = 0; k < 20'000; ++k) {
    sets += fmt::format("*NSET, NSET=S{}\nALL\n", k);
    supports += "ALL, 1, 3\n";
    ranges += "1, 2000000000, 1\n";
  }
  const std::string end = ": too_large";
  const auto ends = [&](const std::string& text) {
    const std::string errors = inp_error(text);
    return errors.ends_with(end) ? end : errors;
  };
  const std::string body =
      "*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n1.\n*DENSITY\n1.\n"
      "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n1., 1.\n";
  EXPECT_EQ(ends(begin + body + sets), end);
  EXPECT_EQ(ends(begin + body + "*BOUNDARY\n" + supports), end);
  EXPECT_EQ(ends(begin + body + "*NSET, NSET=R, GENERATE\n" + ranges), end);
  std::string terms = "*EQUATION\n15000\n";
  for (int k = 0; k < 15'000; ++k) terms += "ALL, 1, 1.\n";
  EXPECT_EQ(ends(begin + body + terms), end);
}

/// E takes the number above all others: looking for it each time would take hours here.
TEST(DeckLimits, AnsysElementsWithoutNumbersAndEdgesWithoutNodes) {
  std::string deck =
      "ET,1,180\nET,2,187\nMP,EX,1,1\nMP,PRXY,1,.3\nMP,DENS,1,1\nR,1,2\nN,1,0\nN,2,1\n";
  constexpr int count = 200'000;
  for (int k = 0; k < count; ++k) deck += "E,1,2\n";
  deck += "TYPE,2\n";
  constexpr int tetrahedra = 8'000;
  for (int k = 0; k < tetrahedra; ++k) {
    const int n = 5 * k + 3;
    deck += fmt::format("N,{},{}\nN,{},{}\nN,{},{},1\nN,{},{},,1\nN,{},{}\n", n, 2 * k, n + 1,
                        2 * k + 1, n + 2, 2 * k, n + 3, 2 * k, n + 4, 2 * k + 0.5);
    deck += fmt::format("EN,{},{},{},{},{},{}\n", count + 1 + k, n, n + 1, n + 2, n + 3, n + 4);
  }
  const FeModel model = ansys_of(deck);
  EXPECT_EQ(model.elements.size(), static_cast<std::size_t>(count + tetrahedra));
  EXPECT_EQ(model.nodes(), 2 + 10 * tetrahedra);
}

TEST(DeckLimits, RangesOfNastranAgainAndAgain) {
  std::string text;
  for (int k = 1; k <= 1000; ++k) text += fmt::format("GRID,{},,{}.,0.,0.\n", k, k);
  text += "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,1.,1.,1.,1.\nMAT1,1,1.,,.3,1.\n";
  std::string supports, sets;
  for (int k = 0; k < 20'000; ++k) {
    supports += "SPC1,1,123,1,THRU,2000000000\n";
    sets += "SET3,7,GRID,1,THRU,2000000000\n";
  }
  for (const std::string& more : {supports, sets}) {
    const std::string errors = bdf_error(text + more);
    EXPECT_TRUE(errors.ends_with(": too_large")) << errors;
  }
  // Masses with an offset get a node of their own each, and no number is above the largest.
  EXPECT_EQ(bdf_error("GRID,2147483647,,3.,0.,0.\n" + text + "CONM2,5,1,,1.,1.\n"),
            "arm.bdf:1005: incomplete");
}

TEST(DeckLimits, GroupsOfGmshAgainAndAgain) {
  constexpr int groups = 100'000, triangles = 60;
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 1\n1 0 0 0 1 1 1 ";
  text += std::to_string(groups);
  for (int k = 1; k <= groups; ++k) text += fmt::format(" {}", k);
  text += " 0\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n";
  text += "0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
  text += fmt::format("$Elements\n2 {} 1 {}\n3 1 4 1\n1 1 2 3 4\n2 1 2 {}\n", triangles + 1,
                      triangles + 1, triangles);
  for (int k = 0; k < triangles; ++k) text += fmt::format("{} 1 2 3\n", k + 2);
  text += "$EndElements\n";
  const std::string errors = error_of([&] { parse_gmsh(text, "mesh.msh", {}); });
  EXPECT_TRUE(errors.ends_with(": too_large")) << errors;
}

}  // namespace
}  // namespace floatframe::test

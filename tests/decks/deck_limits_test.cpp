// Small inputs that would take unbounded time or memory: each ends with a sentence. What is bounded
// is the work, so the tests assert counts, not seconds; most of them did not end before.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/decks/ansys/read_ansys.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

std::string abaqus_errors(const std::string& text) {
  return error_of([&] {
    TextSource source(text, "deck.inp");
    read_abaqus(source, {});
  });
}

std::string nastran_errors(const std::string& text) {
  return error_of([&] {
    TextSource source(text, "deck.bdf");
    read_nastran(source, has_begin_bulk(text), {});
  });
}

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
  const std::string sentence = ": the files include each other more than 10000 times";
  const std::string abaqus = include_errors(folder, "*INCLUDE, INPUT={}", ".inp", "abaqus");
  EXPECT_NE(abaqus.find(sentence), std::string::npos) << abaqus;
  EXPECT_NE(abaqus.find(".inp:"), std::string::npos) << abaqus;
  const std::string nastran = include_errors(folder, "INCLUDE '{}'", ".bdf", "nastran");
  EXPECT_NE(nastran.find(sentence), std::string::npos) << nastran;
}

TEST(DeckLimits, LongKeywordLines) {
  EXPECT_EQ(abaqus_errors("*NODE\n1\n*" + std::string(20'000'000, 'A') + "\n1\n"),
            "deck.inp:3: the keyword line '*AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA...' has more "
            "than 65536 characters");
  std::string parameters = "*NODE";
  for (int k = 0; k < 90; ++k) parameters += ",\n" + std::string(1000, 'B') + "=1";
  EXPECT_EQ(abaqus_errors("** many lines\n" + parameters + "\n1\n"),
            "deck.inp:2: the keyword line '*NODE,' has more than 65536 characters");
}

TEST(DeckLimits, UnknownKeywordsAreNamedOnce) {
  std::string text = "*NODE\n1\n";
  for (int k = 0; k < 200'000; ++k) text += "*SPECIAL LAYER, NAME=X\n";
  EXPECT_EQ(lines_of(abaqus_errors(text)), 1u);
  std::string different = "*NODE\n1\n";
  for (int k = 0; k < 1000; ++k) different += fmt::format("*SPECIAL LAYER {}\n", k);
  const std::string errors = abaqus_errors(different);
  EXPECT_EQ(lines_of(errors), TextSource::most_errors + 1);
  EXPECT_NE(errors.find("\nreading ends after 50 errors"), std::string::npos);
  std::string cards;
  for (int k = 0; k < 100'000; ++k) cards += fmt::format("X{},1\n", k);
  EXPECT_EQ(lines_of(nastran_errors(cards)), TextSource::most_errors + 1);
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
  EXPECT_EQ(abaqus_errors(text), "deck.inp: the deck has no element with stiffness");
}

TEST(DeckLimits, SetsOfAllNodesAgainAndAgain) {
  const std::string begin = nodes(1000);
  std::string sets, supports, ranges;
  for (int k = 0; k < 20'000; ++k) {
    sets += fmt::format("*NSET, NSET=S{}\nALL\n", k);
    supports += "ALL, 1, 3\n";
    ranges += "1, 2000000000, 1\n";
  }
  const std::string end =
      "the sets of nodes, and what names them, have more than 10100000 members in all, too many "
      "for a deck of 1000 nodes";
  const auto ends = [&](const std::string& text) {
    const std::string errors = abaqus_errors(text);
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
  TextSource source(deck, "a.cdb");
  const FeModel model = read_ansys(source, {});
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
  const std::string end =
      "the sets and supports have more than 10100100 members in all, too many for a file of 1000 "
      "nodes and 1 elements";
  for (const std::string& more : {supports, sets}) {
    const std::string errors = nastran_errors(text + more);
    EXPECT_TRUE(errors.ends_with(end)) << errors;
  }
  // Masses with an offset get a node of their own each, and no number is above the largest.
  EXPECT_EQ(nastran_errors("GRID,2147483647,,3.,0.,0.\n" + text + "CONM2,5,1,,1.,1.\n"),
            "deck.bdf:1005: CONM2 5 needs a node of its own, but there is no number above "
            "2147483647");
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
  EXPECT_NE(errors.find("the physical groups have more than 10006500 members in all, too many for "
                        "a mesh of 4 nodes and 61 elements"),
            std::string::npos)
      << errors;
}

}  // namespace
}  // namespace floatframe::test

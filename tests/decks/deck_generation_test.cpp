// Nodes and elements that a deck has generated, against the same deck written out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "decks/deck_text.hpp"
#include "formats/mesh_checks.hpp"

namespace floatframe::test {
namespace {

/// 4 x 3 x 2 bricks of 1 x 2 x 3: node 1 + i + 10 j + 100 k.
std::string written_out() {
  std::string text = "*NODE\n";
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i)
        text += fmt::format("{}, {}, {}, {}\n", 1 + i + 10 * j + 100 * k, i, 2 * j, 3 * k);
  text += "*ELEMENT, TYPE=C3D8, ELSET=ALL\n";
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        const int n = 1 + i + 10 * j + 100 * k;
        text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", 1 + i + 10 * j + 100 * k, n,
                            n + 1, n + 11, n + 10, n + 100, n + 101, n + 111, n + 110);
      }
  return text;
}

constexpr const char* corners_of_a_block =
    "*NODE\n1, 0, 0, 0\n5, 4, 0, 0\n31, 0, 6, 0\n35, 4, 6, 0\n201, 0, 0, 6\n205, 4, 0, 6\n"
    "231, 0, 6, 6\n235, 4, 6, 6\n";

/// Whatever the order of nodes and elements.
void expect_equal_by_number(const FeModel& a, const FeModel& b) {
  ASSERT_EQ(a.nodes(), b.nodes());
  std::map<int, Vec3> place;
  for (int n = 0; n < a.nodes(); ++n) place[a.node_ids[n]] = a.positions[n];
  for (int n = 0; n < b.nodes(); ++n) {
    ASSERT_TRUE(place.contains(b.node_ids[n])) << b.node_ids[n];
    EXPECT_LT((place[b.node_ids[n]] - b.positions[n]).norm(), 1e-12) << b.node_ids[n];
  }
  ASSERT_EQ(a.elements.size(), b.elements.size());
  std::map<int, std::vector<int>> nodes;
  const auto of = [](const FeModel& m, const FeElement& e) {
    std::vector<int> out;
    for (int k = 0; k < 8; ++k) out.push_back(m.node_ids[e.nodes[k]]);
    return out;
  };
  for (const FeElement& e : a.elements) nodes[e.id] = of(a, e);
  for (const FeElement& e : b.elements) EXPECT_EQ(nodes[e.id], of(b, e)) << e.id;
}

TEST(DeckGeneration, LinesRowsAndLayers) {
  const FeModel model = read_inp(
      std::string(corners_of_a_block) +
      "*NGEN, NSET=A0\n1, 5\n*NGEN, NSET=A1\n31, 35, 1\n*NGEN, NSET=B0\n201, 205\n*NGEN, NSET=B1\n"
      "231, 235\n*NFILL, NSET=LOW\nA0, A1, 3, 10\n*NFILL, NSET=UP\nB0, B1, 3, 10\n"
      "*NFILL, NSET=NALL\nLOW, UP, 2, 100\n*ELEMENT, TYPE=C3D8\n1, 1, 2, 12, 11, 101, 102, 112, "
      "111\n"
      "*ELGEN, ELSET=ALL\n1, 4, 1, 1, 3, 10, 10, 2, 100, 100\n");
  expect_equal_by_number(read_inp(written_out()), model);
  EXPECT_EQ(model.element_sets.at("ALL").size(), 24u);
  EXPECT_EQ(model.node_sets.at("A0").size(), 5u);
  EXPECT_EQ(model.node_sets.at("LOW").size(), 20u);
  EXPECT_EQ(model.node_sets.at("NALL").size(), 60u);
}

TEST(DeckGeneration, Copies) {
  const FeModel model = read_inp(
      std::string(corners_of_a_block) +
      "*NGEN, NSET=A0\n1, 5\n*NCOPY, OLD SET=A0, NEW SET=ROWS, CHANGE NUMBER=10, SHIFT, "
      "MULTIPLE=3\n"
      "0, 2, 0\n\n*NSET, NSET=LOW\nA0, ROWS\n*NCOPY, OLD SET=LOW, CHANGE NUMBER=100, SHIFT\n0, 0, "
      "3\n\n"
      "*NCOPY, OLD SET=LOW, CHANGE NUMBER=200, SHIFT\n0, 0, 6\n\n"
      "*ELEMENT, TYPE=C3D8\n1, 1, 2, 12, 11, 101, 102, 112, 111\n*ELGEN, ELSET=FLAT\n"
      "1, 4, 1, 1, 3, 10, 10\n*ELCOPY, OLD SET=FLAT, ELEMENT SHIFT=100, SHIFT NODES=100\n");
  expect_equal_by_number(read_inp(written_out()), model);
  EXPECT_EQ(model.element_sets.at("FLAT").size(), 12u);
}

TEST(DeckGeneration, ArcsAndTurnedCopies) {
  const FeModel model = read_inp(
      "*NODE\n1, 2, 0, 0\n7, 0, 2, 0\n9, 0, 0, 0\n*NGEN, LINE=C, NSET=ARC\n1, 7, 2, 9\n"
      "*NSET, NSET=ENDS\n1\n*NCOPY, OLD SET=ENDS, CHANGE NUMBER=20, SHIFT, MULTIPLE=2\n1, 0, 0\n"
      "0, 0, 0, 0, 0, 1, 90\n*NODE\n102, 0, 0, 1\n"
      "*ELEMENT, TYPE=C3D4\n1, 1, 7, 9, 102\n");
  const auto at = [&](int id) {
    for (int n = 0; n < model.nodes(); ++n)
      if (model.node_ids[n] == id) return model.positions[n];
    return Vec3(1e9, 0, 0);
  };
  for (int k = 0; k < 4; ++k) {
    const double t = k * std::acos(0.0) / 3.0;
    EXPECT_LT((at(1 + 2 * k) - Vec3(2 * std::cos(t), 2 * std::sin(t), 0)).norm(), 1e-14);
  }
  // Shift, then rotation, and again of the copy: (2, 0) -> (3, 0) -> (0, 3) -> (1, 3) -> (-3, 1).
  EXPECT_LT((at(21) - Vec3(0, 3, 0)).norm(), 1e-14);
  EXPECT_LT((at(41) - Vec3(-3, 1, 0)).norm(), 1e-14);
}

TEST(DeckGeneration, Errors) {
  const std::string n = "*NODE\n1, 0, 0, 0\n5, 4, 0, 0\n7, 0, 1, 0\n";
  EXPECT_EQ(inp_error(n + "*NGEN\n1, 6\n"), "deck.inp:6: not_found");
  EXPECT_EQ(inp_error(n + "*NGEN\n1, 5, 3\n"), "deck.inp:6: contradiction");
  EXPECT_EQ(inp_error(n + "*NGEN\n5, 1\n"), "deck.inp:6: contradiction");
  EXPECT_EQ(inp_error(n + "*NGEN\n1\n"), "deck.inp:6: incomplete");
  EXPECT_EQ(inp_error(n + "*NGEN, LINE=P\n1, 5\n"), "deck.inp:5: wrong_count");
  EXPECT_EQ(inp_error(n + "*NGEN, LINE=C\n1, 5, 1, 7\n"), "deck.inp:6: geometry");
  EXPECT_EQ(inp_error(n + "*NGEN, LINE=C\n1, 5, 1, , 2, 0, 0\n"), "deck.inp:6: unsupported");
  EXPECT_EQ(inp_error(n + "*NODE\n3, 9, 9, 9\n*NGEN\n1, 5\n"), "deck.inp:8: duplicate");
  EXPECT_EQ(inp_error(n + "*NFILL\nA, B, 2, 10\n"), "deck.inp:6: missing\ndeck.inp:6: missing");
  EXPECT_EQ(inp_error(n + "*NSET, NSET=A\n1, 5\n*NFILL\nA, 7, 2, 10\n"),
            "deck.inp:8: contradiction");
  EXPECT_EQ(inp_error(n + "*NFILL\n1, 7, 0, 10\n"), "deck.inp:6: out_of_range");
  EXPECT_EQ(inp_error(n + "*NCOPY, OLD SET=A, CHANGE NUMBER=10, REFLECT=LINE\n1\n"),
            "deck.inp:5: unsupported");
  const std::string e = n + "8, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n1, 1, 5, 7, 8\n";
  EXPECT_EQ(inp_error(e + "*ELGEN\n2, 3, 1, 1\n"), "deck.inp:9: not_found");
  EXPECT_EQ(inp_error(e + "*ELGEN\n1, 0, 1, 1\n"), "deck.inp:9: out_of_range");
  EXPECT_EQ(inp_error(e + "*ELGEN\n1, 2000, 0, 1, 3000\n"), "deck.inp:9: too_large");
  std::string nested = n + "*NSET, NSET=S0\n1, 1, 1\n";
  for (int k = 1; k < 40; ++k)
    nested += fmt::format("*NSET, NSET=S{}\nS{}, S{}\n", k, k - 1, k - 1);
  EXPECT_EQ(inp_error(nested + "*NFILL\nS39, S39, 2, 1\n"), "deck.inp:86: too_large");
  EXPECT_EQ(inp_error(e + "*ELGEN\n1, 2, 0, 0\n"), "deck.inp:9: duplicate");
  EXPECT_EQ(inp_error(e + "*ELGEN\n1, 2, 0, -5\n"), "deck.inp:9: out_of_range");
  EXPECT_EQ(inp_error(e + "*ELGEN\n1, 2, 1, 1\n"), "deck.inp:9: not_found");
}

TEST(DeckGeneration, ElementsWithTemperatures) {
  const FeModel model = read_inp(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4T, ELSET=E\n1, 1, "
      "2, "
      "3, 4\n");
  ASSERT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.elements[0].type, FeElementType::tet4);
  EXPECT_TRUE(contains(model.notes, "C3D4T are read without their temperatures"));
}

}  // namespace
}  // namespace floatframe::test

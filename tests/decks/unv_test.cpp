// Universal files: the same mesh as from Gmsh, in both forms of nodes and elements; groups; invalid
// files with code and place of their errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/decks/unv/read_unv.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "formats/mesh_checks.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

FeModel unv_of(const std::string& text, const FeReadOptions& options = {}) {
  TextSource source(text, "a.unv");
  return read_unv(source, options);
}

std::string unv_dataset(int number, const std::string& content) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, content);
}

/// Corners and middles of edges in the order in which the format goes round an element.
std::vector<int> unv_walk(FeElementType type) {
  switch (type) {
    case FeElementType::hex20:
      return {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15};
    case FeElementType::wedge15:
      return {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11};
    case FeElementType::tet10:
      return {0, 4, 1, 5, 2, 6, 7, 8, 9, 3};
    default:
      return {};
  }
}

/// Layout of 2411, 2412 and 2467, or of the older 781 and 780.
std::string unv_text(const FeModel& m, bool old) {
  std::string nodes, elements, groups;
  for (int i = 0; i < m.nodes(); ++i) {
    const Vec3& p = m.positions[i];
    nodes += fmt::format("{:10}{:10}{:10}{:10}\n", m.node_ids[i], 1, 1, 11);
    std::string line = fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", p.x(), p.y(), p.z());
    std::replace(line.begin(), line.end(), 'E', 'D');
    nodes += line;
  }
  for (const FeElement& e : m.elements) {
    const std::vector<int> walk = unv_walk(e.type);
    const int type = e.type == FeElementType::hex20   ? 116
                     : e.type == FeElementType::tet10 ? 118
                                                      : 113;
    elements +=
        old ? fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}{:10}{:10}", e.id, type, 1, 2, 1, 7, 7,
                          walk.size())
            : fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}", e.id, type, 2, 1, 7, walk.size());
    for (std::size_t k = 0; k < walk.size(); ++k)
      elements += fmt::format("{}{:10}", k % 8 == 0 ? "\n" : "", m.node_ids[e.nodes[walk[k]]]);
    elements += '\n';
  }
  int number = 0;
  const auto group = [&](const std::string& name, int kind, const std::vector<int>& labels) {
    groups += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}{:10}{:10}\n{}\n", ++number, 0, 0, 0, 0, 0,
                          0, labels.size(), name);
    for (std::size_t k = 0; k < labels.size(); ++k)
      groups += fmt::format("{:10}{:10}{:10}{:10}{}", kind, labels[k], 0, 0,
                            k % 2 == 1 || k + 1 == labels.size() ? "\n" : "");
  };
  for (const auto& [name, set] : m.node_sets) {
    std::vector<int> labels;
    for (const int node : set) labels.push_back(m.node_ids[node]);
    group(name, 7, labels);
  }
  for (const auto& [name, set] : m.element_sets) {
    std::vector<int> labels;
    for (const int e : set) labels.push_back(m.elements[e].id);
    group(name, 8, labels);
  }
  return unv_dataset(old ? 781 : 2411, nodes) + unv_dataset(old ? 780 : 2412, elements) +
         unv_dataset(2467, groups);
}

TEST(Unv, SameMeshAsFromGmsh) {
  for (const char* name : {"bricks.msh", "aarm_coarse.msh.gz"}) {
    SCOPED_TRACE(name);
    FeReadOptions options;
    options.material = Material{2.1e5, 0.3, 7.85e-9};
    const FeModel from_gmsh = read_gmsh(std::string(FLOATFRAME_TEST_DATA) + "/fe/" + name, options);
    for (const bool old : {false, true}) {
      const std::string text = unv_text(from_gmsh, old);
      EXPECT_TRUE(looks_like_unv(text));
      const FeModel m = unv_of(text, options);
      expect_same_mesh(from_gmsh, m, 1e-12);
      expect_midside_nodes_near_edges(m);
      EXPECT_EQ(m.element_sets, from_gmsh.element_sets);
      ASSERT_EQ(m.node_sets.size(), from_gmsh.node_sets.size());
      for (const auto& [set, nodes] : from_gmsh.node_sets)
        EXPECT_EQ(as_set(nodes), as_set(m.node_sets.at(set))) << set;
      EXPECT_TRUE(m.notes.empty());
      const SparseMatrix K = assemble_stiffness(from_gmsh);
      EXPECT_LE((assemble_stiffness(m) - K).norm(), 1e-12 * K.norm());
    }
  }
}

const std::string unv_four_nodes =
    unv_dataset(2411, "1 1 1 11\n0 0 0\n2 1 1 11\n1.D+0 0 0\n3 1 1 11\n0 1 0\n4 1 1 11\n0 0 1\n");
const std::string unv_tetrahedron = unv_dataset(2412, "1 111 2 1 7 4\n1 2 3 4\n");

TEST(Unv, SkinsAndEdgesMakeNodeSets) {
  const FeModel m = unv_of(
      unv_dataset(151, "anything\n") + unv_dataset(164, "1 SI: Meter (newton)  2\n1. 1. 1.\n0.\n") +
      unv_dataset(15,
                  "1 0 0 11 0. 0. 0.\n2 0 0 11 1. 0. 0.\n3 0 0 11 0. 1. 0.\n"
                  "4 0 0 11 0. 0. 1.\n") +
      unv_dataset(2412,
                  "1 111 2 1 7 4\n1 2 3 4\n2 91 2 1 7 3\n1 2 3\n3 21 2 1 7 2\n0 1 1\n1 4\n"
                  "4 111 2 8 7 4\n1 3 2 4\n") +
      unv_dataset(2477,
                  "1 0 0 0 0 0 0 3\nSKIN\n8 2 0 0 8 1 0 0\n7 4 0 0\n"
                  "2 0 0 0 0 0 0 2\nEDGE\n8 3 0 0 5 9 0 0\n") +
      unv_dataset(2414, "1\nresults\n"));
  EXPECT_EQ(m.elements.size(), 2u);
  EXPECT_EQ(m.node_sets.at("SKIN"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(m.element_sets.at("SKIN"), std::vector<int>{0});
  EXPECT_EQ(m.node_sets.at("EDGE"), (std::vector<int>{0, 3}));
  ASSERT_EQ(m.notes.size(), 5u);
  EXPECT_EQ(m.notes[0],
            "a.unv:7: the file declares units '1 SI: Meter (newton)  2'; the units given "
            "with the file are used");
  EXPECT_EQ(m.notes[1],
            "a.unv: 1 members of groups are neither nodes nor elements (kind 5) and are left out");
  EXPECT_EQ(m.notes[3],
            "a.unv: 2 shells, beams and rods are taken as skins and edges: they make "
            "node sets and have no stiffness and no mass");
  EXPECT_EQ(m.notes[4], "a.unv: dataset 2414 is ignored");
}

TEST(Unv, RigidElementsAndDampers) {
  const FeModel m = unv_of(
      unv_four_nodes +
      unv_dataset(2411, "5 1 1 11\n2 0 0\n6 1 1 11\n3 0 0\n7 1 1 11\n4 0 0\n8 1 1 11\n5 0 0\n") +
      unv_dataset(2412,
                  "1 111 2 1 7 4\n1 2 3 4\n2 122 2 1 7 3\n5 2 3\n3 121 2 1 7 2\n6 4\n"
                  "4 141 2 1 7 2\n1 2\n5 121 2 1 7 2\n7 8\n6 121 2 1 7 2\n6 5\n") +
      unv_dataset(2467, "1 0 0 0 0 0 0 1\nRIGID\n8 2 0 0\n"));
  ASSERT_EQ(m.spiders.size(), 2u);
  EXPECT_EQ(m.spiders[0].name, "rigid element 2");
  EXPECT_EQ(m.spiders[0].kind, Spider::Kind::rigid);
  EXPECT_EQ(m.spiders[0].mask, 63u);
  EXPECT_EQ(m.spiders[0].reference, 4);
  EXPECT_EQ(m.spiders[0].nodes, (std::vector<int>{1, 2, 5, 3}));
  EXPECT_EQ(m.spiders[1].reference, 6);
  EXPECT_EQ(m.spiders[1].nodes, std::vector<int>{7});
  EXPECT_EQ(m.node_sets.at("RIGID"), (std::vector<int>{1, 2, 4}));
  ASSERT_EQ(m.notes.size(), 2u);
  EXPECT_EQ(m.notes[1], "a.unv: 1 dampers are ignored: the part has modal damping");
}

TEST(Unv, FilledColumnsAreDivided) {
  const std::string text =
      unv_dataset(2411,
                  "1000000001 0 0 1\n0 0 0\n1000000002 0 0 1\n1 0 0\n1000000003 0 0 1\n"
                  "0 1 0\n1000000004 0 0 1\n0 0 1\n") +
      unv_dataset(2412, "1 111 2 1 7 4\n1000000001100000000210000000031000000004\n");
  EXPECT_EQ(unv_of(text).elements.at(0).nodes[3], 3);
}

TEST(Unv, FaultyFiles) {
  struct Case {
    std::string text, message;
  };
  const std::string& n = unv_four_nodes;
  const std::string& t = unv_tetrahedron;
  const auto elements = [&](const std::string& lines) { return n + unv_dataset(2412, lines); };
  const auto system = [](const char* kind, const char* origin) {
    return unv_dataset(
        2420, fmt::format("1\nPart\n1 {} 8\nCS1\n1 0 0\n0 1 0\n0 0 1\n{}\n", kind, origin));
  };
  const Case cases[] = {
      {"hello\n", "a.unv:1: wrong_value"},
      {"    -1\n", "a.unv:1: damaged"},
      {"    -1\nx\n", "a.unv:2: not_a_number"},
      {unv_dataset(4711, ""), "a.unv:2: unknown_key"},
      {"    -1\n  2411\n", "a.unv:2: damaged"},
      {unv_dataset(2411, "1 0 0 1\n"), "a.unv:4: damaged"},
      {unv_dataset(2411, "1 0 0\n"), "a.unv:3: wrong_count"},
      {unv_dataset(2411, "1.5 0 0 1\n"), "a.unv:3: not_a_number"},
      {unv_dataset(2411, "0 0 0 1\n0 0 0\n"), "a.unv:3: out_of_range"},
      {unv_dataset(2411, "1 0 0 1\n0 0\n"), "a.unv:4: wrong_count"},
      {unv_dataset(2411, "1 0 0 1\n0 0 a\n"), "a.unv:4: not_a_number"},
      {n + unv_dataset(2411, "1 0 0 1\n0 0 0\n") + t, "a.unv:14: duplicate"},
      {n, "a.unv: missing"},
      {elements("1 91 2 1 7 3\n1 2 3\n"), "a.unv: missing"},
      {elements("1 161 2 1 7 1\n1\n"), "a.unv:14: unsupported"},
      {elements("1 136 2 1 7 2\n1 2\n"), "a.unv:14: unsupported"},
      {elements("1 151 2 1 7 2\n1 2\n"), "a.unv:14: unsupported"},
      {elements("1 121 2 1 7 3\n1 2 3\n"), "a.unv:14: wrong_count"},
      {elements("1 122 2 1 7 0\n1 2 3\n"), "a.unv:14: wrong_count"},
      {elements("1 24 2 1 7 21\n"), "a.unv:14: wrong_count"},
      {elements("1 122 2 1 7 1\n1\n"), "a.unv:14: wrong_count"},
      {elements("1 122 2 1 7 3\n1 2 2\n"), "a.unv:14: duplicate"},
      {elements("1 122 2 1 7 3\n1 2 9\n"), "a.unv:14: not_found"},
      {elements("1 111 2 1 7 5\n1 2 3 4 5\n"), "a.unv:14: wrong_count"},
      {elements("1 111 2 1 7 4\n1 2 3 4 5\n"), "a.unv:15: wrong_count"},
      {elements("0 111 2 1 7 4\n1 2 3 4\n"), "a.unv:14: out_of_range"},
      {elements("1 111 2 1 7 4\n1 2 3 9\n"), "a.unv:14: not_found"},
      {elements("1 111 2 1 7 4\n1 2 3 3\n"), "a.unv:14: duplicate"},
      {n + t + t, "a.unv:19: duplicate"},
      {n + t + unv_dataset(2467, "1 0 0 0 0 0 0 1\nA\n7 9 0 0\n"), "a.unv:19: not_found"},
      {n + t + unv_dataset(2467, "1 0 0 0 0 0 0 1\nA\n8 9 0 0\n"), "a.unv:19: not_found"},
      {n + t + unv_dataset(2467, "1 0 0 0 0 0 0 1\nA\n7 1 0 0 7 2 0 0\n"), "a.unv:21: wrong_count"},
      {n + t + unv_dataset(2467, "1 0 0 0 0 0 0 -1\nA\n"), "a.unv:19: out_of_range"},
      {n + t + unv_dataset(2467, "1 0 0 0 0 0 0 1\n"), "a.unv:20: damaged"},
      {n + t + system("1", "0 0 0"), "a.unv:3: unsupported"},
      {n + t + system("0", "0 0 2"), "a.unv:3: unsupported"},
      {unv_dataset(2411, "1 7 0 1\n0 0 0\n2 0 0 1\n1 0 0\n3 0 0 1\n0 1 0\n4 0 0 1\n0 0 1\n") + t,
       "a.unv:3: unsupported"},
  };
  for (const Case& c : cases) EXPECT_EQ(error_of([&] { unv_of(c.text); }), c.message) << c.text;
  EXPECT_EQ(unv_of(n + t).elements.size(), 1u);
}

}  // namespace
}  // namespace floatframe::test

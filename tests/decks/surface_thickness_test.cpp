// Shells of meshes without sections: a thickness for all surfaces or by the names of their groups;
// the same matrices as of the model that was written; skins of solids; each error.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "floatframe/decks/unv/read_unv.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/formats/written/mesh_writers.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const Material sheet_steel{2.1e5, 0.3, 7.85e-9};

/// A bent strip: two quadrilaterals and two triangles, linear or quadratic, of two thicknesses.
FeModel strip(bool quadratic) {
  FeModel m;
  m.materials = {sheet_steel};
  m.material_names = {""};
  for (const double t : {2.0, 3.5}) {
    ShellSection s;
    s.thickness = t;
    s.shear = 5.0 / 6.0 * t;
    m.shells.push_back(s);
  }
  std::map<std::pair<int, int>, int> node_of;  // by twice its place in the grid
  const auto node = [&](int i, int j) {
    const auto [it, fresh] = node_of.try_emplace({i, j}, m.nodes());
    if (fresh) {
      m.positions.emplace_back(15.0 * i, 10.0 * j, 0.2 * i * i);
      m.node_ids.push_back(10 + m.nodes());
    }
    return it->second;
  };
  const auto add = [&](std::vector<std::pair<int, int>> corners, int section) {
    FeElement e;
    const std::size_t n = corners.size();
    e.type = n == 3 ? (quadratic ? FeElementType::tri6 : FeElementType::tri3)
                    : (quadratic ? FeElementType::quad8 : FeElementType::quad4);
    for (std::size_t k = 0; k < n; ++k) {
      const auto [i, j] = corners[k];
      const auto [p, q] = corners[(k + 1) % n];
      e.nodes[k] = node(i, j);
      if (quadratic) e.nodes[n + k] = node((i + p) / 2, (j + q) / 2);
    }
    e.section = section;
    e.id = static_cast<int>(m.elements.size()) + 1;
    m.element_sets[section == 0 ? "PLATE" : "RIB"].push_back(e.id - 1);
    m.elements.push_back(e);
  };
  add({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 0);
  add({{2, 0}, {4, 0}, {4, 2}, {2, 2}}, 1);
  add({{4, 0}, {6, 0}, {6, 2}}, 1);
  add({{4, 0}, {6, 2}, {4, 2}}, 0);
  return m;
}

/// Datasets 2411, 2412 and 2467; nodes of quadratic elements go round from corner to middle.
std::string unv_of_shells(const FeModel& m) {
  std::string text = "    -1\n  2411\n";
  for (int i = 0; i < m.nodes(); ++i)
    text += fmt::format("{} 1 1 11\n{:.17g} {:.17g} {:.17g}\n", m.node_ids[i], m.positions[i].x(),
                        m.positions[i].y(), m.positions[i].z());
  text += "    -1\n    -1\n  2412\n";
  for (const FeElement& e : m.elements) {
    const bool quadratic = e.type == FeElementType::tri6 || e.type == FeElementType::quad8;
    const bool triangle = e.type == FeElementType::tri6 || e.type == FeElementType::tri3;
    const int corners = triangle ? 3 : 4, type = (triangle ? 91 : 94) + (quadratic ? 1 : 0);
    text += fmt::format("{} {} 1 1 7 {}\n", e.id, type, quadratic ? 2 * corners : corners);
    for (int k = 0; k < corners; ++k) {
      text += fmt::format("{} ", m.node_ids[e.nodes[k]]);
      if (quadratic) text += fmt::format("{} ", m.node_ids[e.nodes[corners + k]]);
    }
    text += '\n';
  }
  text += "    -1\n    -1\n  2467\n";
  for (const auto& [name, set] : m.element_sets) {
    text += fmt::format("1 0 0 0 0 0 0 {}\n{}\n", set.size(), name);
    for (const int e : set) text += fmt::format("8 {} 0 0\n", m.elements[e].id);
  }
  return text + "    -1\n";
}

FeModel read_unv_text(const std::string& text, const FeReadOptions& options) {
  TextSource source(text, "a.unv");
  return read_unv(source, options);
}

FeReadOptions options_of(const std::map<std::string, double>& thicknesses) {
  FeReadOptions options;
  options.material = sheet_steel;
  options.thicknesses = thicknesses;
  return options;
}

void expect_same_matrices(const FeModel& a, const FeModel& b) {
  ASSERT_EQ(a.nodes(), b.nodes());
  std::map<int, int> at;  // node numbers of b
  for (int i = 0; i < b.nodes(); ++i) at[b.node_ids[i]] = i;
  std::vector<Eigen::Triplet<double>> turn;
  for (int i = 0; i < a.nodes(); ++i)
    for (int k = 0; k < 6; ++k) turn.emplace_back(6 * i + k, 6 * at.at(a.node_ids[i]) + k, 1.0);
  SparseMatrix P(6 * a.nodes(), 6 * a.nodes());
  P.setFromTriplets(turn.begin(), turn.end());
  const auto expect_equal = [&](const SparseMatrix& x, const SparseMatrix& y) {
    const SparseMatrix turned = P * y * SparseMatrix(P.transpose());
    EXPECT_GT(x.norm(), 0.0);
    EXPECT_LE((x - turned).norm(), 1e-12 * x.norm());
  };
  expect_equal(assemble_stiffness(a), assemble_stiffness(b));
  expect_equal(assemble_mass(a, true, 6), assemble_mass(b, true, 6));
}

std::set<int> numbers(const FeModel& m, const char* element_set) {
  std::set<int> out;
  for (const int e : m.element_sets.at(element_set)) out.insert(m.elements[e].id);
  return out;
}

TEST(SurfaceThickness, SameMatricesFromGmshAndUniversalFiles) {
  for (const bool quadratic : {false, true}) {
    SCOPED_TRACE(quadratic);
    const FeModel m = strip(quadratic);
    const std::string msh = gmsh_mesh_file(m, {}).bytes;
    // A group for one and the rest of another thickness, or all by name.
    for (const auto& given :
         {std::map<std::string, double>{{"PLATE", 2.0}, {"RIB", 3.5}}, {{"", 2.0}, {"RIB", 3.5}}}) {
      const FeModel gmsh = parse_gmsh(msh, "a.msh", options_of(given));
      const FeModel unv = read_unv_text(unv_of_shells(m), options_of(given));
      for (const FeModel* read : {&gmsh, &unv}) {
        validate(*read);
        expect_same_matrices(m, *read);
        for (const char* name : {"PLATE", "RIB"}) {
          EXPECT_EQ(numbers(*read, name), numbers(m, name));
          EXPECT_TRUE(read->node_sets.contains(name));
        }
      }
    }
  }
}

/// Format 2 writes an element once for each of its groups.
std::string gmsh2(const std::string& elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"ALL\"\n2 2 \"RIB\"\n"
         "2 3 \"LID\"\n$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 9 0 0\n3 9 9 0\n4 0 9 0\n"
         "5 18 0 0\n6 0 0 9\n$EndNodes\n$Elements\n" +
         elements + "$EndElements\n";
}

TEST(SurfaceThickness, NamedGroupsCountInFormat2) {
  for (const char* elements : {"3\n1 3 2 1 1 1 2 3 4\n2 3 2 2 1 1 2 3 4\n3 2 2 1 1 2 5 3\n",
                               "3\n1 3 2 2 1 1 2 3 4\n2 3 2 1 1 1 2 3 4\n3 2 2 1 1 2 5 3\n"}) {
    const FeModel m = parse_gmsh(gmsh2(elements), "a.msh", options_of({{"", 1.0}, {"RIB", 4.0}}));
    ASSERT_EQ(m.elements.size(), 2u);
    EXPECT_EQ(m.shells[m.elements[0].section].thickness, 4.0);
    EXPECT_EQ(m.shells[m.elements[1].section].thickness, 1.0);
    EXPECT_EQ(m.element_sets.at("ALL"), (std::vector<int>{0, 1}));
    EXPECT_EQ(m.element_sets.at("RIB"), std::vector<int>{0});
  }
}

// A group whose name the file has in Latin-1, however the user types it.
TEST(SurfaceThickness, NamesInLatin1) {
  std::string text = gmsh2("3\n1 3 2 1 1 1 2 3 4\n2 3 2 2 1 1 2 3 4\n3 2 2 1 1 2 5 3\n");
  const std::string latin = "R\xE9", utf8 = "R\xC3\xA9";
  text.replace(text.find("RIB"), 3, latin);
  for (const std::string& name : {latin, utf8}) {
    const FeModel m = parse_gmsh(text, "a.msh", options_of({{"", 1.0}, {name, 4.0}}));
    ASSERT_EQ(m.elements.size(), 2u);
    EXPECT_TRUE(m.shells[m.elements[0].section].thickness == 4.0 ||
                m.shells[m.elements[1].section].thickness == 4.0);
  }
}

TEST(SurfaceThickness, FacesOfSolidsStaySkinsUnlessNamed) {
  // A tetrahedron 1 2 4 6, a skin of it (LID) and a flange.
  const std::string text = gmsh2("3\n1 4 2 7 1 1 2 4 6\n2 2 2 3 1 2 1 4\n3 3 2 2 1 1 2 3 4\n");
  const FeModel all = parse_gmsh(text, "a.msh", options_of({{"", 1.0}}));
  ASSERT_EQ(all.elements.size(), 2u);
  EXPECT_EQ(all.elements[1].type, FeElementType::quad4);
  EXPECT_EQ(all.node_sets.at("LID").size(), 3u);
  EXPECT_EQ(all.element_sets.count("LID"), 0u);
  const auto has_skins = [](const FeModel& m) {
    return std::count(m.notes.begin(), m.notes.end(),
                      "a.msh: 1 surface elements in no group with a thickness are skins: they make "
                      "node sets and have no stiffness and no mass");
  };
  EXPECT_EQ(has_skins(all), 0);
  const FeModel coated = parse_gmsh(text, "a.msh", options_of({{"LID", 0.5}}));
  EXPECT_EQ(has_skins(coated), 1);
  ASSERT_EQ(coated.elements.size(), 2u);
  EXPECT_EQ(coated.elements[1].type, FeElementType::tri3);
  EXPECT_EQ(coated.shells[coated.elements[1].section].thickness, 0.5);
  // The same in a universal file: the skin and the flange after the solid.
  const std::string unv =
      "    -1\n  2411\n1 1 1 1\n0 0 0\n2 1 1 1\n9 0 0\n3 1 1 1\n9 9 0\n4 1 1 1\n0 9 0\n6 1 1 1\n0 "
      "0 "
      "9\n    -1\n    -1\n  2412\n1 111 1 1 7 4\n1 2 4 6\n2 91 1 1 7 3\n2 1 4\n3 94 1 1 7 4\n"
      "1 2 3 4\n    -1\n";
  const FeModel u = read_unv_text(unv, options_of({{"", 1.0}}));
  ASSERT_EQ(u.elements.size(), 2u);
  EXPECT_EQ(u.elements[1].type, FeElementType::quad4);
  EXPECT_EQ(u.notes.back(),
            "a.unv: 1 shells, beams and rods are taken as skins and edges: they make node sets and "
            "have no stiffness and no mass");
}

TEST(SurfaceThickness, Errors) {
  const std::string two = gmsh2("2\n1 3 2 2 1 1 2 3 4\n2 2 2 1 1 2 5 3\n");
  const auto gmsh = [](const std::string& text, const std::map<std::string, double>& given) {
    return error_of([&] { parse_gmsh(text, "a.msh", options_of(given)); });
  };
  EXPECT_EQ(gmsh(two, {{"RIBS", 1.0}}), "a.msh: not_found");
  EXPECT_EQ(gmsh(two, {{"LID", 1.0}}), "a.msh: not_found");
  EXPECT_EQ(gmsh(gmsh2("2\n1 3 2 2 1 1 2 3 4\n2 3 2 1 1 1 2 3 4\n"), {{"RIB", 1.0}, {"ALL", 2.0}}),
            "a.msh:22: contradiction");
  EXPECT_EQ(gmsh(gmsh2("1\n1 10 2 2 1 1 2 3 4 1 2 3 4 5\n"), {{"", 1.0}}), "a.msh:21: unsupported");
  EXPECT_EQ(gmsh(gmsh2("2\n1 3 2 2 1 1 2 3 9\n2 2 2 1 1 2 5 3\n"), {{"", 1.0}}),
            "a.msh:21: not_found");
  EXPECT_EQ(gmsh(gmsh2("2\n1 3 2 2 1 1 2 3 3\n2 2 2 1 1 2 5 3\n"), {{"", 1.0}}),
            "a.msh:21: duplicate");

  EXPECT_EQ(gmsh(gmsh2("2\n1 4 2 7 1 1 2 4 6\n2 2 2 3 1 2 1 4\n"), {{"", 1.0}}),
            "a.msh: not_found");

  FeModel m = strip(false);
  m.element_sets["BOTH"] = {0};
  EXPECT_EQ(
      error_of([&] {
        read_unv_text(unv_of_shells(m), options_of({{"BOTH", 1.0}, {"PLATE", 2.0}, {"RIB", 3.0}}));
      }),
      "a.unv:22: wrong_value");
  EXPECT_EQ(error_of([&] {
              read_unv_text(unv_of_shells(m), options_of({{"PLAT", 1.0}, {"", 2.0}}));
            }),
            "a.unv: wrong_value");

  TemporaryFolder folder;
  folder.write("a.inp", "*NODE\n1, 0, 0, 0\n");
  const std::string deck = error_of([&] {
    read_fe_file(folder / "a.inp", options_of({{"", 1.0}}));
  });
  EXPECT_EQ(test::without_folders(deck), "a.inp: exclusive") << deck;
}

}  // namespace
}  // namespace floatframe::test

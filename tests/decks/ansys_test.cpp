// ANSYS decks: the same mesh as from Gmsh, blocked and unblocked; elements with repeated nodes and
// without mid-side nodes; components; what a user may write.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "decks/ansys_deck.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "formats/mesh_checks.hpp"

namespace floatframe::test {
namespace {

/// The nodes of an element as a brick of ANSYS lists them, with its repetitions.
std::vector<int> as_brick(const FeModel& m, const FeElement& e) {
  static const std::map<FeElementType, std::vector<int>> order = {
      {FeElementType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}},
      {FeElementType::wedge6, {0, 1, 2, 2, 3, 4, 5, 5}},
      {FeElementType::pyramid5, {0, 1, 2, 3, 4, 4, 4, 4}},
      {FeElementType::tet4, {0, 1, 2, 2, 3, 3, 3, 3}},
      {FeElementType::hex20,
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}},
      {FeElementType::wedge15, {0, 1, 2, 2, 3, 4, 5, 5, 6, 7, 2, 8, 9, 10, 5, 11, 12, 13, 14, 14}},
      {FeElementType::pyramid13, {0, 1, 2, 3, 4, 4, 4, 4, 5, 6, 7, 8, 4, 4, 4, 4, 9, 10, 11, 12}},
      {FeElementType::tet10, {0, 1, 2, 2, 3, 3, 3, 3, 4, 5, 2, 6, 3, 3, 3, 3, 7, 8, 9, 9}}};
  std::vector<int> nodes;
  for (const int k : order.at(e.type)) nodes.push_back(m.node_ids[e.nodes[k]]);
  return nodes;
}

TEST(Ansys, SameMeshAsFromGmsh) {
  for (const char* name : {"bricks.msh", "aarm_coarse.msh.gz"}) {
    SCOPED_TRACE(name);
    FeReadOptions options;
    options.material = Material{2.1e5, 0.3, 7.85e-9};
    FeModel mesh = read_gmsh(std::string(FLOATFRAME_TEST_DATA) + "/fe/" + name, options);
    const SparseMatrix K = assemble_stiffness(mesh), M = assemble_mass(mesh, false, 3);
    std::vector<CdbElement> elements;
    for (const FeElement& e : mesh.elements) {
      CdbElement c;
      c.id = e.id;
      c.nodes = as_brick(mesh, e);
      // Tetrahedra and bricks of second order with all their nodes.
      if (e.type == FeElementType::tet10) {
        c.nodes.clear();
        for (int k = 0; k < 10; ++k) c.nodes.push_back(mesh.node_ids[e.nodes[k]]);
        c.type = 2;
      }
      elements.push_back(c);
    }
    std::string components;
    for (const auto& [set, nodes] : mesh.node_sets) {
      std::vector<int> ids;
      for (const int n : nodes) ids.push_back(mesh.node_ids[n]);
      std::sort(ids.begin(), ids.end());
      components += cdb_component(set, "NODE", ids);
    }
    for (const auto& [set, members] : mesh.element_sets) {
      std::vector<int> ids;
      for (const int e : members) ids.push_back(mesh.elements[e].id);
      std::sort(ids.begin(), ids.end());
      components += cdb_component(set, "ELEM", ids);
    }
    for (const bool blocked : {true, false}) {
      const std::string text = cdb_head +
                               "ET,        1,186\nKEYOP,       1, 2,        1\nET,2,187\n" +
                               cdb_nodes(mesh, blocked) + cdb_elements(elements, blocked) +
                               components + cdb_steel + cdb_tail;
      EXPECT_TRUE(looks_like_ansys(text));
      const FeModel m = ansys_of(text);
      expect_same_mesh(mesh, m, 1e-11);  // CDWRITE has 14 digits
      expect_midside_nodes_near_edges(m);
      EXPECT_LE((assemble_stiffness(m) - K).norm(), 1e-11 * K.norm());
      EXPECT_LE((assemble_mass(m, false, 3) - M).norm(), 1e-11 * M.norm());
      for (const auto& [set, nodes] : mesh.node_sets)
        EXPECT_EQ(as_set(nodes), as_set(m.node_sets.at(upper_case(set)))) << set;
      for (const auto& [set, members] : mesh.element_sets)
        EXPECT_EQ(as_set(members), as_set(m.element_sets.at(upper_case(set)))) << set;
    }
  }
}

/// One element of each kind on the unit cube; corners and middles of its edges.
FeModel one_element(FeElementType type) {
  FeModel m;
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  using E = std::vector<std::array<int, 2>>;
  std::vector<int> places;
  E edges;
  switch (type) {
    case FeElementType::hex8:
    case FeElementType::hex20:
      places = {0, 1, 2, 3, 4, 5, 6, 7};
      edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
      break;
    case FeElementType::wedge6:
    case FeElementType::wedge15:
      places = {0, 1, 2, 4, 5, 6};
      edges = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
      break;
    case FeElementType::pyramid5:
    case FeElementType::pyramid13:
      places = {0, 1, 2, 3, 4};
      edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
      break;
    default:
      places = {0, 1, 2, 4};
      edges = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  }
  FeElement e;
  e.type = type;
  e.id = 7;
  for (const int k : places) m.positions.push_back(corners[k]);
  if (element_nodes(type) > static_cast<int>(places.size()))
    for (const auto& edge : edges)
      m.positions.push_back(0.5 * (m.positions[edge[0]] + m.positions[edge[1]]));
  for (int k = 0; k < m.nodes(); ++k) {
    e.nodes[k] = k;
    m.node_ids.push_back(k + 11);
  }
  m.materials.push_back({2.1e5, 0.3, 7.85e-9});
  m.elements.push_back(e);
  return m;
}

TEST(Ansys, RepeatedNodesMakeWedgesPyramidsAndTetrahedra) {
  for (const auto& [type, number] : {std::pair{FeElementType::hex8, 185},
                                     {FeElementType::wedge6, 185},
                                     {FeElementType::pyramid5, 185},
                                     {FeElementType::tet4, 185},
                                     {FeElementType::hex8, 45},
                                     {FeElementType::hex20, 186},
                                     {FeElementType::wedge15, 186},
                                     {FeElementType::pyramid13, 186},
                                     {FeElementType::tet10, 186},
                                     {FeElementType::wedge15, 95}}) {
    SCOPED_TRACE(fmt::format("{} of SOLID{}", fe_element_name(type), number));
    const FeModel one = one_element(type);
    const int option = number == 45 ? 1 : number == 186 ? 2 : 11;
    const int value = number == 95 ? 0 : 1;
    for (const bool blocked : {true, false}) {
      const FeModel m = ansys_of(
          cdb_head + fmt::format("ET,1,SOLID{}\nKEYOPT,1,{},{}\n", number, option, value) +
          cdb_nodes(one, blocked) +
          cdb_elements({{7, 1, 1, 1, 1, 0, as_brick(one, one.elements[0])}}, blocked) + cdb_steel);
      ASSERT_EQ(m.elements.size(), 1u);
      EXPECT_EQ(m.elements[0].type, type);
      EXPECT_EQ(m.elements[0].nodes, one.elements[0].nodes);
      EXPECT_NO_THROW(validate(m));
    }
  }
}

TEST(Ansys, OptionsOfBricks) {
  const FeModel eight = one_element(FeElementType::hex8),
                twenty = one_element(FeElementType::hex20);
  using T = FeElementType;
  for (const auto& [number, option, value, expected] : {std::tuple{185, 2, 0, T::hex8},
                                                        {185, 2, 1, T::hex8r},
                                                        {185, 2, 2, T::hex8i},
                                                        {185, 2, 3, T::hex8i},
                                                        {45, 1, 0, T::hex8i},
                                                        {45, 1, 1, T::hex8},
                                                        {45, 2, 1, T::hex8r},
                                                        {190, 2, 0, T::hex8i},
                                                        {186, 2, 0, T::hex20r},
                                                        {186, 2, 1, T::hex20},
                                                        {95, 11, 0, T::hex20},
                                                        {95, 11, 1, T::hex20r}}) {
    const FeModel& one = number == 186 || number == 95 ? twenty : eight;
    const FeModel m = ansys_of(
        fmt::format("ET,1,{}\nKEYOPT,1,{},{}\n", number, option, value) + cdb_nodes(one, true) +
        cdb_elements({{7, 1, 1, 1, 1, 0, as_brick(one, one.elements[0])}}, true) + cdb_steel);
    EXPECT_EQ(m.elements.at(0).type, expected) << number << " " << option << " " << value;
  }
}

/// An edge without its node is straight: of a brick of 20 nodes of which all are left out the
/// stiffness is that of the brick of 8.
TEST(Ansys, EdgesWithoutMidNodeAreStraight) {
  const FeModel twenty = one_element(FeElementType::hex20);
  std::vector<int> nodes = as_brick(twenty, twenty.elements[0]);
  const auto read = [&](const std::vector<int>& list) {
    return ansys_of("ET,1,186\nKEYOPT,1,2,1\n" + cdb_nodes(twenty, true) +
                    cdb_elements({{7, 1, 1, 1, 1, 0, list}}, true) + cdb_steel);
  };
  std::vector<int> none = nodes;
  std::fill(none.begin() + 8, none.end(), 0);
  EXPECT_EQ(read(none).elements[0].type, FeElementType::hex8);
  none.resize(8);
  EXPECT_EQ(read(none).elements[0].type, FeElementType::hex8);
  nodes[9] = nodes[19] = 0;
  const FeModel m = read(nodes);
  EXPECT_EQ(m.elements[0].type, FeElementType::hex20);
  ASSERT_EQ(m.nodes(), 22);
  EXPECT_EQ(m.node_ids[20], 31);
  EXPECT_EQ(m.positions[20], Vec3(1, 0.5, 0));
  EXPECT_EQ(m.positions[21], Vec3(0, 1, 0.5));
  ASSERT_EQ(m.equations.size(), 6u);
  EXPECT_EQ(m.equations[0].terms[0].node, 20);
  EXPECT_EQ(m.equations[0].terms[1].factor, -0.5);
  EXPECT_EQ(m.notes[0],
            "a.cdb: 2 edges without their mid-side node are kept straight, by equations");
}

TEST(Ansys, WhatUsersWrite) {
  const FeModel m = ansys_of(
      "! a comment\n/prep7 $ et,1,solid185 $ keyopt,1,2,1\n*set,tid,2\nyoung=2.1e5\net,tid,187\n"
      "mp,ex,1,young\nmp,prxy,1,.3\nmp,dens,1,7.85e-9\n"
      "nblock,3\n(1i9,3e20.9e3)\n"
      "        1 0.000000000E+000    0.000000000E+000    0.000000000E+000\n"
      "        2 1.000000000E+000    0.000000000E+000    0.000000000E+000\n"
      "        3 0.000000000E+000    1.000000000E+000    0.000000000E+000\n"
      "-1\nn,4,0,0,1\nn,5,1,0,1 ! with a comment\nN,6,0,1,1\nN,7,1,1,1\nN,8,1,1\n"
      "type,1\nmat,1\ne,1,2,8,3,4,5,7,6\nen,9,1,2,3,3,4,4,4,4\n"
      "eblock,10,,,1\n(15i9)\n       12        1        1        1        0"
      "        1        2        3        3        5        5        5        5\n-1\n"
      "acel,0,9.81\nf,1,fx,100\nd,1,all\nd,2,ux,0,,,,uy\nd,all,uz\nfini\n/eof\nNONSENSE\n");
  ASSERT_EQ(m.elements.size(), 3u);
  EXPECT_EQ(m.elements[0].id, 1);
  EXPECT_EQ(m.elements[0].type, FeElementType::hex8r);
  EXPECT_EQ(m.elements[1].type, FeElementType::tet4);
  EXPECT_EQ(m.elements[2].id, 12);
  EXPECT_EQ(m.materials[0].young, 2.1e5);
  ASSERT_EQ(m.supports.size(), 2u);
  EXPECT_EQ(m.supports[0].mask, 63u);
  EXPECT_EQ(m.supports[1].mask, 3u);
  EXPECT_EQ(m.notes.back(), "a.cdb: ignored, of loads and analyses: ACEL, D of a selection, F");
}

TEST(Ansys, ElementsOfLoadsAndMeshesAreLeftOut) {
  const FeModel one = one_element(FeElementType::hex8);
  std::vector<CdbElement> elements = {{7, 1, 1, 1, 1, 0, as_brick(one, one.elements[0])},
                                      {8, 2, 1, 1, 1, 0, {11, 12, 13, 14}}};
  const FeModel m = ansys_of(
      "ETBLOCK,        2,        2\n(2i9,19a9)\n        1      185        0        0"
      "\n        2      154        0        0        0        0\n       -1\n" +
      cdb_nodes(one, true) + cdb_elements(elements, true) + cdb_component("ALL", "ELEM", {7, 8}) +
      cdb_steel + "SFEBLOCK,1,2\n(2i9)\n" + "        1        2\n-1\nLUMPM,ON\n");
  EXPECT_EQ(m.elements.size(), 1u);
  EXPECT_EQ(m.elements[0].mass_form, MassForm::lumped);
  EXPECT_EQ(m.element_sets.at("ALL"), std::vector<int>{0});
  EXPECT_EQ(m.notes[0], "a.cdb: 1 SURF154 have neither stiffness nor mass and are left out");
}

}  // namespace
}  // namespace floatframe::test

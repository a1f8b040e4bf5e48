// Meshes written for other programs, read again: the same nodes, elements, sets, stiffness, mass;
// what a format cannot hold is said or refused. That CalculiX finds the same frequencies in written
// decks is what scripts/deck_suite.py shows.
#include "floatframe/formats/written/mesh_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_text.hpp"
#include "decks/written_mesh.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "formats/mesh_checks.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {
namespace {

/// One element of a type, bent out of shape; numbers of nodes and elements as a user might have.
FeModel single_element(FeElementType type) {
  FeModel model;
  model.materials = {steel};
  model.material_names = {"STEEL"};
  FeElement e;
  e.type = type;
  e.id = 70;
  const ElementKernel& kernel = element_kernel(type);
  const auto place = [](double x, double y, double z) {
    return Vec3(x + 0.05 * y * z, 1.1 * y + 0.04 * x, 0.9 * z - 0.03 * x * y);
  };
  std::vector<Vec3> corners;
  if (kernel.family == ElementFamily::beam || kernel.family == ElementFamily::rod) {
    corners = {place(0, 0, 0), place(1, 0.2, 0.1)};
    model.sections = {BeamSection::rectangle(0.02, 0.03)};
    e.reference = Vec3(0.1, 0.2, 1.0).normalized();
  } else if (has_shell_section(type)) {
    corners = {place(0, 0, 0), place(1, 0, 0), place(1, 1, 0)};
    if (kernel.nodes == 4 || kernel.nodes == 8) corners.push_back(place(0, 1, 0));
    model.shells = {{.thickness = 0.02, .shear = 0.02 * 5.0 / 6.0, .offset = 0.005}};
    if (is_membrane(type)) model.shells[0].offset = 0.0;
    for (Vec3& p : corners) p(2) = 0.1 * p(0);
  } else if (kernel.nodes == 4 || kernel.nodes == 10) {
    corners = {place(0, 0, 0), place(1, 0, 0), place(0, 1, 0), place(0, 0, 1)};
  } else if (kernel.nodes == 5 || kernel.nodes == 13) {
    corners = {place(0, 0, 0), place(1, 0, 0), place(1, 1, 0), place(0, 1, 0), place(0.5, 0.5, 1)};
  } else if (kernel.nodes == 6 || kernel.nodes == 15) {
    corners = {place(0, 0, 0), place(1, 0, 0), place(0, 1, 0),
               place(0, 0, 1), place(1, 0, 1), place(0, 1, 1)};
  } else {
    corners = {place(0, 0, 0), place(1, 0, 0), place(1, 1, 0), place(0, 1, 0),
               place(0, 0, 1), place(1, 0, 1), place(1, 1, 1), place(0, 1, 1)};
  }
  model.positions = corners;
  model.positions.resize(static_cast<std::size_t>(kernel.nodes));
  if (type == FeElementType::beam3) {
    model.positions[2] = corners[1];
    model.positions[1] = 0.5 * (corners[0] + corners[1]);
  } else if (has_shell_section(type)) {
    const std::size_t n = corners.size();
    for (std::size_t k = n; k < model.positions.size(); ++k)
      model.positions[k] = 0.5 * (corners[k - n] + corners[(k - n + 1) % n]);
  } else {
    for (const FaceNodes& f : element_faces(type))
      for (int k = 0; k < f.count - f.corners; ++k)
        model.positions[static_cast<std::size_t>(f.nodes[f.corners + k])] =
            0.5 * (corners[static_cast<std::size_t>(f.nodes[k])] +
                   corners[static_cast<std::size_t>(f.nodes[(k + 1) % f.corners])]);
  }
  for (int k = 0; k < kernel.nodes; ++k) {
    e.nodes[static_cast<std::size_t>(k)] = k;
    model.node_ids.push_back(11 + 3 * k);
  }
  model.elements = {e};
  return model;
}

TEST(MeshWriter, DecksOfEveryElement) {
  for (const FeElementType type : fe_element_types) {
    SCOPED_TRACE(fe_element_name(type));
    if (type == FeElementType::shear4) continue;  // CalculiX has none
    const FeModel model = single_element(type);
    if (is_membrane(type)) {
      const std::string text = written(model, ".inp").bytes;
      EXPECT_TRUE(contains(text, "*ELEMENT, TYPE=M3D"));
      EXPECT_TRUE(contains(text, "*MEMBRANE SECTION, ELSET=SECTION_1, MATERIAL=STEEL\n0.02\n"));
    }
    const FeModel again = there_and_back(model, ".inp");
    if (type == FeElementType::pyramid5 || type == FeElementType::pyramid13) {
      // A brick with one upper node has the volume of the pyramid.
      ASSERT_EQ(again.elements.size(), 1u);
      EXPECT_NEAR(corner_volume(again), corner_volume(model), 1e-12);
      EXPECT_TRUE(contains(written_notes(model, ".inp"), "CalculiX has no pyramids"));
      continue;
    }
    ASSERT_EQ(again.elements.size(), 1u);
    EXPECT_EQ(again.elements[0].type, type);
    EXPECT_EQ(again.elements[0].nodes, model.elements[0].nodes);
    EXPECT_EQ(again.elements[0].id, 70);
    EXPECT_EQ(again.node_ids, model.node_ids);
    if (is_shell(type)) {
      EXPECT_NEAR(again.shells[0].offset, model.shells[0].offset, 1e-15);
    }
    // Shear of 2-node beams and of shells is the choice of whoever reads.
    if (element_kernel(type).family == ElementFamily::solid || type == FeElementType::beam3 ||
        is_membrane(type))
      expect_same_system(model, again);
  }
}

TEST(MeshWriter, GmshMeshesOfEveryElement) {
  for (const FeElementType type : fe_element_types) {
    SCOPED_TRACE(fe_element_name(type));
    const FeModel model = single_element(type);
    if (element_kernel(type).family != ElementFamily::solid) {
      const std::string text = written(model, ".msh").bytes;
      EXPECT_TRUE(contains(text, "$Elements\n1 1 1 70\n"));
      continue;
    }
    const FeModel again = there_and_back(model, ".msh");
    ASSERT_EQ(again.elements.size(), 1u);
    EXPECT_EQ(again.elements[0].nodes, model.elements[0].nodes);
    EXPECT_EQ(again.node_ids, model.node_ids);
    EXPECT_EQ(again.element_sets.at("STEEL"), std::vector<int>{0});
    EXPECT_NEAR(corner_volume(again), corner_volume(model), 1e-15);
  }
}

TEST(MeshWriter, ArmKeepsItsSetsInEveryFormat) {
  const FeModel arm = read_fe_file(fe_data("aarm_coarse.msh.gz"));
  const FeModel mesh = there_and_back(arm, ".msh");
  expect_same_mesh(arm, mesh, 0.0);  // shortest digits
  FeModel steel_arm = arm;
  steel_arm.materials = {steel};
  for (FeElement& e : steel_arm.elements) e.material = 0;
  const FeModel deck = there_and_back(steel_arm, ".inp");
  expect_same_mesh(arm, deck, 1e-10);
  for (const auto& [set, nodes] : arm.node_sets) {
    EXPECT_EQ(as_set(nodes), as_set(mesh.node_sets.at(set))) << set;
    EXPECT_EQ(as_set(nodes), as_set(deck.node_sets.at(set))) << set;
  }
  EXPECT_EQ(mesh.element_sets.at("BODY"), arm.element_sets.at("BODY"));
  EXPECT_EQ(deck.element_sets.at("BODY"), arm.element_sets.at("BODY"));
}

TEST(MeshWriter, MaterialsWithAxes) {
  for (const char* name : {"orthotropic_hex8.inp.gz", "orthotropic_hex20.inp.gz",
                           "anisotropic_tet10.inp.gz", "orthotropic_ring.inp.gz"}) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(fe_data(name));
    expect_same_system(model, there_and_back(model, ".inp"));
  }
}

/// Axes that CalculiX has not are those of the middle of each element: exact where they do not turn
/// within one.
TEST(MeshWriter, AxesFromPlaceToPlace) {
  FeModel model = read_fe_file(fe_data("orthotropic_hex8.inp.gz"));
  for (Orientation& o : model.orientations) {
    o.kind = Orientation::Kind::spherical;
    o.origin = Vec3(-1e13, 0, 0);
    o.axes = Mat3::Identity();
  }
  expect_same_system(model, there_and_back(model, ".inp"));
  EXPECT_TRUE(contains(written_notes(model, ".inp"), "are those of the middle of each element"));
}

/// Two bricks with a spider at their end that carries a mass, and an equation.
FeModel bricks_with(Spider::Kind kind) {
  FeModel model;
  model.materials = {steel};
  for (int k = 0; k < 12; ++k)
    model.positions.push_back(Vec3(k / 4, k % 2, k / 2 % 2) * 0.1 +
                              Vec3(0.003 * k, 0.01 * std::sin(k), 0.001 * k * k));
  for (const int a : {0, 4})
    add_element(model, FeElementType::hex8, {a, a + 4, a + 5, a + 1, a + 2, a + 6, a + 7, a + 3});
  model.positions.emplace_back(0.4, 0.06, 0.04);
  model.masses = {{12, 1.5, Mat3::Zero()}, {2, 0.3, Mat3::Zero()}};
  add_spider(model, 12, {8, 9, 10, 11}, kind).name = "FLANGE";
  LinearEquation equation;
  equation.terms = {{0, 1, 2.0}, {1, 1, -1.0}, {3, 2, 0.5}};
  model.equations = {equation};
  return model;
}

TEST(MeshWriter, SpidersAndEquationsAreEquationsOfADeck) {
  for (const Spider::Kind kind : {Spider::Kind::rigid, Spider::Kind::mean}) {
    const FeModel model = bricks_with(kind);
    const VecX expected = free_eigenvalues(model);
    const VecX found = free_eigenvalues(there_and_back(model, ".inp"));
    ASSERT_EQ(found.size(), expected.size());
    for (int k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(found(k), expected(k), 1e-11 * expected.maxCoeff()) << k;
  }
}

TEST(MeshWriter, LossesAreNoted) {
  FeModel model = bricks_with(Spider::Kind::rigid);
  model.masses[0].J = Mat3::Identity();
  model.surfaces["END"] = {{0, 2}};
  EXPECT_EQ(written_notes(model, ".msh"),
            "1 rigid or mean connection left out: a mesh of Gmsh has no such thing\n"
            "1 equation left out: a mesh of Gmsh has no such thing\n"
            "2 point masses left out: a mesh of Gmsh has no such thing\n"
            "1 surface left out: a mesh of Gmsh has no such thing\n"
            "materials and sections are left out but for the names of materials, which are "
            "groups\n");
  model.elements[0].mass_form = MassForm::lumped;
  model.elements[0].id = model.elements[1].id = 4;
  model.without_density[0] = {};
  EXPECT_EQ(written_notes(model, ".inp"),
            "the elements are numbered anew: their numbers are not all different\n"
            "1 element of lumped mass: CalculiX takes consistent mass\n"
            "1 direction is bound by equations of the model that rigid motions do not satisfy: the "
            "part is not free; first: node 0 uy\n"
            "the inertia of 1 point mass about the node is left out: CalculiX has masses without "
            "inertia\n"
            "no step of vibration: the density of a material is not known (--density RHO)\n");
  EXPECT_EQ(written_notes(model, ".vtu"),
            "the elements are numbered anew: their numbers are not all different\n"
            "1 surface of element faces is not written\n");
}

TEST(MeshWriter, PipesAndIncompatibleModes) {
  FeModel pipe = single_element(FeElementType::beam3);
  pipe.sections[0] = BeamSection::hollow_round(0.04, 0.03);
  EXPECT_TRUE(contains(written(pipe, ".inp").bytes, "*ELEMENT, TYPE=B32R\n"));
  EXPECT_TRUE(contains(written_notes(single_element(FeElementType::rod2), ".inp"),
                       "1 element are rods: what CalculiX makes of them bends by itself, with low "
                       "frequencies of its own, and is clamped to beams at their nodes\n"));
  EXPECT_TRUE(contains(written_notes(single_element(FeElementType::hex8i), ".inp"),
                       "1 element of 8 nodes with incompatible modes: CalculiX (C3D8I) gives these "
                       "modes mass, its frequencies are lower, by some percent where the mesh is "
                       "coarse\n"));
}

TEST(MeshWriter, SupportsAreComments) {
  FeModel model = bricks_with(Spider::Kind::rigid);
  model.supports = {{0, 0b101, {}}};
  const std::string deck = written(model, ".inp", 5).bytes;
  EXPECT_TRUE(contains(deck, "** *BOUNDARY\n** 1, 1, 1\n** 1, 3, 3\n"));
  EXPECT_TRUE(contains(deck, "*STEP\n*FREQUENCY\n5\n"));
  EXPECT_TRUE(there_and_back(model, ".inp").supports.empty());
}

TEST(MeshWriter, NamesThatOtherProgramsCannotRead) {
  FeModel model = bricks_with(Spider::Kind::rigid);
  model.node_sets = {{"left \"eye\"", {0, 1}}, {"LEFT__EYE_", {2}}, {"", {3}}};
  const FeModel deck = there_and_back(model, ".inp");
  EXPECT_EQ(deck.node_sets.at("LEFT__EYE_"), std::vector<int>{2});
  EXPECT_EQ(deck.node_sets.at("LEFT__EYE__2"), (std::vector<int>{0, 1}));
  EXPECT_EQ(deck.node_sets.at("_"), std::vector<int>{3});
  const std::string rule =
      "written otherwise (letters, digits, '_' and '-', at most 60, each once)";
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "2 names are " + rule + ": '' as _, 'left \"eye\"' as LEFT__EYE__2\n"));
  EXPECT_TRUE(
      contains(written_notes(model, ".msh"), "2 names are " + rule + ": '' as _, 'left \"eye\"'"));
  EXPECT_TRUE(contains(written_notes(model, ".vtu"), "1 name is " + rule + ": 'set_left"));
  model.node_sets = {{"eye", {0}}};
  EXPECT_FALSE(contains(written_notes(model, ".inp"), "name"));
}

TEST(MeshWriter, WhatADeckWouldFalsifyIsRefused) {
  const auto refusal = [](FeModel model) { return error_of([&] { written(model, ".inp"); }); };
  FeModel shell = single_element(FeElementType::quad4);
  shell.shells[0].plies = {{0, 0.01, 0.0}, {0, 0.01, 0.5}};
  EXPECT_EQ(refusal(shell), "unsupported");
  for (int k = 1; k < 30; ++k) {
    shell.elements.push_back(shell.elements[0]);
    shell.elements.back().id += k;
  }
  EXPECT_EQ(refusal(shell), "unsupported");
  FeModel solid = single_element(FeElementType::hex20);
  solid.layups = {{{{0, 1.0, 0.0}, {0, 1.0, 0.5}}}};
  solid.elements[0].layup = 0;
  EXPECT_EQ(refusal(solid), "unsupported");
  FeModel beam = single_element(FeElementType::beam2);
  beam.sections[0] = BeamSection::solid_round(0.01);
  EXPECT_EQ(refusal(beam), "unsupported");
  beam.sections[0].outline = BeamSection::Outline::unknown;
  EXPECT_EQ(refusal(beam), "unsupported");
  FeModel bare = single_element(FeElementType::tet4);
  bare.materials.clear();
  EXPECT_EQ(refusal(bare), "incomplete");
  EXPECT_EQ(error_of([] { mesh_format_of("part.stl"); }), "part.stl: wrong_file");
}

}  // namespace
}  // namespace floatframe::test

// Decks of Abaqus, CalculiX and Gmsh: what is read is what stands there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <string>

#include "decks/deck_text.hpp"
#include "floatframe/fe/element_faces.hpp"

namespace floatframe::test {
namespace {

const std::string folder = FLOATFRAME_TEST_DATA "/fe/";

const std::string tetrahedron =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 1., 1., 1.\n"
    "6, 2., 0., 0.\n"
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n"
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E5, .3\n*DENSITY\n7.85D-9\n"
    "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";

double volume_of_faces(const FeModel& model) {
  // Divergence theorem over all faces of all elements, flat triangles between corners: inner faces
  // cancel.
  double six = 0.0;
  for (const FeElement& e : model.elements) {
    for (const FaceNodes& face : element_faces(e.type)) {
      const auto p = [&](int k) { return model.positions[e.nodes[face.nodes[k]]]; };
      for (int k = 2; k < face.corners; ++k) six += p(0).dot(p(k - 1).cross(p(k)));
    }
  }
  return six / 6.0;
}

TEST(Abaqus, CoarseArmHasTheNodesElementsAndSetsOfItsMesh) {
  FeReadOptions options;
  options.material = Material{210000.0, 0.3, 7.85e-9};
  const FeModel model = read_fe_file(folder + "aarm_coarse_mesh.inp.gz", options);
  EXPECT_EQ(model.nodes(), 5687);
  ASSERT_EQ(model.elements.size(), 2785u);
  EXPECT_TRUE(std::all_of(model.elements.begin(), model.elements.end(),
                          [](const FeElement& e) { return e.type == FeElementType::tet10; }));
  EXPECT_EQ(model.node_sets.at("BUSH_F").size(), 130u);
  EXPECT_EQ(model.node_sets.at("BUSH_R").size(), 130u);
  EXPECT_EQ(model.node_sets.at("BALL").size(), 130u);
  EXPECT_EQ(model.node_sets.at("DAMP_F").size(), 78u);
  EXPECT_EQ(model.node_sets.at("DAMP_R").size(), 82u);
  EXPECT_EQ(model.node_sets.at("IFACE").size(), 130u + 130u + 130u + 78u + 82u);
  EXPECT_EQ(model.node_sets.at("NALL").size(), 5687u);
  EXPECT_EQ(model.positions[4], Vec3(63.8235294118, 140, 9));
  EXPECT_EQ(model.node_sources[4].line, 7);
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].density, 7.85e-9);
  // Straight edges lose a little of the bores' curvature: the CAD volume is 701290.98 mm3.
  EXPECT_NEAR(volume_of_faces(model), 701290.98, 0.01 * 701290.98);
  EXPECT_GT(std::abs(volume_of_faces(model) - 701290.98), 1.0);
}

TEST(Abaqus, GmshsOwnDeckIsTheSameMesh) {
  FeReadOptions options;
  options.material = Material{210000.0, 0.3, 7.85e-9};
  const FeModel a = read_fe_file(folder + "aarm_coarse_mesh.inp.gz", options);
  const FeModel b = read_fe_file(folder + "aarm_coarse_raw.inp.gz", options);
  ASSERT_EQ(b.nodes(), a.nodes());
  ASSERT_EQ(b.elements.size(), a.elements.size());
  std::map<int, Vec3> of_id;
  for (int k = 0; k < a.nodes(); ++k) {
    of_id[a.node_ids[k]] = a.positions[k];
  }
  for (int k = 0; k < b.nodes(); ++k) {
    const std::size_t i = k;
    EXPECT_LT((of_id.at(b.node_ids[i]) - b.positions[i]).norm(), 1e-8);
  }
  EXPECT_NEAR(volume_of_faces(a), volume_of_faces(b), 1e-6);
  for (const char* set : {"BUSH_F", "BUSH_R", "BALL", "DAMP_F", "DAMP_R"}) {
    EXPECT_EQ(b.node_sets.at(set).size(), a.node_sets.at(set).size()) << set;
  }
  // The skins of the bores, as sets of nodes.
  EXPECT_EQ(b.node_sets.at("SURFACE62").size(), 82u);
  ASSERT_EQ(b.notes.size(), 1u);
  EXPECT_TRUE(contains(b.notes[0], "elements of type CPS6 have no section"));
}

TEST(Abaqus, AMeshWithoutMaterialIsReadWithANote) {
  const FeModel model = read_fe_file(folder + "aarm_coarse_mesh.inp.gz");
  EXPECT_TRUE(model.materials.empty());
  EXPECT_EQ(model.elements[0].material, -1);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_EQ(model.notes[0], folder + "aarm_coarse_mesh.inp.gz:5691: the deck has no material");
}

TEST(Abaqus, JobDecksIncludeTheirMesh) {
  const FeModel free = read_fe_file(folder + "aarm_coarse_free.inp");
  ASSERT_EQ(free.materials.size(), 1u);
  EXPECT_EQ(free.materials[0].young, 210000.0);
  EXPECT_EQ(free.elements[7].material, 0);
  ASSERT_EQ(free.files.size(), 2u);
  EXPECT_EQ(free.files[1], folder + "aarm_coarse_mesh.inp.gz");
  const SourceMark mark = free.mark(free.elements[0].source);
  EXPECT_EQ(mark.file, free.files[1]);
  EXPECT_EQ(mark.line, 5691);
  const FeModel fixed = read_fe_file(folder + "aarm_coarse_fixed.inp");
  EXPECT_EQ(fixed.supports.size(), 550u);
  EXPECT_EQ(fixed.supports[0].mask, 7u);
}

TEST(Abaqus, RigidBodiesBecomeSpiders) {
  const FeModel model = read_fe_file(folder + "aarm_coarse_rbe2_free.inp");
  ASSERT_EQ(model.spiders.size(), 5u);
  const Spider& ball = model.spiders[2];
  EXPECT_EQ(ball.kind, Spider::Kind::rigid);
  EXPECT_EQ(ball.name, "BALL");
  EXPECT_EQ(ball.nodes, model.node_sets.at("BALL"));
  EXPECT_EQ(model.node_ids[ball.reference], 5692);
  EXPECT_EQ(model.node_ids[ball.rotation_node], 5693);
  EXPECT_EQ(model.positions[ball.reference], Vec3(-20, 330, 7));
}

TEST(Abaqus, CouplingsToSurfacesBecomeSpiders) {
  const FeModel model = read_fe_file(folder + "aarm_coarse_rbe3_static.inp");
  ASSERT_EQ(model.spiders.size(), 5u);
  int mean = 0;
  for (const Spider& spider : model.spiders) {
    if (spider.kind != Spider::Kind::mean) continue;
    ++mean;
    const std::string name = spider.name.substr(2);  // C_BALL
    std::vector<int> nodes = spider.nodes, set = model.node_sets.at(name);
    std::sort(nodes.begin(), nodes.end());
    std::sort(set.begin(), set.end());
    EXPECT_EQ(nodes, set);  // the faces of the bore hold the nodes of the bore
    // The weights are areas: their sum is the area of the flat faces.
    double area = 0.0;
    for (const ElementFace& f : model.surfaces.at("S_" + name)) {
      const FeElement& e = model.elements[f.element];
      const FaceNodes& face = element_faces(e.type)[f.face];
      const auto p = [&](std::size_t k) { return model.positions[e.nodes[face.nodes[k]]]; };
      area += 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
    }
    EXPECT_NEAR(std::accumulate(spider.weights.begin(), spider.weights.end(), 0.0), area,
                1e-12 * area);
  }
  EXPECT_EQ(mean, 3);
}

TEST(Abaqus, BeamDecks) {
  const FeModel b31 = read_fe_file(folder + "beam_b31_free.inp");
  ASSERT_EQ(b31.elements.size(), 40u);
  EXPECT_EQ(b31.elements[0].type, FeElementType::beam2);
  ASSERT_EQ(b31.sections.size(), 1u);
  EXPECT_NEAR(b31.sections[0].A, 4e-4, 1e-18);
  EXPECT_NEAR(b31.sections[0].Iy, 0.02 * 0.02 * 0.02 * 0.02 / 12.0, 1e-22);
  EXPECT_EQ(b31.elements[0].reference, Vec3::UnitZ());
  for (const char* name : {"b32", "b32r"}) {
    const FeModel model = read_fe_file(folder + "beam_" + name + "_free.inp");
    ASSERT_EQ(model.elements.size(), 20u);
    EXPECT_EQ(model.elements[0].type, FeElementType::beam3);
    // End, middle, end.
    const FeElement& e = model.elements[0];
    EXPECT_NEAR(model.positions[e.nodes[1]].x(), 0.025, 1e-12);
    EXPECT_NEAR(model.positions[e.nodes[2]].x(), 0.05, 1e-12);
  }
  const FeModel clamped = read_fe_file(folder + "beam_b32r_cant.inp");
  ASSERT_EQ(clamped.supports.size(), 1u);
  EXPECT_EQ(clamped.supports[0].mask, 63u);
}

TEST(Abaqus, BrickDecks) {
  for (const auto& [name, type] :
       {std::pair{"c3d20", FeElementType::hex20}, std::pair{"c3d20r", FeElementType::hex20r}}) {
    const FeModel model = read_fe_file(folder + "beam_" + name + "_free.inp");
    EXPECT_EQ(model.nodes(), 1521);
    ASSERT_EQ(model.elements.size(), 200u);
    EXPECT_EQ(model.elements[0].type, type);
    EXPECT_NEAR(volume_of_faces(model), 4e-4, 1e-12);
  }
}

TEST(Abaqus, NumbersContinuationsAndCase) {
  const FeModel model = read_inp(
      "*Heading\n anything, *here\n** a comment\n*Node, nset = All Nodes\n"
      " 1, 0., 0., 0.\n2, 1.D0\n 3,, 1e0,\n4, 0, 0, +.1D+1,\n\n"
      "*element,\n type=c3d4,\n elset=Body\n1, 1,\n2, 3,\n4\n"
      "*Material, Name=\"Grade A\"\n*Elastic, type=iso\n2.1D+11, 3.-1\n*Density\n7.85+3,\n"
      "*solid section, elset=BODY, material=\"Grade A\"\n,\n");
  ASSERT_EQ(model.nodes(), 4);
  EXPECT_EQ(model.positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(model.positions[2], Vec3(0, 1, 0));
  EXPECT_EQ(model.positions[3], Vec3(0, 0, 1));
  EXPECT_EQ(model.node_sets.at("ALLNODES").size(), 4u);
  ASSERT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.elements[0].nodes[3], 3);
  EXPECT_EQ(model.elements[0].source.line, 13);
  EXPECT_EQ(model.materials[0].young, 2.1e11);
  EXPECT_EQ(model.materials[0].poisson, 0.3);
  EXPECT_EQ(model.materials[0].density, 7850.0);
  EXPECT_EQ(model.material_names[0], "Grade A");
}

TEST(Abaqus, SetsOfSetsRangesAndSetsOpenedAgain) {
  const FeModel model = read_inp(tetrahedron +
                                 "*NSET, NSET=A\n5, 1\n*NSET, NSET=B, GENERATE\n1, 5, 2\n6, 6\n"
                                 "*NSET, NSET=C\nA, 2, B\n*NSET, NSET=A\n4, A\n"
                                 "*NSET, NSET=GAPS, GENERATE\n4, 9\n*ELSET, ELSET=E\n2, BODY\n");
  EXPECT_EQ(model.node_sets.at("A"), (std::vector<int>{4, 0, 3}));
  EXPECT_EQ(model.node_sets.at("B"), (std::vector<int>{0, 2, 4, 5}));
  EXPECT_EQ(model.node_sets.at("C"), (std::vector<int>{4, 0, 3, 1, 2, 5}));
  EXPECT_EQ(model.node_sets.at("GAPS"), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(model.element_sets.at("E"), (std::vector<int>{1, 0}));
  ASSERT_EQ(model.notes.size(), 2u);  // and that of the mass
  EXPECT_EQ(model.notes[0], "deck.inp:27: 3 numbers of GENERATE do not exist");
}

TEST(Abaqus, OnePartAndOneInstance) {
  const FeModel model = read_inp(
      "*Heading\n*Part, name=Arm\n*Node\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n"
      "4, 0., 0., 1.\n*Element, type=C3D4\n1, 1, 2, 3, 4\n*Nset, nset=HOLE\n2, 3, 4\n"
      "*Elset, elset=ALL, internal\n1\n*Solid Section, elset=ALL, material=M\n,\n*End Part\n"
      "*Assembly, name=Assembly\n*Instance, name=Arm-1, part=Arm\n10., 0., 0.\n"
      "10., 0., 0., 10., 0., 1., 90.\n*End Instance\n*Node\n1, 5., 5., 5.\n"
      "*Nset, nset=REF\n1\n*Nset, nset=HOLE, instance=Arm-1\n2, 3\n"
      "*Nset, nset=PICKED, internal\nArm-1.4\n*Surface, name=S, type=NODE\nArm-1.HOLE\n"
      "*Coupling, constraint name=C, ref node=REF, surface=S\n*Kinematic\n1, 6\n"
      "*End Assembly\n*Material, name=M\n*Elastic\n2e5, .3\n*Density\n8e-9\n"
      "*Boundary\nREF, ENCASTRE\nArm-1.1, 1, 3\n");
  ASSERT_EQ(model.nodes(), 5);
  // Moved by 10 along x, then turned by 90 degrees about the z axis through (10, 0, 0).
  EXPECT_LT((model.positions[0] - Vec3(10, 0, 0)).norm(), 1e-14);
  EXPECT_LT((model.positions[1] - Vec3(10, 1, 0)).norm(), 1e-14);
  EXPECT_LT((model.positions[2] - Vec3(9, 0, 0)).norm(), 1e-14);
  EXPECT_EQ(model.positions[4], Vec3(5, 5, 5));
  EXPECT_EQ(model.node_ids, (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(model.node_sets.at("HOLE"), (std::vector<int>{1, 2}));
  EXPECT_EQ(model.node_sets.at("ARM-1.HOLE"), (std::vector<int>{1, 2, 3}));
  EXPECT_FALSE(model.node_sets.contains("PICKED"));
  ASSERT_EQ(model.spiders.size(), 1u);
  EXPECT_EQ(model.spiders[0].reference, 4);
  EXPECT_EQ(model.spiders[0].nodes, (std::vector<int>{1, 2, 3}));
  ASSERT_EQ(model.supports.size(), 2u);
  EXPECT_EQ(model.supports[0].node, 4);
  EXPECT_EQ(model.supports[0].mask, 63u);
  EXPECT_EQ(model.supports[1].node, 0);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_EQ(model.notes[0],
            "deck.inp:23: node 1 of the assembly has the number of another one: it becomes "
            "node 5");
}

TEST(Abaqus, MassesEquationsAndCouplings) {
  const FeModel model = read_inp(
      tetrahedron +
      "*NODE\n10, 0., 0., 5.\n11, 0., 0., 5.\n"
      "*ELEMENT, TYPE=MASS, ELSET=LUMP\n20, 10\n*MASS, ELSET=LUMP\n2.5\n"
      "*ELEMENT, TYPE=ROTARYI, ELSET=WHEEL\n21, 10\n*ROTARY INERTIA, ELSET=WHEEL\n1., 2., 2.5\n"
      "*ELEMENT, TYPE=DCOUP3D, ELSET=TIP\n22, 6\n"
      "*NSET, NSET=FACE\n3, 4, 5\n*RIGID BODY, NSET=FACE, REF NODE=10, ROT NODE=11\n"
      "*DISTRIBUTING COUPLING, ELSET=TIP\n1, 2.\n2, 1.\n"
      "*EQUATION\n2\n1, 1, 1., 11, 3, -0.5\n*BOUNDARY\n11, 2\n");
  ASSERT_EQ(model.masses.size(), 2u);
  EXPECT_EQ(model.masses[0].node, 6);
  EXPECT_EQ(model.masses[0].mass, 2.5);
  EXPECT_EQ(model.masses[1].J, Mat3(Vec3(1.0, 2.0, 2.5).asDiagonal()));
  ASSERT_EQ(model.spiders.size(), 2u);
  EXPECT_EQ(model.spiders[1].kind, Spider::Kind::mean);
  EXPECT_EQ(model.spiders[1].reference, 5);
  EXPECT_EQ(model.spiders[1].weights, (std::vector<double>{2.0, 1.0}));
  // Node 11 carries the rotations of node 10.
  ASSERT_EQ(model.equations.size(), 1u);
  ASSERT_EQ(model.equations[0].terms.size(), 2u);
  EXPECT_EQ(model.equations[0].terms[1].node, 6);
  EXPECT_EQ(model.equations[0].terms[1].axis, 5);
  EXPECT_EQ(model.equations[0].terms[1].factor, -0.5);
  ASSERT_EQ(model.supports.size(), 1u);
  EXPECT_EQ(model.supports[0].node, 6);
  EXPECT_EQ(model.supports[0].mask, 16u);
}

TEST(Abaqus, HarmlessKeywordsAreListedOnceEach) {
  const FeModel model = read_inp(tetrahedron +
                                 "*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n*AMPLITUDE, NAME=B\n0., 0.\n"
                                 "*PLASTIC\n1., 0.\n*STEP\n*STATIC\n*CLOAD\n2, 1, 5.\n*END STEP\n");
  ASSERT_EQ(model.notes.size(), 4u);  // and that of the mass
  EXPECT_EQ(model.notes[0], "deck.inp:17: *AMPLITUDE is ignored");
  EXPECT_EQ(model.notes[1], "deck.inp:21: *PLASTIC is ignored");
  EXPECT_EQ(model.notes[2], "deck.inp:23: *STEP and what follows up to *END STEP is ignored");
}

TEST(Abaqus, SectionsOfBeamsAndShells) {
  const std::string begin =
      "*NODE\n1\n2, 1.\n3, 1., 1.\n4, 0., 1.\n*MATERIAL, NAME=M\n*ELASTIC\n1., .25\n*DENSITY\n1.\n"
      "*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=";
  EXPECT_NEAR(read_inp(begin + "CIRC\n2.\n").sections[0].A, 4.0 * std::acos(-1.0), 1e-14);
  EXPECT_EQ(read_inp(begin + "CIRC\n2.\n").elements[0].reference, Vec3(0, 0, -1));
  const BeamSection pipe = read_inp(begin + "PIPE\n2., .5\n").sections[0];
  EXPECT_NEAR(pipe.J, 0.5 * std::acos(-1.0) * (16.0 - 1.5 * 1.5 * 1.5 * 1.5), 1e-13);
  // Direction 1 is y: the width a lies along y.
  const BeamSection box = read_inp(begin + "BOX\n4., 2., .2, .1, .2, .1\n0., 1., 0.\n").sections[0];
  EXPECT_NEAR(box.A, 8.0 - 3.6 * 1.8, 1e-14);
  EXPECT_NEAR(box.Iz, (2.0 * 64.0 - 1.8 * 3.6 * 3.6 * 3.6) / 12.0, 1e-13);
  EXPECT_NEAR(box.Iy, (4.0 * 8.0 - 3.6 * 1.8 * 1.8 * 1.8) / 12.0, 1e-13);
  EXPECT_NEAR(box.J, 4.0 * std::pow(3.8 * 1.9, 2) / (2.0 * 3.8 / 0.1 + 2.0 * 1.9 / 0.2), 1e-12);
  const FeModel shell = read_inp(
      "*NODE\n1\n2, 1.\n3, 1., 1.\n4, 0., 1.\n*MATERIAL, NAME=M\n*ELASTIC\n1., .25\n*DENSITY\n1.\n"
      "*ELEMENT, TYPE=S4R, ELSET=E\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S3, ELSET=E\n2, 1, 2, 3\n"
      "*SHELL SECTION, ELSET=E, MATERIAL=M\n.75, 5\n");
  ASSERT_EQ(shell.elements.size(), 2u);
  EXPECT_EQ(shell.elements[0].type, FeElementType::quad4);
  EXPECT_EQ(shell.elements[1].type, FeElementType::tri3);
  EXPECT_EQ(shell.shells.at(0).thickness, 0.75);
}

}  // namespace
}  // namespace floatframe::test

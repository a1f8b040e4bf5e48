// Nastran bulk data and DMIG matrices: what is read is what stands there, in every field format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/deck_text.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"
#include "formats/mesh_checks.hpp"
#include "support/random_body.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

std::string nastran_file(const std::string& name) {
  return std::string(FLOATFRAME_TEST_DATA) + "/fe/" + name;
}

FeModel bulk_model(const std::string& text, const FeReadOptions& options = {}) {
  return read_bdf(text, options, "deck.bdf");
}

/// Mass of the assembled model: every translation moves all of it.
double assembled_mass(const std::string& name) {
  FeReadOptions options;
  options.material = Material{210000.0, 0.3, 7.85e-9};
  const FeSystem system = assemble(read_fe_file(nastran_file(name), options));
  VecX u = VecX::Zero(system.size());
  for (int i = 0; i < system.size(); ++i) {
    if (system.dofs[i].axis == 0) u(i) = 1.0;
  }
  return u.dot(system.M * u);
}

/// Mass in tonnes, from the mass matrix that CalculiX exports for the same mesh. Its four points do
/// not integrate elements with curved sides exactly: 2.3e-7.
TEST(Nastran, MassOfTheArmIsThatOfOtherFormats) {
  EXPECT_NEAR(assembled_mass("aarm_coarse.msh.gz"), 5.504932e-3, 2e-9);
  EXPECT_NEAR(assembled_mass("aarm_coarse.bdf.gz"), 5.504932e-3, 2e-5 * 5.5e-3);
}

TEST(Nastran, ArmOfGmsh) {
  const FeModel msh = read_fe_file(nastran_file("aarm_coarse.msh.gz"));
  const FeModel bdf = read_fe_file(nastran_file("aarm_coarse.bdf.gz"));
  EXPECT_EQ(bdf.nodes(), 5687);
  EXPECT_EQ(bdf.elements.size(), 2785u);
  // Gmsh cuts coordinates after eight characters: "-131.160" is -131.1609.
  expect_same_mesh(msh, bdf, 1e-3);
  EXPECT_NEAR(corner_volume(bdf), corner_volume(msh), 2e-5 * corner_volume(msh));
  // The skins have the numbers of their surfaces; those of a bore make up its group.
  std::set<int> ball;
  for (const int node : msh.node_sets.at("BALL")) ball.insert(node);
  std::set<int> found;
  for (const auto& [name, nodes] : bdf.node_sets) {
    if (std::all_of(nodes.begin(), nodes.end(), [&](int n) { return ball.count(n) > 0; })) {
      found.insert(nodes.begin(), nodes.end());
    }
  }
  EXPECT_EQ(found, ball);
  EXPECT_EQ(bdf.element_sets.at("PID 1").size(), 2785u);
  EXPECT_TRUE(has_note(bdf, nastran_file("aarm_coarse.bdf.gz") +
                                ":5689: 240 surfaces and lines of the mesh have no property: they "
                                "only make node sets"));
}

TEST(Nastran, BricksAndWedgesOfSecondOrder) {
  const FeModel bdf = read_fe_file(nastran_file("bricks.bdf.gz"));
  expect_same_mesh(read_fe_file(nastran_file("bricks.msh")), bdf, 1e-7);
  expect_midside_nodes_near_edges(bdf);
  EXPECT_NEAR(corner_volume(bdf), 1.0, 1e-12);
  // The same mesh as a deck of Abaqus.
  expect_same_mesh(read_fe_file(nastran_file("bricks.inp.gz")), bdf, 1e-7);
}

const char* const small_field =
    "SOL 103\n"
    "CEND\n"
    "SPC = 1\n"
    "BEGIN BULK\n"
    "$HMNAME PROP         7\"bracket\" 4\n"
    "$HMNAME MAT          3\"steel\" \"MAT1\"\n"
    "GRID    1               0.      0.      0.\n"
    "GRID    2               1.5-1   0.      0.\n"
    "GRID    3               0.      .2      0.\n"
    "GRID    4               0.      0.      3.D-1           123\n"
    "CTETRA  11      7       1       2       3       4\n"
    "PSOLID  7       3\n"
    "MAT1    3       2.1+11          .3      7850.\n"
    "EIGRL   1                       10\n"
    "PARAM   POST    -1\n"
    "SPC1    1       123     1       THRU    2\n"
    "ENDDATA\n"
    "this is not read\n";

TEST(Nastran, SmallLargeAndFreeField) {
  const std::string large =
      "BEGIN BULK\n"
      "GRID*                  1                              0.              0.\n"
      "*                     0.\n"
      "GRID*                  2                           1.5-1              0.*G2\n"
      "*G2                   0.\n"
      "GRID*   3                               0.              .2              +X\n"
      "+X      0.\n"
      "GRID*                  4                              0.              0.\n"
      "*                    .3                              123\n"
      "CTETRA* 11              7               1               2               +E11\n"
      "*E11    3               4\n"
      "PSOLID  7       3\n"
      "MAT1*   3               2.1E+11                         .3\n"
      "*       7850.\n"
      "SPC1,1,123,1,2\n";
  const std::string free =
      "BEGIN BULK\n"
      "grid,1,,0.,0.,0.\n"
      "GRID, 2, , 1.5-1, 0., 0.   $ a comment\n"
      "GRID*,3,,0.,.2\n"
      "*,0.\n"
      "GRID,4,,0.,0.,.3,,123\n"
      "CTETRA,11,7,1,2,3,\n"
      ",4\n"
      "PSOLID,7,3\n"
      "MAT1,3,2.1+11,,.3,\n"
      "+,7850.\n"
      "SPC1,1,123,1,2\n";
  // In the last card of `free` RHO is the first field of the continuation: not of MAT1's line.
  const std::string free_right = [&] {
    std::string text = free;
    text.replace(text.find("MAT1,3"), std::string("MAT1,3,2.1+11,,.3,\n+,7850.").size(),
                 "MAT1,3,2.1+11,,.3,7850.");
    text.replace(text.find("CTETRA,11"), std::string("CTETRA,11,7,1,2,3,\n,4").size(),
                 "CTETRA,11,7,1,2,3,4");
    return text;
  }();
  const std::string tabs =
      "BEGIN BULK\nGRID\t1\t\t0.\t0.\t0.\nGRID\t2\t\t1.5-1\t0.\t0.\nGRID\t3\t\t0.\t.2\t0.\n"
      "GRID\t4\t\t0.\t0.\t.3\t\t123\nCTETRA\t11\t7\t1\t2\t3\t4\nPSOLID\t7\t3\n"
      "MAT1\t3\t2.1+11\t\t.3\t7850.\nSPC1\t1\t123\t1\t2\n";
  const FeModel first = bulk_model(small_field);
  for (const std::string& text : {std::string(small_field), large, free_right, tabs}) {
    SCOPED_TRACE(text.substr(0, 60));
    const FeModel m = bulk_model(text);
    expect_same_mesh(first, m, 0.0);
    ASSERT_EQ(m.nodes(), 4);
    EXPECT_EQ(m.positions[1], Vec3(0.15, 0, 0));
    EXPECT_EQ(m.positions[3], Vec3(0, 0, 0.3));
    ASSERT_EQ(m.elements.size(), 1u);
    EXPECT_EQ(m.elements[0].id, 11);
    EXPECT_EQ(m.element_sets.at("PID 7"), std::vector<int>{0});
    ASSERT_EQ(m.materials.size(), 1u);
    EXPECT_EQ(m.materials[0].young, 2.1e11);
    EXPECT_EQ(m.materials[0].poisson, 0.3);
    EXPECT_EQ(m.materials[0].density, 7850.0);
    ASSERT_EQ(m.supports.size(), 3u);
    EXPECT_EQ(m.supports[0].node, 0);
    EXPECT_EQ(m.supports[1].node, 1);
    EXPECT_EQ(m.supports[2].node, 3);
    EXPECT_EQ(m.supports[2].mask, 7u);
  }
  EXPECT_EQ(first.element_sets.at("bracket"), std::vector<int>{0});
  EXPECT_EQ(first.material_names[0], "steel");
  EXPECT_EQ(first.elements[0].source.line, 11);
  ASSERT_EQ(first.notes.size(), 1u);
  EXPECT_EQ(first.notes[0],
            "deck.bdf: cards that change neither stiffness nor mass are ignored: EIGRL, PARAM");
}

TEST(Nastran, SetsOfPreprocessors) {
  const FeModel m = bulk_model(
      "$HMSET        5        1 \"BORE\" 17\n"
      "SET     5       GRID    LIST\n"
      "+       3       1       THRU    2\n"
      "SET     6       ELEM    LIST\n"
      "+       11\n"
      "SET1,7,4,1,4\nSET1,8,11\nSET3,9,GRID,2,4\nSET,10,PROP,LIST\n,7\n" +
      std::string(small_field).substr(std::string(small_field).find("$HMNAME")));
  EXPECT_EQ(m.node_sets.at("BORE"), (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(m.element_sets.at("SET 6"), std::vector<int>{0});
  EXPECT_EQ(m.node_sets.at("SET 7"), (std::vector<int>{3, 0}));
  EXPECT_EQ(m.node_sets.count("SET 8"), 0u);  // 11 is no node
  EXPECT_EQ(m.node_sets.at("SET 9"), (std::vector<int>{1, 3}));
  EXPECT_EQ(m.notes[0],
            "deck.bdf: cards that change neither stiffness nor mass are ignored: EIGRL, PARAM, "
            "SET of other things");
}

TEST(Nastran, CoordinateSystems) {
  // System 2 in system 1 (turned about z by 90 degrees, moved to (1, 0, 0)), cylindrical.
  const FeModel m = bulk_model(
      "CORD2R,1,,1.,0.,0.,1.,0.,1.\n,1.,1.,0.\n"
      "CORD2C,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "CORD2S,3,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "GRDSET,,2\n"
      "GRID,1,1,2.,0.,5.\nGRID,2,,2.,90.,3.\nGRID,3,0,1.,2.,3.\nGRID,4,3,2.,30.,90.\n"
      "CTETRA,1,1,1,2,3,4\nPSOLID,1,1\nMAT1,1,1.,,0.,1.\n");
  EXPECT_LT((m.positions[0] - Vec3(1, 2, 5)).norm(), 1e-14);
  EXPECT_LT((m.positions[1] - Vec3(-1, 0, 3)).norm(), 1e-14);
  EXPECT_EQ(m.positions[2], Vec3(1, 2, 3));
  EXPECT_LT((m.positions[3] - Vec3(0, 1, std::sqrt(3.0))).norm(), 1e-14);
}

TEST(Nastran, MaterialsBarsAndShells) {
  const FeModel m = bulk_model(
      "PARAM,WTMASS,.001\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\n"
      "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,2,2,3,5\nCBEAM,3,3,3,4,0.,0.,1.\nCBAR,4,4,4,1,0.,0.,1.\n"
      "CBAR,6,6,1,3,0.,0.,1.\nCBAR,7,7,2,4,0.,0.,1.\n"
      "CQUAD4,5,5,1,2,3,4\nCTRIA3,8,5,1,2,5\n"
      "PBAR,1,1,4.-4,2.-8,1.-8,3.-8,.5\n"
      "PBARL,2,2,,BAR\n,.02,.04\n"
      "PBEAM,3,3,4.-4,2.-8,1.-8,,3.-8\n,,,,,,,,\n,NO,1.\n"
      "PBARL,4,1,,TUBE\n,.02,.015\n"
      "PBARL,6,1,,BOX\n,.03,.05,.002,.003\n"
      "PBARL,7,1,,ROD\n,.01\n"
      "PSHELL,5,1,.002,1,,1\n"
      "MAT1,1,2.1+11,,.3,7850.\nMAT1,2,7.+10,2.6923077+10,,2700.\nMAT1,3,,4.+10,.25,1000.\n");
  ASSERT_EQ(m.elements.size(), 8u);
  const auto section = [&m](std::size_t e) { return m.sections[m.elements[e].section]; };
  const auto material = [&m](std::size_t e) { return m.materials[m.elements[e].material]; };
  // I1 bends in the plane of the orientation vector: about the local z axis.
  EXPECT_EQ(section(0).Iz, 2e-8);
  EXPECT_EQ(section(0).Iy, 1e-8);
  EXPECT_EQ(section(0).J, 3e-8);
  EXPECT_EQ(m.elements[0].reference, Vec3::UnitZ());
  EXPECT_NEAR(material(0).density, (7850.0 + 0.5 / 4e-4) * 1e-3, 1e-12);  // with NSM and WTMASS
  EXPECT_LT((m.elements[1].reference - Vec3(-1, 0, 1)).norm(), 1e-15);    // node 5 from node 2
  EXPECT_NEAR(section(1).Iz, 0.02 * std::pow(0.04, 3) / 12.0, 1e-20);
  EXPECT_NEAR(section(1).Iy, 0.04 * std::pow(0.02, 3) / 12.0, 1e-20);
  EXPECT_NEAR(material(1).poisson, 0.3, 1e-6);
  EXPECT_EQ(section(2).A, 4e-4);
  EXPECT_NEAR(material(2).young, 2.0 * 1.25 * 4e10, 1e-3);
  EXPECT_NEAR(section(3).A, std::numbers::pi * (0.02 * 0.02 - 0.015 * 0.015), 1e-16);
  EXPECT_NEAR(section(4).A, 0.03 * 0.05 - 0.024 * 0.046, 1e-16);
  EXPECT_NEAR(section(4).Iz, (0.03 * std::pow(0.05, 3) - 0.024 * std::pow(0.046, 3)) / 12, 1e-20);
  EXPECT_NEAR(section(5).J, std::numbers::pi * std::pow(0.02, 4) / 32, 1e-20);
  EXPECT_EQ(m.elements[6].type, FeElementType::quad4);
  EXPECT_EQ(m.elements[7].type, FeElementType::tri3);
  ASSERT_EQ(m.shells.size(), 1u);
  EXPECT_EQ(m.shells[0].thickness, 0.002);
}

TEST(Nastran, HexahedraAsNastranIntegratesThem) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
      "CHEXA,1,1,1,2,3,4,5,6\n,7,8\n";
  const std::string material = "MAT1,1,1.,,0.,1.\n";
  EXPECT_EQ(bulk_model(nodes + "PSOLID,1,1\n" + material).elements[0].type, FeElementType::hex8i);
  EXPECT_EQ(bulk_model(nodes + "PSOLID,1,1,,TWO,,FULL\n" + material).elements[0].type,
            FeElementType::hex8);
  // A mesh alone is as that of other formats.
  EXPECT_EQ(bulk_model(nodes).elements[0].type, FeElementType::hex8);
  EXPECT_EQ(bulk_model(nodes).elements[0].material, -1);
  FeReadOptions options;
  options.material = Material{1.0, 0.3, 2.0};
  EXPECT_EQ(bulk_model(nodes, options).materials[0].density, 2.0);
}

const char* const bar_deck =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,.5,0.\nGRID,4,,1.,-.5,0.\n"
    "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,1.-3,1.-7,1.-7,2.-7\nMAT1,1,2.+11,,.3,8000.\n";

/// Kinetic energy of rigid motions of the assembled model.
Mat6 rigid_mass(const FeModel& model) {
  const FeSystem system = assemble(model);
  MatX R(system.size(), 6);
  for (int i = 0; i < system.size(); ++i) {
    const Dof d = system.dofs[i];
    const Vec3 p = model.positions[d.node];
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = Vec3::Unit(k), u = e.cross(p);
      R(i, k) = d.axis < 3 ? e(d.axis) : 0.0;
      R(i, 3 + k) = d.axis < 3 ? u(d.axis) : e(d.axis - 3);
    }
  }
  return R.transpose() * (system.M * R);
}

TEST(Nastran, MassesAndRigidElements) {
  const Mat6 bar = rigid_mass(bulk_model(bar_deck));
  // A mass of 2 kg, 0.1 beside node 2, with inertia about its centre; the bar weighs 8 kg.
  const FeModel m = bulk_model(std::string(bar_deck) +
                               "CONM2,9,2,,2.,.1,.2,.3,,\n,.01,.002,.03,-.001,.004,.05\n");
  const Mat6 with = rigid_mass(m) - bar;
  const Vec3 c(1.1, 0.2, 0.3);
  Mat3 J;
  J << 0.01, -0.002, 0.001, -0.002, 0.03, -0.004, 0.001, -0.004, 0.05;
  EXPECT_LT((with.topLeftCorner<3, 3>() - 2.0 * Mat3::Identity()).norm(), 1e-12);
  EXPECT_LT((with.block<3, 3>(3, 0) - 2.0 * skew(c)).norm(), 1e-12);
  EXPECT_LT((with.bottomRightCorner<3, 3>() - J - 2.0 * skew(c).transpose() * skew(c)).norm(),
            1e-12);

  // The mass on two nodes that a rigid element ties to node 2.
  const FeModel rigid = bulk_model(std::string(bar_deck) +
                                   "RBE2,20,2,123456,3,4,1.2-5\nCONM2,9,3,,1.5\nCONM2,10,4,,1.5\n");
  ASSERT_EQ(rigid.spiders.size(), 1u);
  EXPECT_EQ(rigid.spiders[0].reference, 1);
  EXPECT_EQ(rigid.spiders[0].nodes, (std::vector<int>{2, 3}));
  EXPECT_EQ(rigid.spiders[0].name, "RBE2 20");
  const Mat6 two = rigid_mass(rigid) - bar;
  EXPECT_NEAR(two(0, 0), 3.0, 1e-12);
  EXPECT_NEAR(two(5, 5), 2.0 * 1.5 * 1.25, 1e-12);
}

TEST(Nastran, AveragingElementsAndEquations) {
  const FeModel m = bulk_model(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nGRID,9,,.2,.2,.2\n"
      "CTETRA,1,1,1,2,3,4\nPSOLID,1,1\nMAT1,1,1.,,0.,1.\n"
      "RBE3,5,,9,123456,1.,123,1,2,\n,3,2.5,123,4,ALPHA,1.-5\n"
      "MPC,8,1,1,1.,2,1,-.5,\n,,3,2,-.5\n"
      "RBAR,6,1,2,123456\n");
  ASSERT_EQ(m.spiders.size(), 2u);
  EXPECT_EQ(m.spiders[0].reference, 0);
  EXPECT_EQ(m.spiders[1].kind, Spider::Kind::mean);
  EXPECT_EQ(m.spiders[1].reference, 4);
  EXPECT_EQ(m.spiders[1].nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(m.spiders[1].weights, (std::vector<double>{1.0, 1.0, 1.0, 2.5}));
  ASSERT_EQ(m.equations.size(), 1u);
  ASSERT_EQ(m.equations[0].terms.size(), 3u);
  EXPECT_EQ(m.equations[0].terms[2].node, 2);
  EXPECT_EQ(m.equations[0].terms[2].axis, 1);
  EXPECT_EQ(m.equations[0].terms[2].factor, -0.5);
}

TEST(Nastran, IncludedFiles) {
  const TemporaryFolder folder;
  const std::string text = small_field;
  const std::size_t begin = text.find("GRID"), end = text.find("CTETRA");
  folder.write("mesh/nodes.dat", text.substr(begin, end - begin));
  folder.write("arm.bdf",
               text.substr(0, begin) + "INCLUDE 'mesh/\n   nodes.dat'\n" + text.substr(end));
  const FeModel m = read_fe_file(folder / "arm.bdf");
  expect_same_mesh(bulk_model(small_field), m, 0.0);
  ASSERT_EQ(m.files.size(), 2u);
  EXPECT_EQ(m.node_sources[3].file, 1);
  EXPECT_EQ(m.node_sources[3].line, 4);
  EXPECT_EQ(m.elements[0].source.line, 9);
}

struct Matrices {
  MatX K, M;
  std::vector<std::pair<int, int>> dofs;
};

/// Two nodes with six and one with three degrees of freedom.
Matrices random_matrices() {
  Random random(17);
  Matrices m;
  for (const int node : {3, 11, 20}) {
    for (int c = 1; c <= (node == 20 ? 3 : 6); ++c) m.dofs.emplace_back(node, c);
  }
  const int n = static_cast<int>(m.dofs.size());
  const MatX A = random.matrix(n, n), B = random.matrix(n, n);
  m.K = 1e6 * A * A.transpose();
  m.M = B * B.transpose();
  m.M.col(14).setZero();
  m.M.row(14).setZero();
  return m;
}

std::string punch(const std::string& name, const MatX& A, const Matrices& m) {
  std::string text = fmt::format("DMIG    {:<8}{:8}{:8}{:8}{:8}{:24}\n", name, 0, 6, 2, 0, 15);
  for (int j = 0; j < A.cols(); ++j) {
    const auto& [node, component] = m.dofs[j];
    text += fmt::format("DMIG*   {:<16}{:16}{:16}\n", name, node, component);
    for (int i = 0; i <= j; ++i) {
      if (A(i, j) == 0.0) continue;
      std::string value = fmt::format("{:16.9E}", A(i, j));
      std::replace(value.begin(), value.end(), 'E', 'D');
      const auto& [row, row_component] = m.dofs[i];
      text += fmt::format("*       {:16}{:16}{}\n", row, row_component, value);
    }
  }
  return text;
}

const char* const punch_nodes = "GRID,3,,0.,0.,0.\nGRID,20,,1.,2.,3.\nGRID,11,,1.,0.,0.\n";

FeModel read_punch(const std::string& text) {
  TextSource nodes(punch_nodes, "nodes.bdf"), source(text, "arm.pch");
  return read_dmig(source, nullptr, read_nastran(nodes, false, {}, NastranPart::nodes));
}

TEST(Dmig, RoundTrip) {
  const Matrices m = random_matrices();
  const std::string text = "$ punched\n" + punch("KAAX", m.K, m) + punch("MAAX", m.M, m) +
                           punch("BAAX", 0.5 * m.M, m) + punch("K4AAX", m.K, m);
  EXPECT_TRUE(looks_like_dmig(text));
  EXPECT_FALSE(looks_like_nastran(text));
  const FeModel model = read_punch(text);
  ASSERT_TRUE(model.matrices);
  EXPECT_LT((MatX(model.matrices->K) - m.K).cwiseAbs().maxCoeff(),
            1e-9 * m.K.cwiseAbs().maxCoeff());
  EXPECT_LT((MatX(model.matrices->M) - m.M).cwiseAbs().maxCoeff(),
            1e-9 * m.M.cwiseAbs().maxCoeff());
  EXPECT_LT((MatX(model.matrices->C) - 0.5 * m.M).cwiseAbs().maxCoeff(),
            1e-9 * m.M.cwiseAbs().maxCoeff());
  ASSERT_EQ(model.matrices->dofs.size(), 15u);
  EXPECT_EQ(model.matrices->dofs[6].node, 2);  // node 11
  EXPECT_EQ(model.matrices->dofs[14].node, 1);
  EXPECT_EQ(model.matrices->dofs[14].axis, 2);
  EXPECT_EQ(model.positions[1], Vec3(1, 2, 3));
  EXPECT_EQ(model.notes.back(),
            "arm.pch: matrices that are neither stiffness, mass nor viscous damping are ignored: "
            "K4AAX");
}

TEST(Dmig, NodesInTheFileOrInAnother) {
  const TemporaryFolder folder;
  const Matrices m = random_matrices();
  folder.write("arm.pch", punch("KAAX", m.K, m));
  folder.write("mass.pch", punch("MAAX", m.M, m));
  FeReadOptions options;
  options.mass = folder / "mass.pch";
  EXPECT_EQ(error_of([&] { read_fe_file(folder / "arm.pch", options); }),
            (folder / "arm.pch").string() + ": missing");
  folder.write("arm.bdf", punch_nodes);
  const FeModel beside = read_fe_file(folder / "arm.pch", options);
  EXPECT_EQ(beside.positions[1], Vec3(1, 2, 3));
  folder.write("whole.pch", punch_nodes + punch("KAAX", m.K, m) + punch("MAAX", m.M, m));
  const FeModel whole = read_fe_file(folder / "whole.pch");
  ASSERT_TRUE(beside.matrices && whole.matrices);
  EXPECT_EQ(MatX(whole.matrices->K), MatX(beside.matrices->K));
  EXPECT_EQ(MatX(whole.matrices->M), MatX(beside.matrices->M));
  EXPECT_EQ(whole.matrices->C.size(), 0);
  folder.write("damping.pch", punch("B2GG", m.M, m));
  options.damping_matrix = folder / "damping.pch";
  const FeModel damped = read_fe_file(folder / "arm.pch", options);
  EXPECT_EQ(MatX(damped.matrices->C), MatX(beside.matrices->M));
}

}  // namespace
}  // namespace floatframe::test

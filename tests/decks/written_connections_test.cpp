// Connections of decks written for CalculiX: springs, beams beside their nodes, what it would lose.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "decks/deck_text.hpp"
#include "decks/written_mesh.hpp"

namespace floatframe::test {
namespace {

/// Two bricks with springs along lines, along axes and, of two different directions, between
/// further nodes.
constexpr const char* sprung_bricks =
    "*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,0,0,10\n6,10,0,10\n7,10,10,10\n8,0,10,10\n"
    "11,13,2,1\n12,23,2,1\n13,23,12,1\n14,13,12,1\n15,13,2,11\n16,23,2,11\n17,23,12,11\n"
    "18,13,12,11\n*ELEMENT, TYPE=C3D8, ELSET=E\n1,1,2,3,4,5,6,7,8\n2,11,12,13,14,15,16,17,18\n"
    "*MATERIAL, NAME=S\n*ELASTIC\n210000.,0.3\n*DENSITY\n7.85e-9\n"
    "*SOLID SECTION, ELSET=E, MATERIAL=S\n*ELEMENT, TYPE=SPRINGA, ELSET=A\n101,2,11\n102,3,14\n"
    "103,6,15\n104,7,18\n105,7,11\n106,3,15\n107,2,14\n*SPRING, ELSET=A\n\n1000.\n"
    "*ELEMENT, TYPE=SPRING2, ELSET=B\n121,2,11\n122,3,14\n*SPRING, ELSET=B\n2,2\n500.\n"
    "*ELEMENT, TYPE=SPRING2, ELSET=C\n123,2,12\n*SPRING, ELSET=C\n3,2\n50.\n";

TEST(WrittenConnections, SpringsOfAllDirections) {
  const TemporaryFolder folder;
  FeModel model =
      read_fe_file(folder.write("sprung.inp", sprung_bricks), of_dialect(DeckDialect::calculix));
  ASSERT_EQ(model.springs.size(), 10u);
  const FeModel same = there_and_back(model, ".inp");
  EXPECT_EQ(same.springs.size(), 10u);
  EXPECT_EQ(same.nodes(), model.nodes());
  expect_same_system(model, same);
  // CalculiX 2.20, the eigenvalues of the stiffness and mass that it stores of the written deck.
  const FeSystem system = assemble(model, Integration::ccx);
  const MatX K(system.K), M(system.M);
  const VecX l =
      Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
  const double calculix[] = {336.540262, 948.356671, 1937.163565, 3461.297428, 5011.390405};
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(std::sqrt(l(k + 4)) / (2.0 * std::numbers::pi), calculix[k], 1e-6) << k;

  // Any direction: as a bushing in its own axes has them, at nodes that rigid spiders move too.
  model.springs[0].directions[0] << -0.36, -0.48, -0.8, 0.0, 0.0, 0.0;
  model.springs[0].directions[1] << 0.36, 0.48, 0.8, 0.0, 0.0, 0.0;
  model.springs[1].directions[1] << 0.0, 0.6, 0.8, 0.0, 0.0, 0.0;
  model.spiders.push_back(
      {.name = "R", .reference = 0, .nodes = {1, 2, 3}, .weights = {}, .source = {}});
  model.springs[2].nodes = {0, 9};
  model.springs[2].directions[0] << 0.0, 0.0, 0.0, 0.6, 0.8, 0.0;
  const FeModel turned = there_and_back(model, ".inp");
  EXPECT_GT(turned.nodes(), model.nodes());
  const FeSystem a = assemble(model, Integration::ccx), b = assemble(turned, Integration::ccx);
  const auto eigenvalues = [](const FeSystem& s) {
    return VecX(
        Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(MatX(s.K), MatX(s.M), Eigen::EigenvaluesOnly)
            .eigenvalues());
  };
  const VecX la = eigenvalues(a), lb = eigenvalues(b);
  ASSERT_EQ(la.size(), lb.size());
  EXPECT_LT((la - lb).cwiseAbs().maxCoeff(), 1e-11 * la.maxCoeff());
  EXPECT_LT(std::abs(la(6) / lb(6) - 1.0), 1e-6);

  // A massless node between springs, and one that a spring alone holds: they are left out.
  model.positions.emplace_back(12.0, 9.0, 9.0);
  model.positions.emplace_back(-5.0, 0.0, 0.0);
  model.node_ids.push_back(200);
  model.node_ids.push_back(201);
  const int between = model.nodes() - 2;
  for (const int other : {6, 14, 15, 8}) {
    Spring s;
    s.nodes = {between, other};
    const Vec3 e = (model.positions[other] - model.positions[between]).normalized();
    s.directions[0].head<3>() = -e;
    s.directions[1].head<3>() = e;
    s.stiffness = 300.0 + other;
    model.springs.push_back(s);
  }
  model.springs[0].nodes[0] = model.nodes() - 1;
  const VecX lc = eigenvalues(assemble(model, Integration::ccx));
  const VecX ld = eigenvalues(assemble(there_and_back(model, ".inp"), Integration::ccx));
  ASSERT_EQ(lc.size(), ld.size());
  EXPECT_LT((lc - ld).cwiseAbs().maxCoeff(), 1e-11 * lc.maxCoeff());
  EXPECT_LT(std::abs(lc(6) / ld(6) - 1.0), 1e-6);
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "5 springs that massless nodes or rotations of solids have an end at: the "
                       "stiffness between the others is written, as springs of further nodes\n"));

  // A node that an equation moves.
  for (int axis = 0; axis < 3; ++axis) {
    LinearEquation equation;
    equation.terms = {{model.nodes() - 1, axis, 1.0}, {0, axis, -1.0}};
    model.equations.push_back(equation);
  }
  EXPECT_EQ(error_of([&] { written(model, ".inp"); }),
            folder.path().string() + "/sprung.inp:28: unsupported");
}

/// A frame of two legs of 0.6 m; the second has the offsets `words`.
std::string two_legs(const std::string& words, const std::string& further = "") {
  std::string text = "*NODE\n";
  for (int k = 0; k <= 12; ++k) text += fmt::format("{}, {}, 0., 0.\n", k + 1, 0.05 * k);
  for (int k = 1; k <= 12; ++k) text += fmt::format("{}, 0.6, {}, 0.\n", 13 + k, 0.05 * k);
  text += "*ELEMENT, TYPE=B32, ELSET=A\n";
  for (int e = 0; e < 6; ++e)
    text += fmt::format("{}, {}, {}, {}\n", e + 1, 2 * e + 1, 2 * e + 2, 2 * e + 3);
  text += "*ELEMENT, TYPE=B32, ELSET=B\n";
  for (int e = 6; e < 12; ++e)
    text += fmt::format("{}, {}, {}, {}\n", e + 1, 2 * e + 1, 2 * e + 2, 2 * e + 3);
  text += "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, .3\n*DENSITY\n7800.\n";
  text += "*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=RECT\n.02, .03\n0., 1., 0.\n";
  text += "*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=RECT" + words + "\n.02, .03\n1., 0., 0.\n";
  return text + further;
}

FeModel legs_model(const std::string& words, const std::string& further = "") {
  const TemporaryFolder folder;
  return read_fe_file(folder.write("frame.inp", two_legs(words, further)),
                      of_dialect(DeckDialect::calculix));
}

int count_of(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

// CalculiX 2.20 finds the same frequencies in the deck and in the written one (57.05754, 229.0906,
// 307.3343, 338.1722 Hz); with the arms as equations the legs came loose from each other.
TEST(WrittenConnections, OffsetBeamsAreThoseOfCalculix) {
  const FeModel model = legs_model(", OFFSET1=2, OFFSET2=-1");
  EXPECT_EQ(model.nodes(), 38);
  const std::string text = written(model, ".inp").bytes;
  EXPECT_EQ(count_of(text, "SECTION=RECT, OFFSET1=2, OFFSET2=-1\n"), 1);
  EXPECT_EQ(count_of(text, "SECTION=RECT\n"), 1);
  EXPECT_EQ(count_of(text, "*EQUATION"), 0);
  const FeModel same = there_and_back(model, ".inp");
  EXPECT_EQ(same.nodes(), model.nodes());
  expect_same_system(model, same);
  // Beams without rotations of other nodes: by spiders.
  const FeModel all = legs_model(", OFFSET2=0.25");
  expect_same_system(all, there_and_back(all, ".inp"));
}

TEST(WrittenConnections, ArmsThatOffsetsCannotExpressAreRefused) {
  const FeModel model = legs_model(", OFFSET1=2");
  const auto refusal = [](const FeModel& m) { return error_of([&] { written(m, ".inp"); }); };
  // One end is moved along the beam.
  FeModel askew = model;
  askew.positions.back().y() += 0.01;
  EXPECT_EQ(test::without_folders(refusal(askew)), "frame.inp:35: unsupported");
  // CalculiX lets what sits at a node act on the beam beside it: a mass there, or at the end.
  for (const int node : {24, model.nodes() - 1}) {
    FeModel weighted = model;
    weighted.masses.push_back({node, 2.0, Mat3::Zero()});
    EXPECT_EQ(test::without_folders(refusal(weighted)), "frame.inp:35: unsupported");
  }
  FeModel tied = model;
  tied.equations.push_back({.terms = {{24, 0, 1.0}, {0, 0, -1.0}}, .source = {}});
  EXPECT_EQ(test::without_folders(refusal(tied)), "frame.inp:35: unsupported");
  // The rotation of a beam in an equation, a spider, a spring.
  FeModel equation = legs_model("");
  equation.equations.push_back({.terms = {{0, 4, 1.0}, {5, 4, -1.0}}, .source = {}});
  EXPECT_EQ(test::without_folders(refusal(equation)), "unsupported");
  FeModel spider = legs_model("");
  spider.positions.emplace_back(0.0, 0.0, 0.1);
  spider.node_ids.push_back(99);
  spider.node_sources.emplace_back();
  Spider arm;
  arm.reference = spider.nodes() - 1;
  arm.nodes = {0};
  spider.spiders.push_back(arm);
  EXPECT_EQ(test::without_folders(refusal(spider)), "unsupported");
  FeModel sprung = legs_model("");
  Spring s;
  s.nodes = {0, 24};
  s.directions[0] = -Vec6::Unit(3);
  s.directions[1] = Vec6::Unit(3);
  s.stiffness = 10.0;
  sprung.springs.push_back(s);
  EXPECT_EQ(test::without_folders(refusal(sprung)), "unsupported");
}

// A beam between two bricks: its turn about itself.
TEST(WrittenConnections, StraightBeamsTurn) {
  const TemporaryFolder folder;
  const std::string bricks =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
      "*ELEMENT,TYPE=C3D8,ELSET=S\n1,1,2,3,4,5,6,7,8\n*ELEMENT,TYPE=B31,ELSET=B\n2,5,6\n"
      "*MATERIAL,NAME=M\n*ELASTIC\n2e11,.3\n*DENSITY\n7800.\n*SOLID SECTION,ELSET=S,MATERIAL=M\n"
      "*BEAM SECTION,ELSET=B,MATERIAL=M,SECTION=RECT\n.02,.03\n0.,1.,0.\n";
  const FeModel model =
      read_fe_file(folder.write("bar.inp", bricks), of_dialect(DeckDialect::calculix));
  EXPECT_EQ(count_of(written(model, ".inp").bytes, "*EQUATION"), 0);
  EXPECT_TRUE(contains(written_notes(model, ".inp"),
                       "1 straight group of beams can turn about the line that holds them: nodes "
                       "without rotations; that is a frequency of zero of each in CalculiX\n"));
}

// u1 = 2 u2 holds a part that moves along x; rigid spiders do not.
TEST(WrittenConnections, EquationsThatHoldThePartHaveANote) {
  const auto bricks = [](const std::string& more) {
    const TemporaryFolder folder;
    return written_notes(read_fe_file(folder.write("a.inp", sprung_bricks + more),
                                      of_dialect(DeckDialect::calculix)),
                         ".inp");
  };
  const std::string words = "equations of the model that rigid motions do not satisfy";
  EXPECT_TRUE(
      contains(bricks("*EQUATION\n2\n1, 1, 1., 2, 1, -2.\n"),
               "1 direction is bound by " + words + ": the part is not free; first: node 1 ux"));
  for (const char* rigid : {"", "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n",
                            "*NODE\n99, 5, 5, 5\n*RIGID BODY, NSET=R, REF NODE=99\n*NSET, NSET=R\n"
                            "1, 2, 3\n"})
    EXPECT_FALSE(contains(bricks(rigid), words)) << rigid;
}

}  // namespace
}  // namespace floatframe::test

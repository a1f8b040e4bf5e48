// Abaqus decks of assemblies: several parts, several instances of a part, moved and turned, against
// the same mesh written flat; faulty assemblies with their errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

FeModel assembly_of(const std::string& text, const FeReadOptions& options = {}) {
  return read_inp(text, options, "a.inp");
}

std::string assembly_error(const std::string& text) {
  return error_of([&] { assembly_of(text); });
}

/// A brick of 2 x 1 x 1 with an orthotropic material in axes of its own, sets and surfaces.
const std::string brick_lines =
    "*Node\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 2, 0, 1\n7, 2, 1, 1\n"
    "8, 0, 1, 1\n*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Nset, nset=END\n2, 3, 6, 7\n"
    "*Nset, nset=ROOT\n1, 4, 5, 8\n*Elset, elset=ALL\n1\n*Surface, type=ELEMENT, name=FACE\nALL, "
    "S4\n"
    "*Surface, type=ELEMENT, name=BACK\nALL, S6\n"
    "*Orientation, name=ORI\n1, 1, 0, 0, 1, 0\n3, 10\n"
    "*Solid Section, elset=ALL, orientation=ORI, material=WOOD\n,\n";
const std::string wood =
    "*Material, name=WOOD\n*Density\n5e-10,\n*Elastic, type=ENGINEERING CONSTANTS\n12000, 900, "
    "600, "
    ".4, .35, .3, 700, 650\n80,\n";

/// The mesh of an instance written flat: nodes placed, numbers moved, the orientation turned.
std::string flat_brick(int first, const Mat3& R, const Vec3& t) {
  std::string text = "*Node\n";
  for (int k = 0; k < 8; ++k) {
    const Vec3 p = R * Vec3(k % 4 == 1 || k % 4 == 2 ? 2 : 0, k % 4 > 1 ? 1 : 0, k / 4) + t;
    text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", first + k, p.x(), p.y(), p.z());
  }
  text += fmt::format("*Element, type=C3D8\n{}", first);
  for (int k = 0; k < 8; ++k) text += fmt::format(", {}", first + k);
  const Vec3 a = R * Vec3(1, 1, 0) + t, b = R * Vec3(0, 1, 0) + t;
  return text + fmt::format(
                    "\n*Elset, elset=ALL{0}\n{0}\n*Orientation, name=ORI{0}\n{1:.17g}, {2:.17g}, "
                    "{3:.17g}, {4:.17g}, {5:.17g}, {6:.17g}, {7:.17g}, {8:.17g}, {9:.17g}\n"
                    "3, 10\n*Solid Section, elset=ALL{0}, orientation=ORI{0}, material=WOOD\n,\n",
                    first, a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), t.x(), t.y(), t.z());
}

void expect_same_matrices(const FeModel& a, const FeModel& b) {
  ASSERT_EQ(a.nodes(), b.nodes());
  for (int k = 0; k < a.nodes(); ++k)
    EXPECT_LE((a.positions[k] - b.positions[k]).norm(), 1e-13) << k;
  const SparseMatrix K = assemble_stiffness(b), M = assemble_mass(b, false, 3);
  EXPECT_LE((assemble_stiffness(a) - K).norm(), 1e-12 * K.norm());
  EXPECT_LE((assemble_mass(a, false, 3) - M).norm(), 1e-13 * M.norm());
}

TEST(DeckAssembly, APartTwiceOnceTurnedAboutAnOffsetAxis) {
  const std::string deck =
      "*Heading\n*Part, name=BRICK\n" + brick_lines +
      "*End Part\n*Assembly, name=A\n*Instance, name=BRICK-1, part=BRICK\n*End Instance\n"
      "*Instance, name=BRICK-2, part=BRICK\n3, 4, 5\n1, 2, 0, 1, 2, 1, 90\n*End Instance\n"
      "*Instance, name=BRICK-3, part=BRICK\n0, 0, 7\n*End Instance\n"
      "*Nset, nset=TIP, instance=BRICK-2\n2, 3\n*Nset, nset=BOTH\nBRICK-1.END, BRICK-2.END\n"
      "*Node\n1, 9, 9, 9\n*Nset, nset=MASTER\n1\n"
      "*Rigid Body, ref node=MASTER, tie nset=BOTH\n"
      "*Equation\n2\nBRICK-3.2, 1, 1., BRICK-3.3, 1, -1.\n*End Assembly\n" +
      wood + "*Boundary\nBRICK-1.ROOT, 1, 3\n";
  const FeModel m = assembly_of(deck);
  const Mat3 R = Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitZ()).toRotationMatrix();
  const Vec3 a(1, 2, 0);
  FeModel flat = assembly_of(flat_brick(1, Mat3::Identity(), Vec3::Zero()) +
                                 flat_brick(11, R, R * (Vec3(3, 4, 5) - a) + a) +
                                 flat_brick(21, Mat3::Identity(), Vec3(0, 0, 7)) +
                                 "*Node\n31, 9, 9, 9\n" + wood,
                             of_dialect(DeckDialect::abaqus));  // whose masses are lumped
  expect_same_matrices(m, flat);
  EXPECT_EQ(m.node_label(9), "node 'BRICK-2.2'");
  EXPECT_EQ(m.element_label(1), "element BRICK-2.1 (C3D8)");
  const std::vector<int>& ids = m.node_ids;
  EXPECT_EQ(std::set<int>(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_EQ(m.node_sets.at("BRICK-2.END"), (std::vector<int>{9, 10, 13, 14}));
  EXPECT_EQ(m.node_sets.at("TIP"), (std::vector<int>{9, 10}));
  EXPECT_EQ(m.node_sets.at("BOTH").size(), 8u);
  EXPECT_EQ(m.element_sets.at("BRICK-3.ALL"), std::vector<int>{2});
  EXPECT_EQ(m.surfaces.at("BRICK-2.FACE")[0].element, 1);
  ASSERT_EQ(m.spiders.size(), 1u);
  EXPECT_EQ(m.spiders[0].reference, 24);
  EXPECT_EQ(m.spiders[0].nodes.size(), 8u);
  ASSERT_EQ(m.equations.size(), 1u);
  EXPECT_EQ(m.equations[0].terms[0].node, 17);
  ASSERT_EQ(m.supports.size(), 4u);
  EXPECT_EQ(m.notes[1],
            "a.inp:4: 8 nodes of instance 'BRICK-2' have numbers of others: they become 9 to 16");
}

/// Sets, sections and orientations of the same names in different parts.
TEST(DeckAssembly, SeveralParts) {
  std::string other = brick_lines;
  other.replace(other.find("3, 10\n"), 6, "3, 40\n");
  const auto part = [](const std::string& name, const std::string& lines) {
    return fmt::format("*Part, name={}\n{}*End Part\n", name, lines);
  };
  const FeModel m =
      assembly_of(part("A", brick_lines) + part("SPARE", brick_lines) + part("B", other) +
                  "*Assembly, name=X\n*Instance, name=ONE, part=A\n*End Instance\n"
                  "*Instance, name=TWO, part=B\n2., 0., 0.\n*End Instance\n"
                  "*Tie, name=T, adjust=no\nTWO.BACK, ONE.FACE\n*End Assembly\n" +
                  wood);
  ASSERT_EQ(m.elements.size(), 2u);
  ASSERT_EQ(m.nodes(), 16);
  EXPECT_EQ(m.positions[8], Vec3(2, 0, 0));
  const auto turn = [&](int e) {
    return m.orientations.at(m.elements.at(e).orientation).turn(1, 0);
  };
  EXPECT_NEAR(turn(0), std::sin(10 * std::acos(-1.0) / 180), 1e-14);
  EXPECT_NEAR(turn(1), std::sin(40 * std::acos(-1.0) / 180), 1e-14);
  EXPECT_EQ(m.equations.size(), 12u);  // four nodes tied
  EXPECT_TRUE(contains(m.notes, "part 'SPARE' has no instance and is left out"));
}

/// Independent instances have their mesh themselves.
TEST(DeckAssembly, MeshesInsideInstances) {
  const FeModel m =
      assembly_of("*Part, name=P\n*End Part\n*Assembly, name=X\n*Instance, name=ONE, part=P\n" +
                  brick_lines + "*End Instance\n*Instance, name=TWO, part=P\n0,0,1\n" +
                  brick_lines + "*End Instance\n*End Assembly\n" + wood);
  EXPECT_EQ(m.elements.size(), 2u);
  EXPECT_EQ(m.positions[8], Vec3(0, 0, 1));
}

TEST(DeckAssembly, FaultyAssemblies) {
  const std::string head = "*Part, name=P\n" + brick_lines + "*End Part\n*Assembly, name=X\n";
  std::string plain = brick_lines;  // without the orientation
  plain.erase(plain.find("*Orientation"),
              plain.find("*Solid Section") - plain.find("*Orientation"));
  plain.erase(plain.find(", orientation=ORI"), 17);
  const int n = 30;  // lines of the part
  const std::string two =
      head +
      "*Instance, name=ONE, part=P\n*End Instance\n*Instance, name=TWO, part=P\n"
      "*End Instance\n";
  const std::map<std::string, std::string> cases = {
      {head + "*Instance, name=ONE, part=Q\n", fmt::format("a.inp:{}: not_found", n)},
      {head + "*Instance, name=ONE, part=P\n*End Instance\n*Instance, name=ONE, part=P\n",
       fmt::format("a.inp:{}: duplicate", n + 2)},
      {head + "*End Assembly\n*Part, name=P\n", fmt::format("a.inp:{}: duplicate", n + 1)},
      {head + "*Instance, name=ONE, part=P\n0,0,0\n1,1,1,1,1,1,30\n",
       fmt::format("a.inp:{}: geometry", n + 2)},
      {head + "*Instance, name=ONE, part=P\n0,0,0\n1,1,1,1,1,2\n",
       fmt::format("a.inp:{}: wrong_count", n + 2)},
      {head + "*Instance, name=ONE, part=P\n*Node\n20, 1, 1, 1\n*End Instance\n"
              "*Instance, name=TWO, part=P\n",
       fmt::format("a.inp:{}: unsupported", n + 4)},
      {two + "*Boundary\nEND, 1\n" + wood, fmt::format("a.inp:{}: duplicate", n + 5)},
      {two + "*Boundary\nTHREE.END, 1\n" + wood, fmt::format("a.inp:{}: not_found", n + 5)},
      {two + "*Boundary\nTWO.99, 1\n" + wood, fmt::format("a.inp:{}: not_found", n + 5)},
      {two + "*Nset, nset=A, instance=THREE\n1\n" + wood,
       fmt::format("a.inp:{}: not_found", n + 4)},
      {two + "*Tie, name=T\nFACE, ONE.BACK\n" + wood, fmt::format("a.inp:{}: duplicate", n + 5)},
      {"*Part, name=P\n" + plain +
           "*End Part\n*Assembly, name=X\n*Instance, name=ONE, part=P\n0, 0, 0\n"
           "0, 0, 0, 0, 0, 1, 90\n*End Instance\n" +
           wood,
       fmt::format("a.inp:{}: contradiction", n - 7)},
      {two + "*Tie, name=T\nONE.12, ONE.BACK\n" + wood, fmt::format("a.inp:{}: not_found", n + 5)},
      {"*Part, name=A\n" + brick_lines + "*End Part\n*Part, name=B\n*End Part\n" + wood,
       fmt::format("a.inp:{}: missing", n - 1)}};
  for (const auto& [text, expected] : cases) {
    const bool assembly = text.find("*Assembly") != std::string::npos;
    const std::string found = assembly_error(text + (assembly ? "*End Assembly\n" : ""));
    EXPECT_EQ(found.substr(0, found.find('\n')), expected) << text;
  }
}

/// Without them things would be of the last instance, or of the assembly.
TEST(DeckAssembly, EveryBlockHasAnEnd) {
  const std::string part = "*Part, name=P\n" + brick_lines, end = "*End Part\n",
                    one = "*Assembly, name=X\n*Instance, name=ONE, part=P\n",
                    two = "*Instance, name=TWO, part=P\n", ends = "*End Instance\n",
                    all = "*End Assembly\n", step = "*Step\n*End Step\n";
  const std::map<std::string, std::string> cases = {
      {part + end + one + ends + all + wood, "no error"},
      {part + wood, "a.inp:1: missing"},
      {part + one + ends + all + wood, "a.inp:1: missing"},
      {part + "*Part, name=Q\n" + end + one + ends + all + wood, "a.inp:1: missing"},
      {part + end + one + all + wood, "a.inp:30: missing"},
      {part + end + one + two + ends + all + wood, "a.inp:30: missing"},
      {part + end + one + ends + wood + step, "a.inp:29: missing"},
      {part + end + end + one + ends + all + wood, "a.inp:29: incomplete"}};
  for (const auto& [text, expected] : cases) EXPECT_EQ(assembly_error(text), expected) << text;
}

/// A short deck may not fill the memory, nor take long.
TEST(DeckAssembly, InstancesAreLimited) {
  std::string deck = "*Part, name=P\n*Node, nset=N\n";
  for (int k = 1; k <= 2100; ++k) deck += fmt::format("{}, {}\n", k, k);
  deck += "*End Part\n*Assembly, name=X\n";
  std::string many = "*Part, name=P\n*Node\n1, 0\n*End Part\n*Assembly, name=X\n";
  for (int k = 0; k < 2001; ++k) {
    const std::string instance = fmt::format("*Instance, name=I{}, part=P\n*End Instance\n", k);
    deck += instance;
    many += instance;
  }
  deck += "*End Assembly\n";
  many += "*End Assembly\n";
  EXPECT_EQ(assembly_error(deck), "a.inp:4011: too_large");
  EXPECT_EQ(assembly_error(many), "a.inp:4006: too_large");
}

}  // namespace
}  // namespace floatframe::test

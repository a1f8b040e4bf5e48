// Beams along shells and beside them: there the turn of the shells about their normal is their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "decks/deck_text.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe::test {
namespace {

// A plate with a rib under its middle line, in axes of its own.
constexpr double plate_length = 1.0, plate_width = 0.6, plate_thickness = 0.01, rib_width = 0.01,
                 rib_height = 0.05;
constexpr double rib_below = -0.5 * (plate_thickness + rib_height);
constexpr double plate_E = 2.1e11, plate_nu = 0.3, plate_G = 0.5 * plate_E / (1.0 + plate_nu);
constexpr int cells_along = 4, cells_across = 2;

const Mat3& plate_axes() {
  static const Mat3 R = rotation_exp(Vec3(0.4, -0.7, 1.1));
  return R;
}

double torsion_constant() { return BeamSection::rectangle(rib_width, rib_height).J; }

int plate_node(int i, int j) { return 1 + i + (cells_along + 1) * j; }

Vec3 plate_place(int i, int j) {
  return plate_axes() *
         Vec3(plate_length * i / cells_along, plate_width * (double(j) / cells_across - 0.5), 0.0);
}

std::string plate_numbers(const Vec3& v) {
  return fmt::format("{:.12g}, {:.12g}, {:.12g}", v(0), v(1), v(2));
}

template <class Line>
std::string plate_nodes(Line line) {
  std::string text;
  for (int j = 0; j <= cells_across; ++j)
    for (int i = 0; i <= cells_along; ++i) text += line(plate_node(i, j), plate_place(i, j));
  return text;
}

template <class Line>
std::string plate_shells(Line line) {
  std::string text;
  for (int j = 0; j < cells_across; ++j)
    for (int i = 0; i < cells_along; ++i)
      text += line(1 + i + cells_along * j, plate_node(i, j), plate_node(i + 1, j),
                   plate_node(i + 1, j + 1), plate_node(i, j + 1));
  return text;
}

/// Large field format: double fields of 16 columns.
std::string wide_card(const std::string& card, const std::vector<std::string>& fields) {
  std::string text = fmt::format("{:<8}", card + "*");
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (k > 0 && k % 4 == 0) text += "\n*       ";
    text += fmt::format("{:<16}", fields[k]);
  }
  return text + "\n" + (fields.size() <= 4 ? "*\n" : "");
}

std::string wide_field(double x) { return fmt::format("{:.9e}", x); }

/// `extra`: cards of more elements.
FeModel nastran_plate(const std::string& property, const std::string& extra = "") {
  std::string text = "BEGIN BULK\n";
  text += plate_nodes([](int id, const Vec3& p) {
    return wide_card(
        "GRID", {std::to_string(id), "", wide_field(p(0)), wide_field(p(1)), wide_field(p(2))});
  });
  text += plate_shells([](int e, int a, int b, int c, int d) {
    return fmt::format("CQUAD4,{},1,{},{},{},{}\n", e, a, b, c, d);
  });
  const Vec3 arm = plate_axes() * Vec3(0.0, 0.0, rib_below),
             up = plate_axes() * Vec3(0.0, 0.0, 1.0);
  const std::string card = property.starts_with("PBAR") ? "CBAR" : "CBEAM";
  for (int i = 0; i < cells_along; ++i) {
    const int j = cells_across / 2;
    text += wide_card(
        card, {std::to_string(100 + i), "2", std::to_string(plate_node(i, j)),
               std::to_string(plate_node(i + 1, j)), wide_field(up(0)), wide_field(up(1)),
               wide_field(up(2)), "", "", "", wide_field(arm(0)), wide_field(arm(1)),
               wide_field(arm(2)), wide_field(arm(0)), wide_field(arm(1)), wide_field(arm(2))});
  }
  text +=
      fmt::format("PSHELL,1,1,{},1\nMAT1,1,2.1e11,,.3,7850.\n", plate_thickness) + property + extra;
  return valid_bdf(text + "ENDDATA\n");
}

std::string rib_property(const std::string& card) {
  const double I1 = rib_width * std::pow(rib_height, 3) / 12.0;
  const double I2 = rib_height * std::pow(rib_width, 3) / 12.0;
  std::vector<std::string> fields{"2", "1", wide_field(rib_width * rib_height), wide_field(I1),
                                  wide_field(I2)};
  if (card == "PBEAM") fields.push_back("");
  fields.push_back(wide_field(torsion_constant()));
  return wide_card(card, fields);
}

FeModel calculix_plate() {
  std::string text = "*NODE\n";
  text += plate_nodes(
      [](int id, const Vec3& p) { return fmt::format("{}, {}\n", id, plate_numbers(p)); });
  text += "*ELEMENT, TYPE=S4, ELSET=PLATE\n";
  text += plate_shells([](int e, int a, int b, int c, int d) {
    return fmt::format("{}, {}, {}, {}, {}\n", e, a, b, c, d);
  });
  text += "*ELEMENT, TYPE=B31, ELSET=RIB\n";
  for (int i = 0; i < cells_along; ++i)
    text += fmt::format("{}, {}, {}\n", 100 + i, plate_node(i, cells_across / 2),
                        plate_node(i + 1, cells_across / 2));
  text += fmt::format(
      "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, .3\n*DENSITY\n7850.\n*SHELL SECTION, ELSET=PLATE, "
      "MATERIAL=M\n{}\n*BEAM SECTION, ELSET=RIB, MATERIAL=M, SECTION=RECT, OFFSET2=0.6\n{}, "
      "{}\n{}\n",
      plate_thickness, rib_width, rib_height, plate_numbers(plate_axes() * Vec3(0.0, 1.0, 0.0)));
  return valid_inp(text, of_dialect(DeckDialect::calculix));
}

/// Energy of the motion in which the plate is twisted and the nodes of the rib turn about the
/// normal as its axis does, over that of thin plate and rib in torsion.
double twist_energy_ratio(const FeModel& m) {
  const double kappa = 1e-3;
  const FeSystem system = assemble(m);
  VecX u = VecX::Zero(system.size());
  for (int k = 0; k < m.nodes(); ++k) {
    const Vec3 p = plate_axes().transpose() * m.positions[k];
    const double x = p(0), y = p(1), z = p(2);
    const Vec3 move = kappa * (plate_axes() * Vec3(-y * z, -x * z, x * y));
    const bool of_rib = std::abs(y) < 1e-9;
    const Vec3 turn = kappa * (plate_axes() * Vec3(x, -y, of_rib ? -rib_below : 0.0));
    for (int axis = 0; axis < 6; ++axis)
      if (system.row(k, axis) >= 0) u(system.row(k, axis)) = axis < 3 ? move(axis) : turn(axis - 3);
  }
  const double plate = plate_width * std::pow(plate_thickness, 3) / 3.0;
  return u.dot(system.K * u) /
         (plate_G * kappa * kappa * plate_length * (plate + torsion_constant()));
}

/// Nodes at which shells have a turn of their own.
std::size_t stiffened_nodes(const FeModel& m) {
  std::set<int> nodes;
  for (const FeElement& e : m.elements)
    for (std::size_t a = 0; a < 4; ++a)
      if (((e.own_drilling >> a) & 1u) != 0) nodes.insert(e.nodes[a]);
  return nodes.size();
}

/// A bar between two nodes of the line of the rib, with pins and an arm at both ends.
std::string more_bar(int from, int to, const std::string& pin, const Vec3& own_arm) {
  const Vec3 arm = plate_axes() * own_arm, up = plate_axes() * Vec3(0.0, 0.0, 1.0);
  return wide_card("CBAR", {"90", "2", std::to_string(from), std::to_string(to), wide_field(up(0)),
                            wide_field(up(1)), wide_field(up(2)), "", pin, "", wide_field(arm(0)),
                            wide_field(arm(1)), wide_field(arm(2)), wide_field(arm(0)),
                            wide_field(arm(1)), wide_field(arm(2))});
}

TEST(Stiffeners, TwistedWithThePlateTheyAreInTorsionOnly) {
  EXPECT_NEAR(twist_energy_ratio(nastran_plate(rib_property("PBAR"))), 1.0, 1e-7);
  EXPECT_NEAR(twist_energy_ratio(nastran_plate(rib_property("PBEAM"))), 1.0, 1e-7);
  EXPECT_NEAR(twist_energy_ratio(calculix_plate()), 1.0, 1e-7);
}

// What else is joined to a node turns with the beam: of the turn of the last node alone its bar
// has 4 EI/L, the shell nothing.
TEST(Stiffeners, TheNodesTurnWithTheBeam) {
  const FeModel m = nastran_plate(rib_property("PBAR"));
  const FeSystem system = assemble(m);
  const int end = plate_node(cells_along, cells_across / 2) - 1;
  VecX u = VecX::Zero(system.size());
  for (int axis = 0; axis < 3; ++axis) u(system.row(end, 3 + axis)) = plate_axes()(axis, 2);
  const double EI = plate_E * rib_height * std::pow(rib_width, 3) / 12.0;
  EXPECT_NEAR(u.dot(system.K * u) / (4.0 * EI / (plate_length / cells_along)), 1.0, 1e-7);
}

TEST(Stiffeners, ANoteCountsTheirNodes) {
  const FeModel m = nastran_plate(rib_property("PBAR"));
  EXPECT_EQ(stiffened_nodes(m), cells_along + 1u);
  EXPECT_TRUE(std::any_of(m.notes.begin(), m.notes.end(), [](const std::string& note) {
    return note.starts_with("at 5 nodes of beams along shells and next to them the shells do not");
  }));
  EXPECT_EQ(stiffened_nodes(calculix_plate()), cells_along + 1u);
}

TEST(Stiffeners, BarsThatDoNotHoldTheNodesChangeNothing) {
  const int from = plate_node(1, cells_across / 2), to = plate_node(2, cells_across / 2);
  for (const char* pin : {"", "6", "456"}) {
    const FeModel m =
        nastran_plate(rib_property("PBAR"), more_bar(from, to, pin, Vec3(0.0, 0.01, -0.04)));
    EXPECT_EQ(stiffened_nodes(m), cells_along + 1u) << pin;
  }
  // Pinned alone none holds.
  const int first = plate_node(1, 0), second = plate_node(2, 0);
  const FeModel m =
      nastran_plate(rib_property("PBAR"), more_bar(first, second, "6", Vec3(0.0, 0.0, rib_below)));
  EXPECT_EQ(stiffened_nodes(m), cells_along + 1u);
}

TEST(Stiffeners, WhereShellsMeetAtAnEdgeTheyResist) {
  // A web on the line of the rib: bent, it resists the turn about the normal of the plate.
  std::string web;
  for (int i = 0; i <= cells_along; ++i) {
    const Vec3 p = plate_place(i, cells_across / 2) + plate_axes() * Vec3(0.0, 0.0, 0.2);
    web += wide_card(
        "GRID", {std::to_string(50 + i), "", wide_field(p(0)), wide_field(p(1)), wide_field(p(2))});
  }
  for (int i = 0; i < cells_along; ++i)
    web += fmt::format("CQUAD4,{},1,{},{},{},{}\n", 60 + i, plate_node(i, cells_across / 2),
                       plate_node(i + 1, cells_across / 2), 51 + i, 50 + i);
  EXPECT_EQ(stiffened_nodes(nastran_plate(rib_property("PBAR"), web)), 0u);
}

TEST(Stiffeners, WhereABeamLeavesTheShellItResists) {
  // A post on the last node of the rib, with and without an offset.
  const Vec3 p = plate_axes() * Vec3(plate_length, 0.0, 0.7);
  const Vec3 side = plate_axes() * Vec3(1.0, 0.0, 0.0);
  for (const double offset : {0.0, rib_below}) {
    const Vec3 arm = plate_axes() * Vec3(0.0, 0.0, offset);
    std::string post =
        wide_card("GRID", {"50", "", wide_field(p(0)), wide_field(p(1)), wide_field(p(2))});
    post +=
        wide_card("CBAR", {"90", "2", std::to_string(plate_node(cells_along, cells_across / 2)),
                           "50", wide_field(side(0)), wide_field(side(1)), wide_field(side(2)), "",
                           "", "", wide_field(arm(0)), wide_field(arm(1)), wide_field(arm(2))});
    EXPECT_EQ(stiffened_nodes(nastran_plate(rib_property("PBAR"), post)), cells_along + 0u);
  }
}

}  // namespace
}  // namespace floatframe::test

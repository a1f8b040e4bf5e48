// Beams of decks whose centroid lies beside their nodes.
#include <gtest/gtest.h>

#include <numbers>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string stick_material =
    "*MATERIAL, NAME=M\n*ELASTIC\n7e10, .25\n*DENSITY\n2700.\n";  // 5 lines

FeModel stick_deck(const std::string& text, DeckDialect dialect = DeckDialect::by_content) {
  return valid_inp(text, of_dialect(dialect), "stick.inp");
}

/// One or two beams of two elements along x on the same nodes; sections of SET1 and SET2.
std::string sticks(const std::string& type, const std::string& sections, bool both = true) {
  const bool three = type.starts_with("B32");
  std::string text =
      "*NODE\n1, 0., 0., 0.\n2, .25, 0., 0.\n3, .5, 0., 0.\n4, .75, 0., 0.\n"
      "5, 1., 0., 0.\n";
  for (const char* set : {"1", "2"}) {
    if (!both && *set == '2') break;
    text += "*ELEMENT, TYPE=" + type + ", ELSET=SET" + set + "\n";
    text += three ? std::string(set) + "1, 1, 2, 3\n" + set + "2, 3, 4, 5\n"
                  : std::string(set) + "1, 1, 3\n" + set + "2, 3, 5\n";
  }
  return text + stick_material + sections;
}

std::string stick_section(const std::string& set, const std::string& offset,
                          const std::string& shape = "RECT", const std::string& size = ".05, .08") {
  return "*BEAM SECTION, ELSET=" + set + ", MATERIAL=M, SECTION=" + shape + offset + "\n" + size +
         "\n0., 1., 0.\n";
}

/// Energy of the nodes' motion: curvature in the plane of x and z, stretch, twist.
double energy(const FeModel& m, double curvature, double stretch, double twist) {
  const FeSystem system = assemble(m);
  VecX u = VecX::Zero(system.size());
  for (int k = 0; k < 5; ++k) {
    if (system.row(k, 0) < 0) continue;
    const double x = m.positions[static_cast<std::size_t>(k)](0);
    u(system.row(k, 0)) = stretch * x;
    u(system.row(k, 2)) = 0.5 * curvature * x * x;
    u(system.row(k, 3)) = twist * x;
    u(system.row(k, 4)) = -curvature * x;
  }
  return u.dot(system.K * u);
}

// CalculiX 2.20 expands this beam about (0, -0.2, -5): nodes 4 to 27 of its results.
TEST(DeckBeamOffsets, WhereCalculixHasTheCentroid) {
  const FeModel m = stick_deck(
      sticks("B32",
             "*BEAM SECTION, ELSET=SET1, MATERIAL=M, SECTION=RECT, OFFSET1=10, OFFSET2=100\n"
             ".02, .05\n0., 1., 0.\n",
             false));
  ASSERT_EQ(m.nodes(), 10);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_LE((m.positions[5 + k] - m.positions[k] - Vec3(0, -.2, -5.)).norm(), 1e-14);
  EXPECT_EQ(m.node_ids[5], 6);
  EXPECT_EQ(m.spiders.size(), 5u);
}

// Two beams on top of each other are one of double height: E (I_1 + I_2 + A_1 e^2 + A_2 e^2).
TEST(DeckBeamOffsets, TwoBeamsAreOneOfDoubleHeight) {
  for (const std::string type : {"B32", "B32R", "B33"}) {
    SCOPED_TRACE(type);
    const FeModel m = stick_deck(sticks(type, stick_section("SET1", ", OFFSET2=-.5") +
                                                  stick_section("SET2", ", OFFSET2=.5")),
                                 DeckDialect::calculix);
    const double I = .05 * std::pow(.16, 3) / 12;
    EXPECT_NEAR(energy(m, 1, 0, 0), 7e10 * I, 1e-9 * 7e10 * I);
    EXPECT_NEAR(energy(m, 0, 1, 0), 7e10 * .05 * .16, 1e-3);
    EXPECT_NEAR(energy(m, 1, 1, 0), 7e10 * (I + .05 * .16), 1e-3);  // no coupling
  }
}

// One alone couples: stretch of the centroid from bending, e = z of the centroid.
TEST(DeckBeamOffsets, CouplesBendingAndStretch) {
  for (const auto& [shape, size, A, I, e] :
       {std::tuple{"RECT", ".05, .08", .05 * .08, .05 * std::pow(.08, 3) / 12, -.02},
        std::tuple{"CIRC", ".06, .08", std::numbers::pi * .06 * .08 / 4,
                   std::numbers::pi * .06 * std::pow(.08, 3) / 64, -.02},
        std::tuple{"PIPE", ".04, .04", std::numbers::pi * .0016,
                   std::numbers::pi * std::pow(.04, 4) / 4, -.02}}) {
    SCOPED_TRACE(shape);
    const FeModel m =
        stick_deck(sticks("B32R", stick_section("SET1", ", OFFSET2=.25", shape, size), false),
                   DeckDialect::calculix);
    const double EA = 7e10 * A, EI = 7e10 * I;
    // The centroid stretches by 1 - e with the curvature 1 and the stretch 1.
    EXPECT_NEAR(energy(m, 1, 1, 0), EI + EA * (1 - e) * (1 - e), 1e-9 * EA);
  }
}

// Nodes that have rotations already are tied by equations: a plate of shells below the beams.
TEST(DeckBeamOffsets, OnShells) {
  const std::string shells =
      "*NODE\n11, 0., 1., 0.\n13, .5, 1., 0.\n15, 1., 1., 0.\n*ELEMENT, TYPE=S4, ELSET=PLATE\n"
      "101, 1, 3, 13, 11\n102, 3, 5, 15, 13\n*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n.01\n";
  const FeModel beside = stick_deck(
      sticks("B31", stick_section("SET1", ", OFFSET2=-.5") + shells, false), DeckDialect::calculix);
  EXPECT_TRUE(beside.spiders.empty());
  EXPECT_EQ(beside.equations.size(), 18u);
  const FeModel alone =
      stick_deck(sticks("B31", stick_section("SET1", "") + shells, false), DeckDialect::calculix);
  const FeSystem a = assemble(beside), b = assemble(alone);
  ASSERT_EQ(a.size(), b.size());
  // Rigid motions stay free.
  for (int axis = 0; axis < 3; ++axis) {
    VecX u = VecX::Zero(a.size());
    for (int k = 0; k < beside.nodes(); ++k) {
      const Vec3 d = Vec3::Unit(axis).cross(beside.positions[static_cast<std::size_t>(k)]);
      for (int i = 0; i < 6; ++i)
        if (const int row = a.row(k, i); row >= 0)
          u(row) = i < 3 ? d(i) : i == 3 + axis ? 1.0 : 0.0;
    }
    EXPECT_LE((a.K * u).norm(), 1e-9 * MatX(a.K).norm());
  }
  EXPECT_NEAR(energy(beside, 1, 0, 0) - energy(alone, 1, 0, 0), 7e10 * .05 * .08 * .04 * .04, 1e-2);
}

TEST(DeckBeamOffsets, NodesOfARigidBodyAndInstances) {
  const FeModel m = stick_deck(
      sticks("B32R",
             stick_section("SET1", ", OFFSET1=1") +
                 "*NODE\n50, 2., 0., 0.\n*NSET, NSET=END\n5\n*RIGID BODY, NSET=END, REF NODE=50\n",
             false),
      DeckDialect::calculix);
  const FeSystem system = assemble(m);
  VecX u = VecX::Zero(system.size());
  for (int k = 0; k < 6; ++k)
    if (system.row(k, 1) >= 0) {
      u(system.row(k, 1)) = m.positions[static_cast<std::size_t>(k)](0);  // a turn about z
      u(system.row(k, 5)) = 1.0;
    }
  EXPECT_LE((system.K * u).norm(), 1e-9 * MatX(system.K).norm());
}

TEST(DeckBeamOffsets, InvalidOffsetsAreErrors) {
  const auto error = [](const std::string& text, DeckDialect dialect) {
    return error_of([&] { stick_deck(sticks("B31", text, false), dialect); });
  };
  EXPECT_EQ(error(stick_section("SET1", ", OFFSET1=left"), DeckDialect::calculix),
            "stick.inp:15: out_of_range");
  EXPECT_EQ(error(stick_section("SET1", ", OFFSET2=.5"), DeckDialect::abaqus),
            "stick.inp:15: unsupported");
  EXPECT_EQ(error("*PREPRINT\n" + stick_section("SET1", ", OFFSET2=.5"), DeckDialect::by_content),
            "stick.inp:16: unsupported");
}

TEST(DeckBeamOffsets, DirectionOneIsAcross) {
  const auto error = [](const std::string& type, const std::string& direction) {
    const std::string section =
        "*BEAM SECTION, ELSET=SET1, MATERIAL=M, SECTION=RECT\n.05, .08\n" + direction;
    return inp_error(sticks(type, section, false), {}, "stick.inp");
  };
  EXPECT_EQ(error("B31", "2., 0., 0.\n"), "stick.inp:15: geometry");
  EXPECT_EQ(error("B32", "2., 0., 0.\n"), "stick.inp:15: geometry");
  EXPECT_EQ(error("B31", "2., .1, 0.\n"), "no error");
}

TEST(DeckBeamOffsets, OneOffsetForOneSection) {
  const auto error = [](const std::string& text, DeckDialect dialect = DeckDialect::by_content) {
    return error_of([&] { stick_deck(sticks("B31", text, false), dialect); });
  };
  const std::string line = "*BEAM SECTION OFFSET\n.02, -.03\n";
  EXPECT_EQ(error(stick_section("SET1", "") + line), "no error");
  EXPECT_EQ(error(stick_section("SET1", "") + line + line), "stick.inp:20: duplicate");
  EXPECT_EQ(error(stick_section("SET1", ", OFFSET2=.5") + line), "stick.inp:18: exclusive");
  EXPECT_EQ(error(stick_section("SET1", "") + "*BEAM SECTION OFFSET\n.02, -.03, .04\n"),
            "stick.inp:19: wrong_count");
  EXPECT_EQ(error(stick_section("SET1", "") + line + ".01, .01\n"), "stick.inp:20: unsupported");
}

// The line is one of Abaqus: it shows whose deck it is, and CalculiX would ignore it.
TEST(DeckBeamOffsets, TheLineIsOneOfAbaqus) {
  const std::string line = "*BEAM SECTION OFFSET\n.02, -.03\n";
  const std::string text = sticks("B32", stick_section("SET1", "", "CIRC", ".03") + line, false);
  const FeModel m = stick_deck(text);
  EXPECT_NEAR(m.sections[0].A, std::numbers::pi * 9e-4, 1e-15);
  EXPECT_EQ(m.notes.at(0),
            "stick.inp:15: *BEAM SECTION, SECTION=CIRC: 0.03 is the radius, as in Abaqus (*BEAM "
            "SECTION OFFSET in stick.inp:18)");
  EXPECT_EQ(error_of([&] { stick_deck(text, DeckDialect::calculix); }),
            "stick.inp:18: unsupported");
  EXPECT_EQ(error_of([&] {
              stick_deck(sticks(
                  "B31", stick_section("SET1", "") + line + "*VALUES AT INFINITY\n1.\n", false));
            }),
            "stick.inp:18: unsupported");
}

}  // namespace
}  // namespace floatframe::test

// Membranes of Abaqus and CalculiX decks: M3D with *MEMBRANE SECTION.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

constexpr double foil_young = 7e10, foil_poisson = 0.25, foil_thickness = 0.002,
                 foil_density = 2700.0;
const std::string foil_nodes =
    "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, .5, 0., 0.\n3, 1., 0., 0.\n4, 0., .5, 0.\n"
    "5, .5, .5, 0.\n6, 1., .5, 0.\n";
const std::string foil_elements =
    "*ELEMENT, TYPE=M3D4R, ELSET=FOIL\n1, 1, 2, 5, 4\n*ELEMENT, TYPE=M3D3, ELSET=FOIL\n"
    "2, 2, 3, 6\n3, 2, 6, 5\n";
const std::string foil_material = "*MATERIAL, NAME=AL\n*ELASTIC\n7e10, .25\n*DENSITY\n2700.\n";

FeModel foil_deck(const std::string& text, DeckDialect dialect = DeckDialect::calculix) {
  return valid_inp(text, of_dialect(dialect), "foil.inp");
}

std::string foil(const std::string& section) {
  return foil_nodes + foil_elements + foil_material + section;
}

/// Energy of the strain xx = 1 with free contraction of a strip from x = 0.
double stretched(const FeModel& m, double contraction) {
  const FeSystem system = assemble(m);
  VecX u = VecX::Zero(system.size());
  for (int k = 0; k < m.nodes(); ++k) {
    u(system.row(k, 0)) = m.positions[static_cast<std::size_t>(k)](0);
    u(system.row(k, 1)) = -contraction * m.positions[static_cast<std::size_t>(k)](1);
  }
  return u.dot(system.K * u);
}

// E t b/L, no rotations, mass t rho A; lumped in Abaqus, consistent in CalculiX.
TEST(DeckMembranes, StretchedStrip) {
  const std::string section = "*MEMBRANE SECTION, ELSET=FOIL, MATERIAL=AL\n.002\n";
  const FeModel m = foil_deck(foil(section));
  ASSERT_EQ(m.elements.size(), 3u);
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane4s);
  EXPECT_EQ(m.elements[1].type, FeElementType::membrane3);
  EXPECT_NEAR(stretched(m, foil_poisson), foil_young * foil_thickness * .5, 1e-12 * foil_young);
  const FeSystem system = assemble(m);
  EXPECT_EQ(system.size(), 18);
  VecX z = VecX::Zero(18);
  for (int k = 0; k < 6; ++k) z(system.row(k, 2)) = 1.0;
  EXPECT_NEAR(z.dot(system.M * z), .5 * foil_density * foil_thickness, 1e-14);
  EXPECT_NEAR(system.M.coeff(0, 0), .25 / 9 * foil_density * foil_thickness, 1e-14);
  const FeSystem lumped = assemble(foil_deck(foil(section), DeckDialect::abaqus));
  EXPECT_NEAR(lumped.M.coeff(0, 0), .25 / 4 * foil_density * foil_thickness, 1e-14);
}

// The same matrices as those of the Nastran deck.
TEST(DeckMembranes, AsInNastran) {
  const FeModel sheet = read_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,.5,0.,0.\nGRID,3,,1.,0.,0.\nGRID,4,,0.,.5,0.\n"
      "GRID,5,,.5,.5,0.\nGRID,6,,1.,.5,0.\nCQUAD4,1,1,1,2,5,4\nCTRIA3,2,1,2,3,6\n"
      "CTRIA3,3,1,2,6,5\nPARAM,COUPMASS,1\nPSHELL,1,1,.002\nMAT1,1,7.+10,,.25,2700.\n");
  const FeSystem nastran = assemble(sheet),
                 deck = assemble(
                     foil_deck(foil("*MEMBRANE SECTION, ELSET=FOIL, MATERIAL=AL\n.002\n")));
  EXPECT_LE(MatX(nastran.K - deck.K).norm(), 1e-14 * MatX(deck.K).norm());
  EXPECT_LE(MatX(nastran.M - deck.M).norm(), 1e-14 * MatX(deck.M).norm());
}

// Fibres along y: E_2 t b/L.
TEST(DeckMembranes, AxesOfTheMaterial) {
  const FeModel m = foil_deck(
      foil_nodes + foil_elements +
      "*MATERIAL, NAME=AL\n*ELASTIC, TYPE=LAMINA\n120e9, 8e9, .3, 5e9, 5e9, 4e9\n*DENSITY\n1600.\n"
      "*ORIENTATION, NAME=O\n0., 1., 0., -1., 0., 0.\n3, 0.\n"
      "*MEMBRANE SECTION, ELSET=FOIL, MATERIAL=AL, ORIENTATION=O\n.002\n");
  EXPECT_NEAR(stretched(m, .3 * 8. / 120.), 8e9 * foil_thickness * .5, 1e-4);
}

TEST(DeckMembranes, ElementsAndThicknessOfNodes) {
  const FeModel m = foil_deck(
      "*NODE, NSET=NALL\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n5, .5, 0.\n6, 1., .5\n"
      "7, .5, 1.\n8, 0., .5\n9, 2., 0.\n10, 1.5, .5\n11, 1.5, 0.\n"
      "*ELEMENT, TYPE=M3D8R, ELSET=FOIL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "*ELEMENT, TYPE=M3D6, ELSET=FOIL\n2, 2, 9, 3, 11, 10, 6\n"
      "*ELEMENT, TYPE=M3D8, ELSET=SKIN\n3, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "*ELEMENT, TYPE=M3D4, ELSET=FOIL\n4, 1, 2, 3, 4\n" +
      foil_material +
      "*MEMBRANE SECTION, ELSET=FOIL, MATERIAL=AL, NODAL THICKNESS\n*NODAL THICKNESS\n"
      "NALL, .002\n9, .005\n");
  ASSERT_EQ(m.elements.size(), 3u);  // those without a section are a skin
  EXPECT_EQ(m.node_sets.at("SKIN").size(), 8u);
  EXPECT_EQ(m.elements[0].type, FeElementType::membrane8r);
  EXPECT_EQ(m.elements[1].type, FeElementType::membrane6);
  EXPECT_EQ(m.elements[2].type, FeElementType::membrane4);
  const auto thickness = [&](std::size_t e) {
    return m.shells[static_cast<std::size_t>(m.elements[e].section)].thickness;
  };
  EXPECT_NEAR(thickness(0), .002, 1e-16);
  EXPECT_NEAR(thickness(1), .003, 1e-16);
}

TEST(DeckMembranes, InvalidMembranesAreErrors) {
  const auto error = [](const std::string& section) {
    return error_of([&] { foil_deck(foil(section)); });
  };
  const std::string begin = "*MEMBRANE SECTION, ELSET=FOIL, MATERIAL=AL";
  EXPECT_EQ(error(begin + ", OFFSET=.5\n.002\n"), "foil.inp:18: unsupported");
  EXPECT_EQ(error(begin + "\n"), "foil.inp:18: missing");
  EXPECT_EQ(error(begin + "\n-1.\n"), "foil.inp:19: out_of_range");
  EXPECT_EQ(error("*SHELL SECTION, ELSET=FOIL, MATERIAL=AL\n.002\n"), "foil.inp:18: wrong_value");
  EXPECT_EQ(error(begin + "\n.002\n.003\n"), "foil.inp:20: unsupported");
  EXPECT_EQ(error(begin + ", COMPOSITE\n.002\n").substr(0, 50), "foil.inp:18: unsupported");
}

}  // namespace
}  // namespace floatframe::test

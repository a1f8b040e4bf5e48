// *NONSTRUCTURAL MASS: masses in closed form.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

/// A cube of 1 m, a plate of 1 m x 2 m x 0.01 m and a bar of 3 m and 0.1 m x 0.2 m apart from each
/// other: masses 1000, 20 and 60 kg. `more` begins in line 35.
const std::string three_things =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
    "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n11, 5., 0., 0.\n12, 6., 0., 0.\n13, 6., 2., 0.\n"
    "14, 5., 2., 0.\n21, 0., 0., 9.\n22, 3., 0., 9.\n"
    "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
    "*ELEMENT, TYPE=S4, ELSET=PLATE\n2, 11, 12, 13, 14\n*ELEMENT, TYPE=B31, ELSET=BAR\n"
    "3, 21, 22\n*ELSET, ELSET=ALL\n1, 2, 3\n*MATERIAL, NAME=M\n*ELASTIC\n2e9, .3\n"
    "*DENSITY\n1000.\n*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n"
    "*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n.01\n"
    "*BEAM SECTION, ELSET=BAR, MATERIAL=M, SECTION=RECT\n.1, .2\n0., 1., 0.\n";

FeModel smeared(const std::string& more) { return valid_inp(three_things + more, {}, "mass.inp"); }

/// Masses of cube, plate and bar, from the motion of the nodes of each along z.
Vec3 masses_of(const FeModel& m) {
  const FeSystem system = assemble(m);
  Vec3 out = Vec3::Zero();
  const std::array<std::pair<int, int>, 3> nodes = {{{0, 8}, {8, 12}, {12, 14}}};
  for (std::size_t k = 0; k < 3; ++k) {
    VecX u = VecX::Zero(system.size());
    for (int n = nodes[k].first; n < nodes[k].second; ++n) u(system.row(n, 2)) = 1.0;
    out(static_cast<Eigen::Index>(k)) = u.dot(system.M * u);
  }
  return out;
}

void expect_masses(const std::string& more, const Vec3& expected) {
  EXPECT_LE((masses_of(smeared(more)) - expected).norm(), 1e-11 * expected.norm()) << more;
}

TEST(NonstructuralMass, ClosedForms) {
  const std::string begin = "*NONSTRUCTURAL MASS, ELSET=", total = ", UNITS=TOTAL MASS";
  const Vec3 own(1000, 20, 60);
  const double sum = 1080, volume = 1 + .02 + .06;
  expect_masses("", own);
  expect_masses(begin + "ALL" + total + "\n54.\n", own * (1 + 54 / sum));
  expect_masses(begin + "ALL" + total + ", DISTRIBUTION=MASS PROPORTIONAL\n54.\n",
                own * (1 + 54 / sum));
  expect_masses(begin + "ALL" + total + ", DISTRIBUTION=VOLUME PROPORTIONAL\n54.\n",
                own + Vec3(1, .02, .06) * 54 / volume);
  expect_masses(begin + "ALL, UNITS=MASS PER VOLUME\n7.\n", own + Vec3(7, .14, .42));
  expect_masses(begin + "PLATE, UNITS=MASS PER AREA\n7.\n", own + Vec3(0, 14, 0));
  expect_masses(begin + "BAR, UNITS=MASS PER LENGTH\n7.\n", own + Vec3(0, 0, 21));
  // Two of them: shares of the mass that the elements have by themselves.
  expect_masses(begin + "PLATE, UNITS=MASS PER AREA\n7.\n" + begin + "ALL" + total + "\n54.\n",
                own * (1 + 54 / sum) + Vec3(0, 14, 0));
}

TEST(NonstructuralMass, OfPlies) {
  const std::string::size_type at = three_things.find("*SHELL SECTION");
  std::string text = three_things;
  text.replace(at, text.find("*BEAM SECTION") - at,
               "*SHELL SECTION, ELSET=PLATE, COMPOSITE\n.004, 3, M, 0.\n.006, 3, M, 90.\n");
  const FeModel model =
      read_inp(text + "*NONSTRUCTURAL MASS, ELSET=PLATE, UNITS=MASS PER VOLUME\n500.\n");
  EXPECT_LE((masses_of(model) - Vec3(1000, 30, 60)).norm(), 1e-9);
}

TEST(NonstructuralMass, InvalidMassesAreErrors) {
  const auto error = [](const std::string& more) {
    return error_of([&] { smeared("*NONSTRUCTURAL MASS, " + more); });
  };
  EXPECT_EQ(error("ELSET=CUBE, UNITS=MASS PER AREA\n1.\n"), "mass.inp:35: wrong_value");
  EXPECT_EQ(error("ELSET=PLATE, UNITS=MASS PER LENGTH\n1.\n"), "mass.inp:35: wrong_value");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=POUNDS\n1.\n"), "mass.inp:35: wrong_value");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=TOTAL MASS, DISTRIBUTION=EVEN\n1.\n"),
            "mass.inp:35: wrong_value");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=TOTAL MASS\n"), "mass.inp:35: missing");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=TOTAL MASS\n-3.\n"), "mass.inp:36: out_of_range");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=TOTAL MASS\n3.\n4.\n"), "mass.inp:37: unsupported");
  EXPECT_EQ(error("ELSET=CUBE, UNITS=TOTAL MASS\n3., 4.\n"), "mass.inp:36: wrong_count");
  EXPECT_EQ(error("ELSET=SKIN, UNITS=TOTAL MASS\n3.\n*ELEMENT, TYPE=SFM3D4, ELSET=SKIN\n"
                  "9, 1, 2, 3, 4\n"),
            "mass.inp:35: wrong_value");
  std::string light = three_things;
  light.erase(light.find("*DENSITY"), std::string("*DENSITY\n1000.\n").size());
  EXPECT_EQ(inp_error(light + "*NONSTRUCTURAL MASS, ELSET=ALL, UNITS=TOTAL MASS\n3.\n"),
            "deck.inp:33: wrong_value");
}

}  // namespace
}  // namespace floatframe::test

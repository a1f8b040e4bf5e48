// I sections, further nodes that direct beams, and places of sections of Abaqus decks.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

/// A beam of length 2 along x; `section` begins in line 10.
FeModel girder(const std::string& section, const std::string& element = "1, 1, 2",
               const std::string& node = "3, 0., 0., 5.",
               DeckDialect dialect = DeckDialect::by_content) {
  return read_inp("*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n" + node +
                      "\n*ELEMENT, TYPE=B33, ELSET=SET\n" + element +
                      "\n*MATERIAL, NAME=M\n*ELASTIC\n2e11, .3\n" + section,
                  of_dialect(dialect), "girder.inp");
}

std::string i_of(const std::string& numbers, const std::string& more = "0., 1., 0.\n") {
  return "*BEAM SECTION, ELSET=SET, MATERIAL=M, SECTION=I\n" + numbers + "\n" + more;
}

std::string girder_error(const std::string& section, const std::string& element = "1, 1, 2",
                         DeckDialect dialect = DeckDialect::by_content) {
  return error_of([&] { girder(section, element, "3, 0., 0., 5.", dialect); });
}

// Equal flanges: the whole rectangle less two beside the web.
TEST(DeckBeamShapes, IOfEqualFlanges) {
  const FeModel m = girder(i_of(".1, .2, .08, .08, .012, .012, .006"));
  const BeamSection& s = m.sections.at(static_cast<std::size_t>(m.elements[0].section));
  EXPECT_NEAR(s.A, .08 * .2 - .074 * .176, 1e-16);
  EXPECT_NEAR(s.Iy, (.08 * std::pow(.2, 3) - .074 * std::pow(.176, 3)) / 12, 1e-18);
  EXPECT_NEAR(s.Iz, (2 * .012 * std::pow(.08, 3) + .176 * std::pow(.006, 3)) / 12, 1e-18);
  EXPECT_NEAR(s.J, (2 * .08 * std::pow(.012, 3) + .176 * std::pow(.006, 3)) / 3, 1e-20);
  EXPECT_EQ(m.nodes(), 3);  // the node is in the middle
  EXPECT_TRUE(has_note(m,
                       "girder.inp:10: *BEAM SECTION, SECTION=I: area and moments are those "
                       "of its rectangles, the torsion constant is the sum of b t^3/3, about "
                       "the centroid; Abaqus integrates along the middle of the walls"));
}

// A T with its web down, the node at the lower end of the web, and the same with *BEAM SECTION
// OFFSET: where the centroid is, and moments about it.
TEST(DeckBeamShapes, TAndItsPlace) {
  const double A = .1 * .01 + .09 * .008, z = (.1 * .01 * .095 + .09 * .008 * .045) / A,
               I = .1 * std::pow(.01, 3) / 12 + .1 * .01 * std::pow(.095 - z, 2) +
                   .008 * std::pow(.09, 3) / 12 + .09 * .008 * std::pow(z - .045, 2);
  const FeModel m = girder(i_of("0., .1, 0., .1, 0., .01, .008"));
  const BeamSection& s = m.sections.at(static_cast<std::size_t>(m.elements[0].section));
  EXPECT_NEAR(s.A, A, 1e-16);
  EXPECT_NEAR(s.Iy, I, 1e-18);
  ASSERT_EQ(m.nodes(), 5);
  EXPECT_LE((m.positions[3] - Vec3(0, 0, z)).norm(), 1e-15);  // direction 2 = x cross y
  EXPECT_LE((m.positions[4] - Vec3(2, 0, z)).norm(), 1e-15);
  const FeModel moved =
      girder(i_of("0., .1, 0., .1, 0., .01, .008") + "*BEAM SECTION OFFSET\n.02, -.03\n");
  EXPECT_LE((moved.positions[3] - Vec3(0, .02, z - .03)).norm(), 1e-15);
  // Upside down it is the other T.
  const FeModel other = girder(i_of(".1, .1, .1, 0., .01, 0., .008"));
  EXPECT_LE((other.positions[3] - Vec3(0, 0, -z)).norm(), 1e-15);
}

TEST(DeckBeamShapes, PlacesOfGivenConstants) {
  const std::string constants =
      "*BEAM GENERAL SECTION, ELSET=SET, SECTION=GENERAL\n.01, 1e-5, 0., 2e-5, 1e-6\n0., 1., 0.\n"
      "2e11, 8e10\n";
  const FeModel m = girder(constants + "*CENTROID\n.01, .02\n*SHEAR CENTER\n.01, .02\n");
  EXPECT_LE((m.positions[3] - Vec3(0, .01, .02)).norm(), 1e-15);
  EXPECT_EQ(girder_error(constants + "*CENTROID\n.01, .02\n"), "girder.inp:10: incomplete");
  EXPECT_EQ(girder_error(constants + "*BEAM SECTION OFFSET\n1., 0.\n"),
            "girder.inp:14: incomplete");
  EXPECT_EQ(girder_error(i_of(".1, .2, .08, .08, .012, .012, .006") + "*CENTROID\n1., 0.\n"),
            "girder.inp:13: incomplete");
}

// The node is above the beam, so that direction 1 is z; it counts before that of the section.
TEST(DeckBeamShapes, FurtherNodes) {
  const std::string section = "*BEAM SECTION, ELSET=SET, MATERIAL=M, SECTION=RECT\n.1, .2\n";
  const FeModel by_node = girder(section + "0., 1., 0.\n", "1, 1, 2, 3", "3, .7, 0., 5."),
                by_section = girder(section + "0., 0., 1.\n");
  const SparseMatrix a = assemble_stiffness(by_node), b = assemble_stiffness(by_section);
  EXPECT_LE((a - b).norm(), 1e-14 * b.norm());
  EXPECT_EQ(girder_error(section, "1, 1, 2, 9"), "girder.inp:6: not_found");
  EXPECT_EQ(error_of([&] { girder(section, "1, 1, 2, 3", "3, 5., 0., 0."); }),
            "girder.inp:6: geometry");
  EXPECT_EQ(girder_error(section, "1, 1, 2, 3", DeckDialect::calculix),
            "girder.inp:6: unsupported");
  EXPECT_EQ(girder_error(section,
                         "1, 1, 2, 3\n*ELCOPY, OLD SET=SET, NEW SET=NEW, SHIFT NODES=0, "
                         "ELEMENT SHIFT=10"),
            "girder.inp:7: unsupported");
}

TEST(DeckBeamShapes, InvalidShapesAreErrors) {
  EXPECT_EQ(girder_error(i_of(".1, .2, .08, .08, .012, .012")), "girder.inp:10: wrong_count");
  EXPECT_EQ(girder_error(i_of(".1, .2, .08, .08, .1, .1, .006")), "girder.inp:11: geometry");
  EXPECT_EQ(girder_error(i_of(".1, .2, .08, 0., .01, .01, .006")), "girder.inp:11: incomplete");
  EXPECT_EQ(girder_error(i_of(".1, .2, -1., .08, .01, .01, .006")), "girder.inp:11: incomplete");
  const auto shape = [](const std::string& name) {
    return girder_error("*BEAM SECTION, ELSET=SET, MATERIAL=M, SECTION=" + name + "\n.1, .2\n");
  };
  EXPECT_EQ(shape("L"), "girder.inp:10: unsupported");
  EXPECT_EQ(shape("T"), "girder.inp:10: unsupported");
  EXPECT_EQ(shape("STAR"), "girder.inp:10: unsupported");
}

}  // namespace
}  // namespace floatframe::test

// *NODAL THICKNESS: shells with the mean of their corners, where their section asks for it.
#include <gtest/gtest.h>

#include <string>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

/// Two squares side by side and a triangle.
std::string plate(const std::string& section, const std::string& more) {
  return "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 2., 0., 0.\n4, 0., 1., 0.\n5, 1., 1., 0.\n"
         "6, 2., 1., 0.\n7, 3., 0., 0.\n*NSET, NSET=ALL, GENERATE\n1, 7, 1\n"
         "*ELEMENT, TYPE=S4, ELSET=PLATE\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n"
         "*ELEMENT, TYPE=S3, ELSET=PLATE\n3, 3, 7, 6\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e5, .3\n"
         "*DENSITY\n8e-9\n*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL" +
         section + more;
}

FeModel thick(const std::string& section, const std::string& more) {
  return read_inp(plate(section, more), {}, "a.inp");
}

std::string thick_errors(const std::string& section, const std::string& more) {
  return error_of([&] { thick(section, more); });
}

TEST(NodalThickness, OneForAllIsThatOfTheSection) {
  const FeModel a = thick(", NODAL THICKNESS, OFFSET=.25\n", "*NODAL THICKNESS\nALL, .4\n"),
                b = thick(", OFFSET=.25\n.4\n", "");
  ASSERT_EQ(a.shells.size(), 1u);
  EXPECT_EQ(a.shells[0].thickness, b.shells[0].thickness);
  EXPECT_EQ(a.shells[0].shear, b.shells[0].shear);
  EXPECT_EQ(a.shells[0].offset, b.shells[0].offset);
  EXPECT_EQ((assemble_stiffness(a) - assemble_stiffness(b)).norm(), 0.0);
}

TEST(NodalThickness, MeanOfTheCorners) {
  const FeModel m = thick(", NODAL THICKNESS, OFFSET=SPOS\n1.\n",
                          "*NODAL THICKNESS\nALL, .4\n3, .8\n6, .8\n7, .2\n");
  const auto of = [&](int e) { return m.shells[m.elements[e].section]; };
  EXPECT_NEAR(of(0).thickness, 0.4, 1e-15);
  EXPECT_NEAR(of(1).thickness, 0.6, 1e-15);
  EXPECT_NEAR(of(2).thickness, 0.6, 1e-15);
  EXPECT_NEAR(of(1).offset, -0.3, 1e-15);
  EXPECT_NEAR(of(1).shear, 0.5, 1e-15);
  EXPECT_EQ(m.elements[1].section, m.elements[2].section);
  EXPECT_TRUE(has_note(m,
                       "a.inp:13: 2 shells have nodes of different thickness, by 100.0 % at "
                       "most: each has the mean of its corners"))
      << joined(m.notes);
}

/// CalculiX 2.20 gives the same frequencies with and without such lines.
TEST(NodalThickness, WithoutTheParameterItHasNoEffect) {
  const FeModel m = thick("\n.1\n", "*NODAL THICKNESS\nALL, .4\n");
  EXPECT_EQ(m.shells.at(0).thickness, 0.1);
  EXPECT_TRUE(has_note(m,
                       "a.inp:24: *NODAL THICKNESS has no effect, as in Abaqus and CalculiX: no "
                       "section has the parameter NODAL THICKNESS"))
      << joined(m.notes);
}

TEST(NodalThickness, OfPartsWithSeveralInstances) {
  const std::string part = plate(", NODAL THICKNESS\n", "*NODAL THICKNESS\nALL, .4\n");
  const std::size_t material = part.find("*MATERIAL"), section = part.find("*SHELL");
  const FeModel m =
      read_inp("*PART, NAME=P\n" + part.substr(0, material) + part.substr(section) +
               "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n"
               "*END INSTANCE\n*INSTANCE, NAME=P-2, PART=P\n9., 0., 0.\n*END INSTANCE\n"
               "*END ASSEMBLY\n" +
               part.substr(material, section - material));
  ASSERT_EQ(m.elements.size(), 6u);
  for (const FeElement& e : m.elements) EXPECT_EQ(m.shells[e.section].thickness, 0.4);
}

TEST(NodalThickness, InvalidThicknessesAreErrors) {
  EXPECT_EQ(thick_errors(", NODAL THICKNESS\n", "*NODAL THICKNESS\n1, .4\n2, .4\n"),
            "a.inp:21: missing");
  EXPECT_EQ(thick_errors(", NODAL THICKNESS\n", ""), "a.inp:21: missing");
  EXPECT_EQ(thick_errors(", NODAL THICKNESS\n", "*NODAL THICKNESS\nALL, 0.\n"),
            "a.inp:23: out_of_range");
  EXPECT_EQ(thick_errors(", NODAL THICKNESS\n", "*NODAL THICKNESS\nALL\n"), "a.inp:23: missing");
  EXPECT_EQ(thick_errors("\n1.\n", "*NODAL THICKNESS\n"), "a.inp:23: missing");
}

}  // namespace
}  // namespace floatframe::test

// Elements of decks: shear of beams, lumped mass as the program of the deck has it, shells with
// nodes on their edges, pyramids; and the note on frequencies there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "decks/deck_text.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const BeamSection& section_of(const FeModel& m, std::size_t element) {
  return m.sections[m.elements[element].section];
}

const std::string bar_nodes = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n";

TEST(ElementKinds, ShearFactorsOfNastran) {
  const FeModel m =
      read_bdf(bar_nodes +
               "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,2,1,2,0.,0.,1.\nCBEAM,3,3,1,2,0.,0.,1.\n"
               "CBEAM,4,4,1,2,0.,0.,1.\nCBAR,5,5,1,2,0.,0.,1.\n"
               "PBAR,1,1,1.-3,1.-7,2.-7,2.-7\n"                      // blank: none
               "PBAR,2,1,1.-3,1.-7,2.-7,2.-7,,\n,,,,,,,,\n,.8,.5\n"  // K1: of plane 1, y
               "PBEAM,3,1,1.-3,1.-7,2.-7,,2.-7\n"                    // blank: 1
               "PBEAM,4,1,1.-3,1.-7,2.-7,,2.-7\n,,,,,,,,\n,.6,0.\n"  // 0: none
               "PBARL,5,2,,BAR\n,.02,.04\n"
               "MAT1,1,2.+11,,.3,8000.\nMAT1,2,2.6+11,2.+11,.3,8000.\n");
  const double A = 1e-3;
  const std::pair<double, double> expected[] = {{0, 0}, {0.8 * A, 0.5 * A}, {A, A}, {0.6 * A, 0}};
  for (std::size_t e = 0; e < 4; ++e) {
    EXPECT_DOUBLE_EQ(section_of(m, e).shear_y, expected[e].first) << e;
    EXPECT_DOUBLE_EQ(section_of(m, e).shear_z, expected[e].second) << e;
  }
  // G of the card is twice that of E and NU.
  EXPECT_NEAR(section_of(m, 4).shear_y, 2.0 * 5.0 / 6.0 * 8e-4, 1e-15);
  const std::string negative = bar_nodes +
                               "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,1.-3,1.-7,2.-7,2.-7,,\n,,,,,,,,\n"
                               ",-.8,.5\nMAT1,1,2.+11,,.3,8000.\n";
  EXPECT_EQ(bdf_error(negative), "arm.bdf:5: out_of_range");
}

const std::string steel_deck = "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, .3\n*DENSITY\n8000.\n";

TEST(ElementKinds, ShearFactorsOfAbaqus) {
  const auto deck = [](const std::string& type, const std::string& section) {
    return "*NODE\n1\n2, 1.\n*ELEMENT, TYPE=" + type + ", ELSET=E\n1, 1, 2\n" + steel_deck +
           "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" + section + "\n0., 0., -1.\n";
  };
  const std::pair<const char*, double> shapes[] = {{"RECT\n.02, .03", 0.85},
                                                   {"CIRC\n.02", 0.89},
                                                   {"PIPE\n.02, .001", 0.53},
                                                   {"BOX\n.03, .05, .002, .002, .002, .002", 0.44}};
  for (const auto& [shape, factor] : shapes) {
    const FeModel b31 = read_inp(deck("B31", shape)), b33 = read_inp(deck("B33", shape));
    EXPECT_DOUBLE_EQ(section_of(b31, 0).shear_y, factor * section_of(b31, 0).A) << shape;
    EXPECT_EQ(section_of(b31, 0).shear_z, section_of(b31, 0).shear_y);
    EXPECT_FALSE(section_of(b33, 0).has_shear());
    EXPECT_EQ(section_of(b33, 0).slenderness, 0.0);
    // CIRC, PIPE and BOX of B31 are of Abaqus alone.
    EXPECT_EQ(section_of(b31, 0).slenderness, shape[0] == 'R' ? 0.0 : 0.25) << shape;
    EXPECT_EQ(b33.elements[0].mass_form, MassForm::consistent);
  }
}

TEST(ElementKinds, MassAsTheProgramOfTheDeck) {
  const std::string tetra =
      "*NODE\n1\n2, 1.\n3, 0., 1.\n4, 0., 0., 1.\n*ELEMENT, TYPE=C3D4, "
      "ELSET=B\n1, 1, 2, 3, 4\n" +
      steel_deck + "*SOLID SECTION, ELSET=B, MATERIAL=M\n";
  const auto form = [](const FeModel& m) { return m.elements[0].mass_form; };
  EXPECT_EQ(form(read_inp(tetra)), MassForm::consistent);  // nothing shows whose it is
  EXPECT_EQ(form(read_inp(tetra + "*PREPRINT, ECHO=NO\n")), MassForm::lumped);
  const std::string bar = bar_nodes +
                          "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,1.-3,1.-7,2.-7,2.-7\n"
                          "MAT1,1,2.+11,,.3,8000.\n";
  EXPECT_EQ(form(read_bdf(bar)), MassForm::lumped_without_rotation);
  for (const char* off : {"-1", "0", "NO"})
    EXPECT_EQ(form(read_bdf(fmt::format("PARAM,COUPMASS,{}\n", off) + bar)),
              MassForm::lumped_without_rotation);
  EXPECT_EQ(form(read_bdf("PARAM,COUPMASS,1\n" + bar)), MassForm::consistent);

  const TemporaryFolder folder;
  folder.write("arm.inp", tetra);
  folder.write("arm.bdf", bar);
  FeReadOptions options;
  const FeModel unclear = read_fe_file(folder / "arm.inp", options);
  EXPECT_TRUE(contains(unclear.notes,
                       "the mass of all elements is consistent, as in CalculiX; Abaqus lumps that "
                       "of elements of first order: --dialect abaqus"));
  options.dialect = DeckDialect::abaqus;
  const FeModel theirs = read_fe_file(folder / "arm.inp", options);
  EXPECT_EQ(form(theirs), MassForm::lumped);
  options.mass_form = MassChoice::consistent;
  EXPECT_EQ(form(read_fe_file(folder / "arm.inp", options)), MassForm::consistent);
  options = {};
  options.mass_form = MassChoice::lumped;
  EXPECT_EQ(form(read_fe_file(folder / "arm.bdf", options)), MassForm::lumped);
  options.beam_shear = BeamShear::none;
  EXPECT_FALSE(read_fe_file(folder / "arm.bdf", options).sections[0].has_shear());
}

const std::string square =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\n"
    "GRID,5,,1.,0.,0.\nGRID,6,,2.,1.,0.\nGRID,7,,1.,2.,0.\nGRID,8,,0.,1.,0.\nGRID,9,,1.,1.,0.\n"
    "PSHELL,1,1,.1,1\nMAT1,1,2.+11,,.3,8000.\n";

TEST(ElementKinds, ShellsWithMiddles) {
  const FeModel m = read_bdf(square +
                             "CQUAD8,1,1,1,2,3,4,5,6\n,7,8\nCTRIA6,2,1,1,2,3,5,6,9\n"
                             "CQUAD8,3,1,1,2,3,4\nCQUADR,4,1,1,2,3,4\nCTRIAR,5,1,1,2,3\n");
  ASSERT_EQ(m.elements.size(), 5u);
  const FeElementType types[] = {FeElementType::quad8, FeElementType::tri6, FeElementType::quad4,
                                 FeElementType::quad4, FeElementType::tri3};
  for (std::size_t e = 0; e < 5; ++e) EXPECT_EQ(m.elements[e].type, types[e]) << e;
  EXPECT_EQ(m.elements[0].nodes[7], 7);
  EXPECT_EQ(m.elements[1].nodes[5], 8);
  EXPECT_TRUE(contains(m.notes, "1 CQUAD8 elements without mid-side nodes are read as CQUAD4"));
  EXPECT_TRUE(contains(m.notes, "1 CQUADR elements are read as CQUAD4"));
  EXPECT_EQ(bdf_error(square + "CQUAD8,1,1,1,2,3,4,5,6\n"), "arm.bdf:12: incomplete");

  const FeModel s8 = read_inp(
      "*NODE\n1\n2, 2.\n3, 2., 2.\n4, 0., 2.\n5, 1.\n6, 2., 1.\n7, 1., 2.\n8, 0., 1.\n9, 1., 1.\n"
      "*ELEMENT, TYPE=S8R, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "*ELEMENT, TYPE=STRI65, ELSET=E\n2, 1, 2, 3, 5, 6, 9\n" +
      steel_deck + "*SHELL SECTION, ELSET=E, MATERIAL=M\n.1\n");
  EXPECT_EQ(s8.elements[0].type, FeElementType::quad8);
  EXPECT_EQ(s8.elements[1].type, FeElementType::tri6);
}

// The middles of the edges lie where the order of the nodes says, in either format.
TEST(ElementKinds, Pyramids) {
  const Vec3 corner[5] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 2}};
  const int edges[8][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  const int gmsh_edges[8][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  const auto check = [&](const FeModel& m) {
    ASSERT_EQ(m.elements.size(), 1u);
    ASSERT_EQ(m.elements[0].type, FeElementType::pyramid13);
    const auto at = [&](int i) { return m.positions[m.elements[0].nodes[i]]; };
    for (int e = 0; e < 8; ++e)
      EXPECT_EQ(at(5 + e), Vec3(0.5 * (at(edges[e][0]) + at(edges[e][1])))) << e;
    EXPECT_NO_THROW(validate(m));
  };
  std::string bulk, msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n13\n";
  for (int k = 0; k < 13; ++k) {
    const auto middle = [&](const int(&e)[2]) { return Vec3(0.5 * (corner[e[0]] + corner[e[1]])); };
    const Vec3 p = k < 5 ? corner[k] : middle(edges[std::max(k - 5, 0)]);
    const Vec3 q = k < 5 ? corner[k] : middle(gmsh_edges[std::max(k - 5, 0)]);
    bulk += fmt::format("GRID,{},,{:.1f},{:.1f},{:.1f}\n", k + 1, p(0), p(1), p(2));
    msh += fmt::format("{} {} {} {}\n", k + 1, q(0), q(1), q(2));
  }
  check(read_bdf(bulk + "CPYRAM,1,1,1,2,3,4,5,6\n,7,8,9,10,11,12,13\nPSOLID,1,1\n"
                        "MAT1,1,2.+11,,.3,8000.\n"));
  FeReadOptions options;
  options.material = Material{2e11, 0.3, 8000};
  check(parse_gmsh(msh + "$EndNodes\n$Elements\n1\n1 19 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13\n"
                         "$EndElements\n",
                   "p.msh", options));
}

}  // namespace
}  // namespace floatframe::test

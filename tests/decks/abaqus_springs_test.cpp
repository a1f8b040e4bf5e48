// Springs and rods of Abaqus and CalculiX decks: two blocks of C3D20 (mm-t-s) joined by them
// against the free frequencies of CalculiX 2.20, which it prints with seven digits; closed forms;
// sentences.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

FeModel sprung(const std::string& text, const FeReadOptions& options = {}) {
  return read_inp(text, options, "arm.inp");
}

void expect_frequencies(const std::string& name, const std::vector<double>& expected,
                        double tolerance) {
  const FeModel model = read_fe_file(std::filesystem::path(FLOATFRAME_TEST_DATA) / "decks" / name);
  validate(model);
  const FeSystem system = assemble(model, Integration::ccx);
  const VecX lambda = generalised_eigenvalues(MatX(system.K), MatX(system.M)).values;
  EXPECT_LT(std::abs(lambda(5)), 1e-6 * lambda(6));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double f = std::sqrt(lambda(6 + static_cast<int>(k))) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(f / expected[k], 1.0, tolerance) << k;
  }
}

TEST(AbaqusSprings, BlocksOnSpringsAgainstCalculix) {
  expect_frequencies(
      "blocks_on_springs.inp.gz",
      {2.318132e3, 3.300385e3, 5.062081e3, 6.260061e3, 8.462328e3, 1.151285e4, 6.870478e4,
       6.881507e4, 7.745282e4, 7.783413e4, 8.100086e4, 8.125926e4, 1.290177e5, 1.293881e5},
      5e-7);
}

// Rods of almost no mass: CalculiX makes solids of them, whose mass turns about their hinges and
// gives frequencies that rods have not.
TEST(AbaqusSprings, BlocksOnRodsAgainstCalculix) {
  expect_frequencies("blocks_on_rods.inp.gz",
                     {5.873376e3, 8.722436e3, 1.438736e4, 1.886261e4, 2.009629e4, 2.706634e4,
                      7.161564e4, 7.282896e4, 7.754355e4, 8.103705e4, 8.517364e4, 8.543607e4},
                     5e-7);
}

/// Four nodes of a tetrahedron, a node at one of them and one apart.
const std::string springs_deck =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 1., 0., 0.\n"  // 1 to 6
    "6, 3., 0., 0.\n*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n"                        // 7 to 9
    "*ELEMENT, TYPE=MASS, ELSET=M\n51, 5\n52, 6\n*MASS, ELSET=M\n2.\n"  // 10 to 14
    "*MATERIAL, NAME=A\n*ELASTIC\n2e11, .3\n*DENSITY\n7800.\n"          // 15 to 19
    "*SOLID SECTION, ELSET=E, MATERIAL=A\n\n";                          // 20, 21

/// Line 22 and 23.
std::string with_spring(const std::string& type, const std::string& nodes,
                        const std::string& spring) {
  return springs_deck + "*ELEMENT, TYPE=" + type + ", ELSET=S\n7, " + nodes + "\n*SPRING, ELSET=S" +
         spring;
}

/// The stiffness that a deck has beside the tetrahedron's.
MatX added(const std::string& text) {
  const SparseMatrix with = assemble(sprung(text)).K, without = assemble(sprung(springs_deck)).K;
  return MatX(with) - MatX(without);
}

TEST(AbaqusSprings, DirectionsOfNodes) {
  // SPRING2 between direction 2 of node 2 and direction 3 of node 5.
  MatX K = added(with_spring("SPRING2", "2, 5", "\n2, 3\n40.\n"));
  EXPECT_NEAR(K(4, 4), 40.0, 1e-4);
  EXPECT_NEAR(K(14, 14), 40.0, 1e-12);
  EXPECT_NEAR(K(4, 14), -40.0, 1e-12);
  EXPECT_NEAR(K.cwiseAbs().sum(), 160.0, 1e-3);
  // In the axes of an orientation.
  K = added("*ORIENTATION, NAME=O\n.6, .8, 0., -.8, .6, 0.\n" +
            with_spring("SPRING2", "5, 6", ", ORIENTATION=O\n1, 1\n100.\n"));
  EXPECT_NEAR(K(12, 12), 36.0, 1e-12);
  EXPECT_NEAR(K(12, 16), -48.0, 1e-12);
  EXPECT_NEAR(K(13, 16), -64.0, 1e-12);
  // *TRANSFORM does not turn them, in CalculiX 2.20 neither.
  K = added(with_spring("SPRING2", "5, 6", "\n1, 1\n100.\n") +
            "*NSET, NSET=N\n5, 6\n*TRANSFORM, NSET=N, TYPE=R\n.6, .8, 0., -.8, .6, 0.\n");
  EXPECT_NEAR(K(12, 15), -100.0, 1e-12);
  EXPECT_NEAR(K(12, 16), 0.0, 1e-12);
  // SPRING1: the ground.
  const FeModel grounded = sprung(with_spring("SPRING1", "5", "\n3\n7.\n"));
  ASSERT_EQ(grounded.springs.size(), 1u);
  EXPECT_EQ(grounded.springs[0].nodes[1], -1);
  EXPECT_NEAR(MatX(assemble(grounded).K)(14, 14), 7.0, 1e-12);
  // Tables: the mean of both sides at a corner, the slope of the segment within.
  for (const auto& [table, k] :
       {std::pair<const char*, double>{"\n-300., -1.\n0., 0.\n100., 1.\n", 200.0},
        {"\n-10., -1.\n30., 1.\n31., 2.\n", 20.0}}) {
    const FeModel model =
        sprung(with_spring("SPRINGA", "5, 6", ", NONLINEAR\n" + std::string(table)));
    ASSERT_EQ(model.springs.size(), 1u);
    EXPECT_EQ(model.springs[0].stiffness, k);
    EXPECT_TRUE(contains(model.notes, "*SPRING is not linear: its stiffness at zero elongation"));
  }
  const FeModel warm = sprung(with_spring("SPRINGA", "5, 6", "\n\n5., , 20.\n6., , 90.\n"));
  EXPECT_EQ(warm.springs.at(0).stiffness, 5.0);
  EXPECT_TRUE(contains(warm.notes, "depends on temperature: its first stiffness is taken"));
}

TEST(AbaqusSprings, Rods) {
  const FeModel model =
      sprung(springs_deck +
             "*ELEMENT, TYPE=T3D2, ELSET=T\n8, 5, 6\n*SOLID SECTION, ELSET=T, MATERIAL=A\n"
             "1e-4\n");
  ASSERT_EQ(model.elements.size(), 2u);
  EXPECT_EQ(model.elements[1].type, FeElementType::rod2);
  const MatX K = assemble(model).K;
  EXPECT_NEAR(K(12, 15) / (-2e11 * 1e-4 / 2.0), 1.0, 1e-14);
  // Without a section they are lines of the mesh.
  const FeModel skin = sprung(springs_deck + "*ELEMENT, TYPE=T3D2, ELSET=T\n8, 5, 6\n");
  EXPECT_EQ(skin.elements.size(), 1u);
  EXPECT_EQ(skin.node_sets.at("T").size(), 2u);
}

TEST(AbaqusSprings, DashpotsAndGaps) {
  const FeModel model =
      sprung(springs_deck + "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n8, 5, 6\n*DASHPOT, ELSET=D\n\n5.\n");
  EXPECT_TRUE(contains(model.notes, "1 dashpots are ignored, the part has modal damping"));
  const std::string gap =
      springs_deck + "*ELEMENT, TYPE=GAPUNI, ELSET=G\n8, 5, 6\n*GAP, ELSET=G\n0., 1.\n";
  EXPECT_EQ(error_of([&] { validate(sprung(gap)); }), "arm.inp:24: unsupported");
  FeReadOptions options;
  options.contact = DeckContact::ignore;
  EXPECT_TRUE(contains(sprung(gap, options).notes, "*GAP is ignored, as the options say"));
}

TEST(AbaqusSprings, Errors) {
  const std::pair<std::string, const char*> wrong[] = {
      {with_spring("SPRINGA", "2, 5", "\n\n5.\n"), "arm.inp:23: geometry"},
      {with_spring("SPRINGA", "5, 6", "\n"), "arm.inp:24: incomplete"},
      {with_spring("SPRING2", "5, 6", "\n1, 1\n"), "arm.inp:24: incomplete"},
      {with_spring("SPRING2", "5, 6", "\n1, 7\n5.\n"), "arm.inp:24: out_of_range"},
      {with_spring("SPRINGA", "5, 6", ", NONLINEAR\n1., 1.\n2., 2.\n"),
       "arm.inp:24: contradiction"},
      {with_spring("SPRINGA", "5, 6", ", COMPLEX STIFFNESS\n1., 1.\n"), "arm.inp:24: unsupported"},
      {with_spring("SPRINGA", "5, 9", "\n5.\n"), "arm.inp:23: not_found"},
      {with_spring("SPRING1", "5", "\n1\n5.\n"), "arm.inp:23: unsupported"},
      {springs_deck + "*ELEMENT, TYPE=SPRINGA, ELSET=S\n7, 5, 6\n", "arm.inp:23: missing"},
      {springs_deck + "*SPRING, ELSET=E\n5.\n", "arm.inp:22: wrong_value"},
      {springs_deck + "*ELEMENT, TYPE=T3D2, ELSET=T\n8, 5, 6\n*SOLID SECTION, ELSET=T, "
                      "MATERIAL=A\n",
       "arm.inp:24: incomplete"},
  };
  for (const auto& [text, expected] : wrong)
    EXPECT_EQ(error_of([&, &deck = text] { validate(sprung(deck)); }), expected) << text;
}

}  // namespace
}  // namespace floatframe::test

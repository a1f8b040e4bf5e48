// Constraints of decks - surfaces tied, equations in turned directions - against CalculiX 2.20: the
// frequencies of its *FREQUENCY step on the same deck (tests/data/decks), which it prints with
// seven digits, as cycles per second of mm-t-s.
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/fe/surface_ties.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

FeModel deck_model(const std::string& name, const FeReadOptions& options = {}) {
  return read_fe_file(std::filesystem::path(FLOATFRAME_TEST_DATA) / "decks" / name, options);
}

/// Hz in the units of the file.
VecX frequencies_of(const FeModel& model) {
  const FeSystem system = assemble(model, Integration::ccx);
  const VecX lambda = generalised_eigenvalues(MatX(system.K), MatX(system.M)).values;
  return lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

void expect_from(int first, const VecX& f, const std::vector<double>& expected) {
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(f(first + static_cast<int>(k)) / expected[k], 1.0, 5e-7)
        << k;  // half of the last digit
}

/// Largest part of the equations that rigid motions leave.
double rigid_remainder(const FeModel& model) {
  double worst = 0.0;
  for (int k = 0; k < 6; ++k) {
    Vec3 t = Vec3::Zero(), w = Vec3::Zero();
    (k < 3 ? t : w)(k % 3) = 1.0;
    for (const LinearEquation& e : model.equations) {
      double sum = 0.0;
      for (const LinearEquation::Term& term : e.terms) {
        const Vec3 u = t + w.cross(model.positions[term.node]);
        sum += term.factor * (term.axis < 3 ? u(term.axis) : w(term.axis - 3));
      }
      worst = std::max(worst, std::abs(sum));
    }
  }
  return worst;
}

TEST(DeckConstraints, TiedBlocksOfOtherMeshes) {
  const FeModel model = deck_model("tied_blocks.inp.gz");
  EXPECT_LT(rigid_remainder(model), 1e-12);
  expect_from(6, frequencies_of(model),
              {1.021567e5, 1.021567e5, 2.197274e5, 2.564301e5, 2.564301e5, 3.700720e5, 4.430554e5,
               4.549067e5});
}

TEST(DeckConstraints, TiedNodesAreMovedOntoTheFaces) {
  const FeModel model = deck_model("tied_blocks_gap.inp.gz");
  expect_from(6, frequencies_of(model),
              {1.016158e5, 1.016158e5, 2.191118e5, 2.551955e5, 2.551955e5, 3.690211e5, 4.417972e5,
               4.528348e5});
  EXPECT_TRUE(contains(model.notes,
                       "21 of 21 nodes of 'SLAVE' are tied to 'MASTER' (within 0.5); "
                       "they were moved by up to 0.02"));
}

/// CalculiX leaves a gap out of the equations, so that a turn of the part strains it (0.03 Hz in
/// place of 0, and frequencies as without the gap); here rigid motions stay free.
TEST(DeckConstraints, TiesAcrossAGapAreRigid) {
  const FeModel model = deck_model("tied_blocks_unadjusted.inp.gz");
  EXPECT_LT(rigid_remainder(model), 1e-12);
  const VecX f = frequencies_of(model);
  EXPECT_LT(f(5), 1.0);
  EXPECT_NEAR(f(6) / 1.021567e5, 1.0, 1e-3);
}

/// Cylindrical and rectangular directions; the equations hold some rigid motions.
TEST(DeckConstraints, EquationsInTurnedDirections) {
  expect_from(2, frequencies_of(deck_model("turned_directions.inp.gz")),
              {5.391086e4, 1.973315e5, 3.703853e5, 4.110574e5, 6.718790e5, 8.585386e5, 8.973684e5,
               9.181232e5});
}

const char* const pair_deck =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
    "11,0,0,1.01\n12,1,0,1.01\n13,1,1,1.01\n14,0,1,1.01\n15,0,0,2\n16,1,0,2\n17,1,1,2\n18,0,1,2\n"
    "*ELEMENT,TYPE=C3D8,ELSET=A\n1,1,2,3,4,5,6,7,8\n2,11,12,13,14,15,16,17,18\n"
    "*MATERIAL,NAME=M\n*ELASTIC\n1.,.3\n*DENSITY\n1.\n*SOLID SECTION,ELSET=A,MATERIAL=M\n"
    "*SURFACE,NAME=TOP\n1,S2\n*SURFACE,NAME=BOTTOM\n2,S1\n";

TEST(DeckConstraints, ContactPairsFollowTheOption) {
  TemporaryFolder folder;
  folder.write("two.inp", std::string(pair_deck) +
                              "*SURFACE INTERACTION,NAME=I\n"
                              "*CONTACT PAIR,INTERACTION=I\nBOTTOM,TOP\n");
  FeReadOptions options;
  EXPECT_EQ(test::without_folders(error_of([&] { read_fe_file(folder / "two.inp", options); })),
            "two.inp:32: unsupported");
  options.contact = DeckContact::ignore;
  EXPECT_EQ(read_fe_file(folder / "two.inp", options).equations.size(), 0u);
  options.contact = DeckContact::tied;
  const FeModel tied = read_fe_file(folder / "two.inp", options);
  EXPECT_EQ(tied.equations.size(), 12u);
  EXPECT_LT(rigid_remainder(tied), 1e-12);
  EXPECT_DOUBLE_EQ(tied.positions[8].z(), 1.01);  // nothing is moved
  options.contact_distance = 0.005;
  const FeModel apart = read_fe_file(folder / "two.inp", options);
  EXPECT_EQ(apart.equations.size(), 0u);
  EXPECT_TRUE(contains(apart.notes,
                       "0 of 4 nodes of 'BOTTOM' are tied to 'TOP' (within 0.005); "
                       "not tied: node 11, ..."));
}

TEST(DeckConstraints, ErrorsOfTiesAndTurnedDirections) {
  TemporaryFolder folder;
  const auto error = [&](const std::string& lines) {
    folder.write("bad.inp", pair_deck + lines);
    return folder.without(error_of([&] { read_fe_file(folder / "bad.inp"); }));
  };
  const std::pair<const char*, const char*> cases[] = {
      {"*TIE,NAME=T\nBOTTOM\n", "bad.inp:32: missing"},
      {"*TIE,NAME=T\n", "bad.inp:31: missing"},
      {"*TIE,NAME=T\nBOTTOM,TIP\n", "bad.inp:32: not_found"},
      {"*TIE,NAME=T,POSITION TOLERANCE=-1\nBOTTOM,TOP\n", "bad.inp:31: out_of_range"},
      {"*TIE,NAME=T,MULTISTAGE\nBOTTOM,TOP\n", "bad.inp:31: unsupported"},
      {"*SURFACE,NAME=N,TYPE=NODE\n5,\n*TIE,NAME=T\nBOTTOM,N\n", "bad.inp:34: wrong_value"},
      {"*NSET,NSET=P\n1\n*TRANSFORM,NSET=P,TYPE=S\n0,0,0,0,0,1\n", "bad.inp:33: wrong_value"},
      {"*NSET,NSET=P\n1\n*TRANSFORM,NSET=P\n1,0,0,2,0,0\n", "bad.inp:33: geometry"},
      {"*NSET,NSET=P\n1\n*TRANSFORM,NSET=P,TYPE=C\n1,0,0,1,0,0\n", "bad.inp:33: geometry"},
      {"*NSET,NSET=P\n1\n*TRANSFORM,NSET=P,TYPE=C\n1,0,0,1,0\n", "bad.inp:33: geometry"},
      {"*NSET,NSET=P\n1\n*TRANSFORM,NSET=P,TYPE=C\n0,0,0,0,0,1\n", "bad.inp:33: geometry"},
      {"*TRANSFORM,NSET=Q\n1,0,0,0,1,0\n", "bad.inp:31: not_found"},
      {"*NSET,NSET=P\n6\n*TRANSFORM,NSET=P\n1,1,0,0,1,0\n*NODE\n20,0,0,3\n"
       "*KINEMATIC COUPLING,REF NODE=20\nP,1,1\n",
       "bad.inp:37: unsupported"}};
  for (const auto& [lines, expected] : cases) EXPECT_EQ(error(lines), expected) << lines;
}

/// Two equations with the same first term, one of which says what others say already.
TEST(DeckConstraints, EquationsChooseWhatDepends) {
  TemporaryFolder folder;
  folder.write("e.inp", std::string(pair_deck) +
                            "*EQUATION\n2\n11,1,1.,5,1,-1.\n2\n11,1,1.,6,1,-1.\n"
                            "2\n5,1,1.,6,1,-1.\n3\n5,1,1.,6,1,1.,11,1,-2.\n");
  const FeSystem system = assemble(read_fe_file(folder / "e.inp"));
  EXPECT_EQ(system.size(), 16 * 3 - 2);
}

}  // namespace
}  // namespace floatframe::test

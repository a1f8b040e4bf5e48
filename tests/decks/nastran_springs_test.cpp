// Springs, bushings and rods of Nastran bulk data against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/deck_text.hpp"
#include "floatframe/fe/model_checks.hpp"

namespace floatframe::test {
namespace {

/// A tetrahedron at the origin that carries nothing: a deck needs an element.
const std::string block =
    "GRID,91,,10.,0.,0.\nGRID,92,,11.,0.,0.\nGRID,93,,10.,1.,0.\nGRID,94,,10.,0.,1.\n"  // 1 to 4
    "CTETRA,91,91,91,92,93,94\nPSOLID,91,91\nMAT1,91,2.+11,,.3,8000.\n";                // 5 to 7

/// Stiffness of the spring of two nodes (three or six directions each).
MatX between(const FeModel& model, int a, int b, int directions) {
  const FeSystem system = assemble(model);
  MatX K = MatX::Zero(2 * directions, 2 * directions);
  for (int i = 0; i < 2 * directions; ++i)
    for (int j = 0; j < 2 * directions; ++j) {
      const int row = system.row(i < directions ? a : b, i % directions),
                column = system.row(j < directions ? a : b, j % directions);
      if (row >= 0 && column >= 0) K(i, j) = system.K.coeff(row, column);
    }
  return K;
}

// n masses in a row, by turns CELAS1 and CELAS2; PELAS with two properties on a card.
TEST(NastranSprings, ChainOfMasses) {
  const int n = 6;
  std::string text = block + "PELAS,1,2.+4,.02,,2,7.\n";
  for (int i = 1; i <= n; ++i) {
    text += "GRID," + std::to_string(i) + ",,0." + std::to_string(i) + ",0.,0.\n";
    text += "CONM2," + std::to_string(50 + i) + "," + std::to_string(i) + ",,3.\n";
    const std::string ends = std::to_string(i - 1) + ",1," + std::to_string(i) + ",1\n";
    if (i > 1)
      text += i % 2 == 0 ? "CELAS1," + std::to_string(i) + ",1," + ends
                         : "CELAS2," + std::to_string(i) + ",2.+4," + ends;
  }
  FeModel model = valid_bdf(text);
  EXPECT_EQ(model.springs.size(), 5u);
  EXPECT_TRUE(contains(model.notes, "damping of springs and bushings (GE, B) is ignored"));
  model.elements.clear();
  const VecX lambda = free_eigenvalues(model);
  ASSERT_EQ(lambda.size(), 3 * n);
  for (int j = 1; j < n; ++j) {
    const double s = 2 * std::sin(j * std::numbers::pi / (2 * n));
    EXPECT_NEAR(lambda(2 * n + j) / (2e4 / 3 * s * s), 1.0, 1e-12);
  }
}

// Directions are those of CD, here a cylinder about z: 1 is radial.
TEST(NastranSprings, DirectionsOfTheNodes) {
  const std::string turned = block +
                             "CORD2C,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                             "GRID,1,,3.,4.,0.,5\nGRID,2,,3.,4.,0.,5\nCONM2,51,1,,1.\n"
                             "CONM2,52,2,,1.\nCELAS2,3,50.,1,1,2,2\n";
  const FeModel model = read_bdf(turned);
  const MatX K = between(model, model.nodes() - 2, model.nodes() - 1, 3);
  VecX d(6);
  d << -0.6, -0.8, 0, -0.8, 0.6, 0;  // - radial of the first, around of the second
  EXPECT_LT((K - 50.0 * d * d.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

/// Two bodies with rotations and a CBUSH between them.
std::string bush(const std::string& card, const std::string& property) {
  return block +
         "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCORD2R,7,,0.,0.,0.,1.,0.,0.\n,0.,0.,1.\n"
         "CONM2,51,1,,1.\n,1.,,1.,,,1.\nCONM2,52,2,,1.\n,1.,,1.,,,1.\n" +
         card + "\nPBUSH,8,K," + property + "\n";
}

TEST(NastranSprings, Bushings) {
  const auto matrix = [](const std::string& card, const std::string& k) {
    const FeModel model = valid_bdf(bush(card, k));
    return between(model, model.nodes() - 2, model.nodes() - 1, 6);
  };
  const std::string six = "10.,20.,30.,1.,2.,3.";
  // x along the line, the vector in the plane of y: K1 of ux, K2 of uz, K3 of -uy. S in the middle.
  MatX K = matrix("CBUSH,3,8,1,2,0.,0.,1.", six);
  EXPECT_NEAR(K(0, 0), 10.0, 1e-13);
  EXPECT_NEAR(K(2, 2), 20.0, 1e-13);
  EXPECT_NEAR(K(1, 1), 30.0, 1e-13);
  EXPECT_NEAR(K(3, 3), 1.0, 1e-13);
  EXPECT_NEAR(K(4, 4), 3.0 + 20.0 * 1.0, 1e-13);  // about y: K6, and K2 (uz) at an arm of 1
  EXPECT_NEAR(K(5, 5), 2.0 + 30.0 * 1.0, 1e-13);
  EXPECT_NEAR(K(2, 4), -20.0, 1e-13);
  EXPECT_NEAR(K(8, 10), 20.0, 1e-13);
  // At the quarter, the node GO.
  K = matrix("CBUSH,3,8,1,2,94\n,.25", six);
  EXPECT_GT(std::abs(K(4, 4) - 23.0), 1.0);
  EXPECT_NEAR(K(5, 5) + K(4, 4), 2.0 + 3.0 + 0.25 * (20.0 + 30.0), 1e-12);
  // A system: x of 7 is global y, its z global x; the place by OCID.
  K = matrix("CBUSH,3,8,1,2,,,,7\n,,7,0.,0.,2.", six);
  const MatX expected = K;
  EXPECT_NEAR(K(2, 2), 10.0, 1e-13);  // x of the system: towards its point C, global z
  EXPECT_NEAR(K(1, 1), 20.0, 1e-13);
  EXPECT_NEAR(K(0, 0), 30.0, 1e-13);
  EXPECT_NEAR(K(10, 10), 2.0, 1e-13);             // at the second node: no arm
  EXPECT_NEAR(K(4, 4), 2.0 + 10.0 * 4.0, 1e-13);  // an arm of 2
  // Blank fields: along the line only.
  K = matrix("CBUSH,3,8,1,2", "10.,,,1.");
  EXPECT_NEAR(K(0, 0), 10.0, 1e-13);
  EXPECT_NEAR(K(3, 3), 1.0, 1e-13);
  EXPECT_EQ(K(1, 1), 0.0);
  EXPECT_TRUE(contains(read_bdf(bush("CBUSH,3,8,1,2", "10.\n,,B,5.\n,,GE,.01")).notes,
                       "damping of springs and bushings (GE, B) is ignored"));
}

// Along the line of the nodes, or axis 1 of CID.
TEST(NastranSprings, BushingsOfOneDirection) {
  const auto direction = [](const std::string& card, const std::string& more = "") {
    const FeModel model =
        valid_bdf(block +
                  "GRID,1,,0.,0.,0.\nGRID,2,,3.,4.,0.\nCONM2,51,1,,1.\nCONM2,52,2,,1.\n"
                  "CORD2R,7,,0.,0.,0.,1.,0.,0.\n,0.,0.,1.\n" +
                  card + "\nPBUSH1D,8,50." + more + "\n");
    return MatX(between(model, 4, 5, 3) / 50.0);
  };
  VecX d(6);
  d << -.6, -.8, 0, .6, .8, 0;
  EXPECT_LT((direction("CBUSH1D,3,8,1,2") - d * d.transpose()).norm(), 1e-13);
  EXPECT_LT((direction("CBUSH1D,3,8,1,2", ",7.\n,SHOCKA,TABLE,1.") - d * d.transpose()).norm(),
            1e-13);
  d << 0, 0, -1, 0, 0, 1;
  EXPECT_LT((direction("CBUSH1D,3,8,1,2,7") - d * d.transpose()).norm(), 1e-13);
  d << -1, 0, 0, 1, 0, 0;
  EXPECT_LT((direction("CBUSH1D,3,8,1,2,0") - d * d.transpose()).norm(), 1e-13);
}

/// A row of n rods of length 0.5 from node 1 on, along y.
std::string rods_of(const std::string& kind, int n, const std::string& property) {
  std::string text = "MAT1,1,2.1+11,,.3,7800.\n" + property + "\nGRID,1,,0.,0.,0.\n";
  for (int i = 1; i <= n; ++i)
    text += "GRID," + std::to_string(i + 1) + ",,0.," + std::to_string(0.5 * i) + ",0.\n" + kind +
            "," + std::to_string(i) + (kind == "CONROD" ? "," : ",4,") + std::to_string(i) + "," +
            std::to_string(i + 1) + (kind == "CONROD" ? ",1,2.-4,,,.78" : "") + "\n";
  return text;
}

TEST(NastranSprings, Rods) {
  const int n = 5;
  const double A = 2e-4, m = (7800.0 * A + 0.78) * 0.5, k = 2.1e11 * A / 0.5;
  for (const std::string kind : {"CROD", "CONROD"}) {
    for (const bool coupled : {false, true}) {
      const FeModel model =
          valid_bdf(rods_of(kind, n, kind == "CROD" ? "PROD,4,1,2.-4,,,.78" : "") +
                    (coupled ? "PARAM,COUPMASS,1\n" : ""));
      EXPECT_NEAR(volume_times_density(model), n * m, 1e-12);
      const VecX lambda = free_eigenvalues(model);
      for (int j = 1; j <= n; ++j) {
        const double c = std::cos(j * std::numbers::pi / n);
        EXPECT_NEAR(
            lambda(2 * (n + 1) + j) / (k * (2 - 2 * c) / (coupled ? m / 6 * (4 + 2 * c) : m)), 1.0,
            1e-9);
      }
      EXPECT_EQ(model.element_sets.contains("PID 4"), kind == "CROD");
      EXPECT_EQ(model.element_sets.size(), kind == "CROD" ? 1u : 0u);
    }
  }
  const FeModel tube = read_bdf(rods_of("CTUBE", 2, "PTUBE,4,1,.1,.01"));
  EXPECT_NEAR(tube.sections.at(0).A, std::numbers::pi / 4 * (0.01 - 0.0064), 1e-15);
  // Torsion, with the G of the material: two bodies on a shaft of two rods.
  const FeModel shaft = read_bdf(
      "MAT1,1,2.1+11,8.+10,.3,7800.\nPROD,4,1,1.-4,2.-8\nGRID,1,,0.,0.,0.\nGRID,2,,0.,1.,0.\n"
      "GRID,3,,0.,2.,0.\nCROD,1,4,1,2\nCROD,2,4,2,3\nRBE2,10,1,123456,11,12,13\n"
      "GRID,11,,1.,0.,0.\nGRID,12,,0.,0.,1.\nGRID,13,,-1.,0.,0.\n"
      "RBE2,20,3,123456,21,22,23\nGRID,21,,1.,2.,0.\nGRID,22,,0.,2.,1.\nGRID,23,,-1.,2.,0.\n");
  const FeSystem system = assemble(shaft);
  EXPECT_NEAR(system.K.coeff(system.row(0, 4), system.row(0, 4)), 0.5 * 8e10 * 2e-8, 1e-6);
  EXPECT_NEAR(system.K.coeff(system.row(0, 4), system.row(2, 4)), -0.5 * 8e10 * 2e-8, 1e-6);
}

TEST(NastranSprings, Errors) {
  const std::pair<std::string, const char*> wrong[] = {
      {"CELAS2,3,5.,91,1", "arm.bdf:8: unsupported"},
      {"CELAS2,3,5.,91,1,92", "arm.bdf:8: missing"},
      {"CELAS2,3,5.,91,12,92,1", "arm.bdf:8: out_of_range"},
      {"CELAS2,3,,91,1,92,1", "arm.bdf:8: missing"},
      {"CELAS2,3,-5.,91,1,92,1", "arm.bdf:8: out_of_range"},
      {"CELAS1,3,9,91,1,92,1", "arm.bdf:8: not_found"},
      {"CELAS1,3,9", "arm.bdf:8: missing"},
      {"CELAS2,3,5.,91,1,97,1", "arm.bdf:8: not_found"},
      {"CELAS2,3,5.,91,1,92,1\nCELAS2,3,5.,91,1,93,1", "arm.bdf:9: duplicate"},
      {"CBUSH,3,8,91,92,0.,0.,1.", "arm.bdf:8: not_found"},
      {"CBUSH,3,8,91,92\nPBUSH,8,K,1.,2.", "arm.bdf:8: incomplete"},
      {"CBUSH,3,8,91,92,1.,0.,0.\nPBUSH,8,K,1.,2.", "arm.bdf:8: geometry"},
      {"CBUSH,3,8,91\nPBUSH,8,K,1.,2.", "arm.bdf:8: incomplete"},
      {"GRID,95,,10.,0.,0.\nCBUSH,3,8,91,95\nPBUSH,8,K,1.,2.", "arm.bdf:9: incomplete"},
      {"CBUSH1D,3,8,91,92", "arm.bdf:8: not_found"},
      {"CBUSH1D,3,8,91\nPBUSH1D,8,1.", "arm.bdf:8: incomplete"},
      {"CBUSH1D,3,8,91,,0\nPBUSH1D,8,1.", "arm.bdf:8: unsupported"},
      {"PBUSH1D,8,1.,,2.", "arm.bdf:8: unsupported"},
      {"PBUSH1D,8,1.\n,SPRING,TABLE,4", "arm.bdf:8: unsupported"},
      {"PBUSH,8,M,1.", "arm.bdf:8: unsupported"},
      {"PBUSH,8,K,RIGID", "arm.bdf:8: not_a_number"},
      {"CROD,3,9,91,92", "arm.bdf:8: not_found"},
      {"CROD,3,91,91,92", "arm.bdf:8: wrong_value"},
      {"CONROD,3,91,92,91", "arm.bdf:8: missing"},
      {"CONROD,3,91,92,91,-1.", "arm.bdf:8: out_of_range"},
      {"PTUBE,4,91,.1,.06", "arm.bdf:8: geometry"},
      {"PTUBE,4,91,.1,.01,,.2", "arm.bdf:8: unsupported"},
  };
  for (const auto& [card, expected] : wrong)
    EXPECT_EQ(invalid_bdf(block + card + "\n"), expected) << card;
  EXPECT_TRUE(contains(read_bdf(block + "CDAMP2,1,5.,91,1\nCVISC,2,3,91,92\n").notes,
                       "dampers are ignored, the part has modal damping (--damping): 1 CDAMP2, "
                       "1 CVISC"));
}

}  // namespace
}  // namespace floatframe::test

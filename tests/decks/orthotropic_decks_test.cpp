// Orthotropic and anisotropic solids of decks against CalculiX 2.20. The numbers are those that it
// prints for the decks of tests/data/fe as they stand (*FREQUENCY with 16 modes: the last ten), and
// for the same decks with one end held and a force on the farthest node (*STATIC, *NODE PRINT).
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/dense.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

/// Free frequencies without the rigid ones. The mass may be singular, K + s M is not.
std::vector<double> frequencies(const FeSystem& system, std::size_t count) {
  const MatX K = system.K, M = system.M;
  const double s = K.trace() / M.trace() * 1e-6;
  const VecX mu = generalised_eigenvalues(M, K + s * M).values;
  std::vector<double> out;
  for (Eigen::Index k = mu.size() - 7; out.size() < count; --k)
    out.push_back(std::sqrt(1.0 / mu(k) - s) / (2.0 * std::numbers::pi));
  return out;
}

struct Reference {
  const char* deck;
  double frequency[10];
};

const Reference free_decks[] = {{"orthotropic_hex20.inp.gz",
                                 {9557.531, 15223.59, 20662.64, 24255.21, 33482.49, 37118.57,
                                  41055.80, 44671.97, 61664.94, 63901.46}},
                                {"orthotropic_ring.inp.gz",
                                 {14143.87, 15347.41, 20906.37, 30927.37, 36955.71, 40223.50,
                                  44349.38, 53890.12, 65425.61, 69082.66}},
                                {"anisotropic_tet10.inp.gz",
                                 {11092.55, 17248.64, 25120.47, 32490.62, 37358.09, 45602.36,
                                  55145.59, 59486.72, 73942.06, 79230.76}},
                                {"orthotropic_hex8.inp.gz",
                                 {19456.52, 20473.02, 23026.41, 41682.85, 44119.57, 52181.09,
                                  53894.42, 70750.79, 83109.20, 86469.98}}};

TEST(OrthotropicDecks, FrequenciesOfCalculix) {
  for (const Reference& r : free_decks) {
    SCOPED_TRACE(r.deck);
    const FeModel model = read_fe_file(fe_data(r.deck));
    validate(model);
    const auto found = frequencies(assemble(model, Integration::ccx), 10);
    for (std::size_t k = 0; k < 10; ++k) EXPECT_NEAR(found[k] / r.frequency[k], 1.0, 2e-6) << k;
  }
}

struct Loaded {
  const char* deck;
  int tip;
  Vec3 displacement;
};

TEST(OrthotropicDecks, StaticDisplacementsOfCalculix) {
  const Loaded decks[] = {
      {"orthotropic_hex20.inp.gz", 84, {1.018561e-2, 1.839188e-2, -1.002825e-1}},
      {"orthotropic_ring.inp.gz", 45, {2.960657e-2, 1.447555e-2, -6.584672e-2}},
      {"anisotropic_tet10.inp.gz", 16, {9.953165e-3, 1.657993e-2, -9.558640e-2}}};
  for (const Loaded& d : decks) {
    SCOPED_TRACE(d.deck);
    const FeModel model = read_fe_file(fe_data(d.deck));
    MatX K = assemble(model, Integration::ccx).K;
    const bool ring = std::string(d.deck).find("ring") != std::string::npos;
    for (int k = 0; k < model.nodes(); ++k) {
      if (std::abs(model.positions[k](ring ? 1 : 0)) > 1e-9) continue;
      for (int row = 3 * k; row < 3 * k + 3; ++row) {
        K.row(row).setZero();
        K.col(row).setZero();
        K(row, row) = 1e5;
      }
    }
    VecX f = VecX::Zero(K.rows());
    f.segment<3>(3 * (d.tip - 1)) << 3.0, 5.0, -7.0;
    const Vec3 u = K.ldlt().solve(f).segment<3>(3 * (d.tip - 1));
    EXPECT_LT((u - d.displacement).norm(), 1e-6 * d.displacement.norm());
  }
}

// The part in SI units, and turned as a whole: the same frequencies.
TEST(OrthotropicDecks, UnitsAndTurns) {
  FeModel model = read_fe_file(fe_data("orthotropic_ring.inp.gz"));
  const auto expected = frequencies(assemble(model), 3);
  to_si(model, *find_unit_system("mm-t-s"));
  const Mat3 R = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& p : model.positions) p = R * p + Vec3(1, 2, 3);
  for (Orientation& o : model.orientations) {
    o.axes = R * o.axes;
    o.origin = R * o.origin + Vec3(1, 2, 3);
  }
  const auto found = frequencies(assemble(model), 3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / expected[k], 1.0, 1e-9);
}

}  // namespace
}  // namespace floatframe::test

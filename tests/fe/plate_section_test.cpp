// Sections of plates: torsion against series and another formulation of it, shear and shear centres
// against those of thin walls.
#include "floatframe/fe/plate_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "floatframe/math/sparse_factors.hpp"

namespace floatframe {
namespace {

using Plates = std::vector<SectionPlate>;

SectionPlate between(double y0, double y1, double z0, double z1) {
  return {0.5 * (y0 + y1), 0.5 * (z0 + z1), y1 - y0, z1 - z0};
}

/// J = 2 int phi, laplacian phi = -2, phi = 0 on the boundary: by differences on squares of side h,
/// which all edges are multiples of.
double stress_function_torsion(const Plates& plates, double h) {
  const auto inside = [&](double y, double z) {
    for (const SectionPlate& p : plates)
      if (std::abs(y - p.y) < 0.5 * p.height && std::abs(z - p.z) < 0.5 * p.width) return true;
    return false;
  };
  std::map<std::pair<int, int>, int> number;
  const auto free = [&](int i, int j) {  // all four squares around it are of the section
    for (const double a : {-0.5, 0.5})
      for (const double b : {-0.5, 0.5})
        if (!inside((i + a) * h, (j + b) * h)) return false;
    return true;
  };
  for (const SectionPlate& p : plates)
    for (int i = static_cast<int>(std::lround((p.y - 0.5 * p.height) / h));
         i * h <= p.y + 0.5 * p.height + 1e-9; ++i)
      for (int j = static_cast<int>(std::lround((p.z - 0.5 * p.width) / h));
           j * h <= p.z + 0.5 * p.width + 1e-9; ++j)
        if (free(i, j)) number.try_emplace({i, j}, static_cast<int>(number.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [at, row] : number) {
    entries.emplace_back(row, row, 4.0);
    for (const auto& [a, b] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (const auto it = number.find({at.first + a, at.second + b}); it != number.end())
        entries.emplace_back(row, it->second, -1.0);
  }
  const auto n = static_cast<Eigen::Index>(number.size());
  Eigen::SparseMatrix<double> K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  const MatX phi = SparseFactors(K).solve(MatX::Constant(n, 1, 2.0 * h * h));
  return 2.0 * phi.sum() * h * h;
}

const Plates unequal_i = {between(-4, 4, 0, 1), between(-0.5, 0.5, 1, 9), between(-3, 3, 9, 11)};
const Plates angle = {between(0, 6, 0, 1), between(0, 2, 1, 8)};
const Plates channel = {between(0, 1, 0, 10), between(1, 4, 0, 1), between(1, 6, 9, 10)};

TEST(PlateSection, TorsionOfRectanglesIsThatOfTheSeries) {
  for (const double b : {1.0, 0.5, 0.1}) {
    double sum = 0.0;
    for (int n = 1; n < 40; n += 2)
      sum += std::tanh(0.5 * n * std::numbers::pi / b) / std::pow(n, 5);
    const double exact = b * b * b * (1.0 / 3.0 - 64.0 * b / std::pow(std::numbers::pi, 5) * sum);
    const SectionFlow f = section_flow(Plates{between(0, 1, 0, b)});
    ASSERT_TRUE(f.found);
    EXPECT_NEAR(f.J, exact, 5e-4 * exact) << b;
    EXPECT_NEAR(f.shear_flexibility(0, 0) * b, 1.2, 5e-4 * 1.2);
    EXPECT_NEAR(f.shear_flexibility(1, 1) * b, 1.2, 5e-4 * 1.2);
    EXPECT_NEAR(f.center_y, 0.5, 1e-12);
  }
}

/// Displacements give J from above, the stress function from below; squares of three sizes give its
/// limit (Aitken).
TEST(PlateSection, TorsionOfOpenSectionsIsThatOfTheStressFunction) {
  for (const Plates& plates : {unequal_i, angle, channel}) {
    const double coarse = stress_function_torsion(plates, 1.0 / 8.0),
                 middle = stress_function_torsion(plates, 1.0 / 16.0),
                 fine = stress_function_torsion(plates, 1.0 / 32.0), step = fine - middle,
                 limit = fine - step * step / (step - (middle - coarse));
    const SectionFlow f = section_flow(plates);
    ASSERT_TRUE(f.found);
    EXPECT_GT(f.J, fine);
    EXPECT_NEAR(f.J, limit, 1e-3 * limit);
    const PlateSums s = plate_sums(plates);
    EXPECT_GT(std::abs(s.thin_J / f.J - 1.0), 0.01);  // what thin plates alone would give
  }
}

TEST(PlateSection, ThinWalls) {
  const double t = 0.01, b = 1.0, h = 2.0;  // of middle lines
  const Plates thin_channel = {between(-t / 2, t / 2, -t / 2, h + t / 2),
                               between(t / 2, b, -t / 2, t / 2),
                               between(t / 2, b, h - t / 2, h + t / 2)};
  const SectionFlow c = section_flow(thin_channel);
  EXPECT_NEAR(c.center_y, -3.0 * b * b / (6.0 * b + h), 1e-3);
  EXPECT_NEAR(c.center_z, h / 2.0, 1e-9);
  EXPECT_NEAR(c.J, plate_sums(thin_channel).thin_J, 0.01 * c.J);
  // Walls of 1: ends and corners count for less than 0.2 beside what thin plates have.
  for (const double size : {1e2, 1e3, 9e3}) {
    const Plates wide = {between(-size / 2, size / 2, 0, 1), between(-0.5, 0.5, 1, size - 1),
                         between(-size / 2, size / 2, size - 1, size)};
    EXPECT_NEAR(section_flow(wide).J, size - 2.0 / 3.0, 0.2 + 1e-3 * size) << size;
  }
  const double a = 1.0;
  const Plates box = {
      between(-t / 2, a + t / 2, -t / 2, t / 2), between(-t / 2, a + t / 2, a - t / 2, a + t / 2),
      between(-t / 2, t / 2, t / 2, a - t / 2), between(a - t / 2, a + t / 2, t / 2, a - t / 2)};
  const SectionFlow f = section_flow(box);
  EXPECT_NEAR(f.J, bredt_torsion(a + t, a + t, t, t, t, t), 0.01 * f.J);
  // Shear flow of a square box: F A = 2.4
  EXPECT_NEAR(f.shear_flexibility(0, 0) * plate_sums(box).A, 2.4, 0.02 * 2.4);
  EXPECT_NEAR(f.shear_flexibility(0, 1), 0.0, 1e-6 * f.shear_flexibility(0, 0));
  const SectionFlow corner =
      section_flow(Plates{between(0, 1, -t / 2, t / 2), between(0, t, t / 2, 1)});
  EXPECT_NEAR(corner.center_y, t / 2, t / 10);  // where the middle lines meet
  EXPECT_NEAR(corner.center_z, 0.0, t / 10);
}

/// A section far from the origin, mirrored, turned: the same numbers.
TEST(PlateSection, PlaceAndDirectionDoNotMatter) {
  const SectionFlow f = section_flow(channel);
  Plates far = channel, turned = channel;
  for (SectionPlate& p : far) {
    p.y += 100.0;
    p.z -= 30.0;
  }
  for (SectionPlate& p : turned) p = {-p.z, p.y, p.width, p.height};
  const SectionFlow g = section_flow(far), q = section_flow(turned);
  EXPECT_NEAR(g.J, f.J, 1e-8 * f.J);
  EXPECT_NEAR(g.center_y, f.center_y + 100.0, 1e-7);
  EXPECT_NEAR(g.center_z, f.center_z - 30.0, 1e-7);
  EXPECT_NEAR(q.J, f.J, 1e-10 * f.J);
  EXPECT_NEAR(q.center_y, -f.center_z, 1e-9);
  EXPECT_NEAR(q.center_z, f.center_y, 1e-9);
  EXPECT_NEAR(q.shear_flexibility(0, 1), -f.shear_flexibility(0, 1), 1e-10);
}

TEST(PlateSection, NoSection) {
  EXPECT_FALSE(section_flow(Plates{between(0, 1, 0, 1e-7)}).found);
  EXPECT_FALSE(section_flow(Plates{between(0, 1e100, 0, 1e100)}).found);
  EXPECT_FALSE(section_flow(Plates{between(0, 1, 0, 1), between(2, 3, 0, 1)}).found);
}

}  // namespace
}  // namespace floatframe

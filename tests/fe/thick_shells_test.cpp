// Transverse shear of shells: patch tests, and Navier's solution of a thick supported plate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "support/midside_sheets.hpp"
#include "support/random_body.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr FeElementType all_shells[] = {FeElementType::tri3, FeElementType::quad4,
                                        FeElementType::tri6, FeElementType::quad8};

/// A sheet of corners or with nodes on its edges, of n x n cells between corners or middles.
template <class Map>
MidsideSheet any_sheet(FeElementType type, int n, const Map& map, const Material& m, double h) {
  MidsideSheet s;
  if (type == FeElementType::tri6 || type == FeElementType::quad8) {
    s = midside_sheet(type, n / 2, n / 2, map, m, h);
  } else {
    s.model = sheet(type, n, n, map, m, h);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) s.node[{i, j}] = i + (n + 1) * j;
  }
  s.model.shells[0].shear = 5.0 / 6.0 * h;
  return s;
}

// Constant curvature, without shear, is exact whatever the thickness.
TEST(ThickShells, ConstantCurvature) {
  const Material steel{2e11, 0.3, 7850};
  for (const double h : {0.001, 0.1, 2.0})
    for (const FeElementType type : all_shells) {
      SCOPED_TRACE(fe_element_name(type));
      Random random(6);
      MidsideSheet s = any_sheet(
          type, 6, [](double x, double y) { return Vec3(x, 0.8 * y, 0); }, steel, h);
      std::vector<int> inner;
      for (const auto& [place, node] : s.node) {
        const auto& [i, j] = place;
        if (i == 0 || j == 0 || i == 6 || j == 6) continue;
        const Vec3 shift = random.vec3(0.02);
        s.model.positions[node] += Vec3(shift(0), shift(1), 0);
        inner.push_back(node);
      }
      VecX bent(6 * s.model.nodes());
      for (int k = 0; k < s.model.nodes(); ++k) {
        const double x = s.model.positions[k](0), y = s.model.positions[k](1);
        bent.segment<6>(6 * k) << 0, 0, 0.4 * x * x + 0.3 * x * y - 0.2 * y * y, 0.3 * x - 0.4 * y,
            -(0.8 * x + 0.3 * y), 0;
      }
      validate(s.model);
      const VecX f = assemble(s.model).K * bent;
      for (const int node : inner) EXPECT_LT(f.segment<6>(6 * node).norm(), 1e-10 * f.norm());
    }
}

/// Middle of a supported square plate under unit pressure, by Navier's series of Mindlin's plate.
double navier(const Material& m, double a, double h) {
  const double D = m.young * h * h * h / (12 * (1 - m.poisson * m.poisson));
  const double S = 5.0 / 6.0 * m.shear() * h;
  double w = 0.0;
  for (int i = 1; i < 400; i += 2)
    for (int j = 1; j < 400; j += 2) {
      const double k2 = pi * pi * (i * i + j * j) / (a * a);
      const double sign = (i + j) / 2 % 2 == 1 ? 1.0 : -1.0;
      w += sign * 16 / (pi * pi * i * j) / (D * k2 * k2) * (1 + D * k2 / S);
    }
  return w;
}

double middle(FeElementType type, int n, double h, const Material& m) {
  const MidsideSheet s = any_sheet(
      type, n, [](double x, double y) { return Vec3(0.5 * x, 0.5 * y, 0); }, m, h);
  std::vector<Held> held;
  for (const auto& [place, node] : s.node) {
    unsigned mask = 1u | 2u | 32u;
    if (place.first == 0) mask |= 16u;
    if (place.second == 0) mask |= 8u;
    if (place.first == n) mask |= 4u | 8u;
    if (place.second == n) mask |= 4u | 16u;
    held.push_back({node, mask});
  }
  const FeSystem system = assemble(s.model);
  VecX up = VecX::Zero(system.size());
  for (int k = 0; k < s.model.nodes(); ++k) up(6 * k + 2) = 1.0 / (m.density * h);
  return solve(s.model, held, system.M * up)(6 * s.node.at({0, 0}) + 2);
}

// From thin to a fifth of the width: no locking, and the share of shear (23 % of the deflection of
// the thickest) is there.
TEST(ThickShells, SupportedPlate) {
  const Material m{2e11, 0.3, 7850};
  for (const double h : {0.001, 0.05, 0.2})
    for (const FeElementType type : all_shells) {
      SCOPED_TRACE(std::string(fe_element_name(type)) + " " + std::to_string(h));
      const double exact = navier(m, 1.0, h);
      const double e8 = middle(type, 8, h, m) / exact - 1, e16 = middle(type, 16, h, m) / exact - 1;
      RecordProperty(fe_element_name(type) + std::to_string(h),
                     std::to_string(e8) + " " + std::to_string(e16));
      EXPECT_LT(std::abs(e8), 0.01);
      EXPECT_LT(std::abs(e16), 0.0025);
    }
}

}  // namespace
}  // namespace floatframe::test

// Shells with nodes on their edges: patch tests, plates and curved shells with measured orders.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "support/midside_sheets.hpp"
#include "support/random_body.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

constexpr FeElementType with_middles[] = {FeElementType::tri6, FeElementType::quad8};

// Constant membrane strain and constant curvature of an irregular patch, whose nodes on edges are
// off their middles too.
TEST(MidsideShells, PatchTests) {
  const Material steel{2e11, 0.3, 7850};
  Random random(5);
  const Mat3 R = random.rotation();
  for (const FeElementType type : with_middles) {
    MidsideSheet s = midside_sheet(
        type, 3, 3, [](double x, double y) { return Vec3(x, 0.8 * y, 0); }, steel, 0.01);
    FeModel& model = s.model;
    std::vector<int> inner;
    for (const auto& [place, node] : s.node) {
      const auto& [i, j] = place;
      if (i == 0 || j == 0 || i == 6 || j == 6) continue;
      const Vec3 shift = random.vec3(0.02);
      model.positions[node] += Vec3(shift(0), shift(1), 0);
      inner.push_back(node);
    }
    VecX flat(6 * model.nodes()), bent(6 * model.nodes());
    for (int k = 0; k < model.nodes(); ++k) {
      const double x = model.positions[k](0), y = model.positions[k](1);
      flat.segment<6>(6 * k) << 0.3 * x + 0.2 * y, -0.1 * x + 0.5 * y, 0, 0, 0, -0.15;
      bent.segment<6>(6 * k) << 0, 0, 0.4 * x * x + 0.3 * x * y - 0.2 * y * y, 0.3 * x - 0.4 * y,
          -(0.8 * x + 0.3 * y), 0;
    }
    for (Vec3& p : model.positions) p = R * p;
    validate(model);
    for (VecX* u : {&flat, &bent}) {
      for (int i = 0; i < 2 * model.nodes(); ++i)
        u->segment<3>(3 * i) = (R * u->segment<3>(3 * i)).eval();
      const VecX f = assemble(model).K * *u;
      for (const int node : inner) EXPECT_LT(f.segment<6>(6 * node).norm(), 1e-10 * f.norm());
    }
  }
}

/// Middle of a simply supported square plate under pressure over q a^4/D; a quarter, n x n.
double plate_middle(FeElementType type, int n) {
  const Material material{2e11, 0.3, 7850};
  const double a = 1.0, h = 0.005;
  const MidsideSheet s = midside_sheet(
      type, n, n, [&](double x, double y) { return Vec3(0.5 * a * x, 0.5 * a * y, 0); }, material,
      h);
  std::vector<Held> held;
  for (const auto& [place, node] : s.node) {
    unsigned mask = 1u | 2u | 32u;
    if (place.first == 0) mask |= 16u;
    if (place.second == 0) mask |= 8u;
    if (place.first == 2 * n) mask |= 4u | 8u;
    if (place.second == 2 * n) mask |= 4u | 16u;
    held.push_back({node, mask});
  }
  const FeSystem system = assemble(s.model);
  VecX up = VecX::Zero(system.size());
  for (int k = 0; k < s.model.nodes(); ++k) up(6 * k + 2) = 1.0 / (7850 * h);
  const VecX u = solve(s.model, held, system.M * up);
  const double D = 2e11 * h * h * h / (12 * (1 - 0.09));
  return u(6 * s.node.at({0, 0}) + 2) * D;
}

TEST(MidsideShells, SupportedPlate) {
  for (const FeElementType type : with_middles) {
    SCOPED_TRACE(fe_element_name(type));
    const double exact = 0.00406235;  // Timoshenko, Woinowsky-Krieger (1959), table 8
    const double e4 = plate_middle(type, 4) / exact - 1, e8 = plate_middle(type, 8) / exact - 1;
    RecordProperty(fe_element_name(type), std::to_string(e4) + " " + std::to_string(e8));
    EXPECT_LT(std::abs(e4), 0.004);
    EXPECT_LT(std::abs(e8), 0.001);
    EXPECT_LT(std::abs(e8 / e4), 0.35);  // a quarter; tri6 is below 4e-4 already
  }
}

/// Middle of the free edge of the roof of Scordelis and Lo, a quarter with n x n cells.
double roof(FeElementType type, int n) {
  const Material material{4.32e8, 0.0, 1.0};
  const MidsideSheet s = midside_sheet(
      type, n, n,
      [](double x, double y) {
        const double angle = 40.0 * std::numbers::pi / 180.0 * y;
        return Vec3(25.0 * x, 25.0 * std::sin(angle), 25.0 * std::cos(angle));
      },
      material, 0.25);
  std::vector<Held> held;
  for (const auto& [place, node] : s.node) {
    if (place.first == 0) held.push_back({node, 1u | 16u | 32u});
    if (place.first == 2 * n) held.push_back({node, 2u | 4u});
    if (place.second == 0) held.push_back({node, 2u | 8u | 32u});
  }
  const FeSystem system = assemble(s.model);
  VecX down = VecX::Zero(system.size());
  for (int k = 0; k < s.model.nodes(); ++k) down(6 * k + 2) = -360.0;
  const VecX u = solve(s.model, held, system.M * down);
  return -u(6 * s.node.at({0, 2 * n}) + 2);
}

// The same as the shells of their corners with twice as many of them.
TEST(MidsideShells, ScordelisLoRoof) {
  for (const FeElementType type : with_middles) {
    SCOPED_TRACE(fe_element_name(type));
    const double w4 = roof(type, 4), w8 = roof(type, 8);
    RecordProperty(fe_element_name(type), std::to_string(w4) + " " + std::to_string(w8));
    EXPECT_NEAR(w4 / 0.3024, 1.0, 0.009);
    EXPECT_NEAR(w8 / 0.3024, 1.0, 0.0075);
  }
}

}  // namespace
}  // namespace floatframe::test

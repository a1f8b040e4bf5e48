// Stress of shells in the textbook problems.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/body/fe_stress.hpp"
#include "floatframe/fe/surface.hpp"
#include "support/midside_sheets.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

/// Top and bottom of all nodes: 12 rows each, in the order of the nodes.
MatX sides_of(const FeModel& model, const VecX& u) {
  StressFields fields;
  fields.displacements = {MatX(3 * model.nodes(), 1), MatX(3 * model.nodes(), 1)};
  for (int k = 0; k < model.nodes(); ++k) {
    fields.displacements.U.middleRows<3>(3 * k) = u.segment<3>(6 * k);
    fields.displacements.Theta.middleRows<3>(3 * k) = u.segment<3>(6 * k + 3);
  }
  const StressRecovery recovery(model, outer_surface(model).nodes);
  const MatX stress = recovery.recover(fields).places;
  MatX out(12 * model.nodes(), 1);
  for (const StressPlace& place : recovery.layout().places) {
    const Eigen::Index from = 6 * (&place - recovery.layout().places.data());
    const bool top = place.layer == StressPlace::Layer::top;
    out.middleRows<6>(12 * place.node + (top ? 0 : 6)) = stress.middleRows<6>(from);
  }
  return out;
}

const FeElementType shell_types[] = {FeElementType::tri3, FeElementType::quad4};

// Square plate a = 2, uniform load q, nu = 0.3, a quarter with n x n elements. Timoshenko,
// Woinowsky-Krieger, Theory of Plates and Shells, tables 8 and 35: moment in the middle
// 0.0479 q a^2 simply supported, 0.0231 q a^2 clamped, -0.0513 q a^2 in the middle of the edge.
TEST(ShellStress, PlateInBending) {
  const double a = 2.0, t = 0.01, q = 1000.0;
  const Material material{2e11, 0.3, 1.0};
  const int n = 16;
  for (const FeElementType type : shell_types)
    for (const bool clamped : {false, true}) {
      const FeModel model = sheet(
          type, n, n, [&](double x, double y) { return Vec3(0.5 * a * x, 0.5 * a * y, 0.0); },
          material, t);
      std::vector<Held> held;
      for (int k = 0; k <= n; ++k) {
        held.push_back({k, 2u | 8u | 32u});             // symmetry y = 0
        held.push_back({(n + 1) * k, 1u | 16u | 32u});  // symmetry x = 0
        const unsigned edge = clamped ? 63u : 4u;
        held.push_back({(n + 1) * n + k, edge | (clamped ? 0u : 16u)});
        held.push_back({(n + 1) * k + n, edge | (clamped ? 0u : 8u)});
      }
      const FeSystem system = assemble(model);
      VecX up = VecX::Zero(system.size());
      for (int k = 0; k < model.nodes(); ++k) up(6 * k + 2) = q / t;  // density 1
      const MatX sides = sides_of(model, solve(model, held, system.M * up));
      const double unit = 6.0 * q * a * a / (t * t);
      const double middle = sides(0, 0) / unit;  // the top is stretched
      const double edge = sides(12 * n, 0) / unit;
      std::printf("[ figure ] plate, %s, %s: middle %.5f, edge %.5f (times 6 q a^2 / t^2)\n",
                  type == FeElementType::tri3 ? "tri3" : "quad4",
                  clamped ? "clamped" : "simply supported", middle, edge);
      EXPECT_NEAR(middle / (clamped ? 0.0231 : 0.0479), 1.0, 0.02);
      if (clamped) {
        EXPECT_NEAR(edge / -0.0513, 1.0, 0.02);
      }
      EXPECT_NEAR(sides(0, 0), -sides(6, 0), 1e-6 * std::abs(sides(0, 0)));
    }
}

// The same of shells with nodes on their edges, a quarter with n x n nodes between.
TEST(ShellStress, PlateOfMidsideShells) {
  const double a = 2.0, t = 0.01, q = 1000.0;
  const Material material{2e11, 0.3, 1.0};
  const int n = 16;
  for (const FeElementType type : {FeElementType::tri6, FeElementType::quad8}) {
    const MidsideSheet s = midside_sheet(
        type, n / 2, n / 2, [&](double x, double y) { return Vec3(0.5 * a * x, 0.5 * a * y, 0.0); },
        material, t);
    std::vector<Held> held;
    for (const auto& [place, node] : s.node) {
      if (place.first == 0) held.push_back({node, 1u | 16u | 32u});
      if (place.second == 0) held.push_back({node, 2u | 8u | 32u});
      if (place.first == n || place.second == n) held.push_back({node, 63u});
    }
    const FeSystem system = assemble(s.model);
    VecX up = VecX::Zero(system.size());
    for (int k = 0; k < s.model.nodes(); ++k) up(6 * k + 2) = q / t;
    const MatX sides = sides_of(s.model, solve(s.model, held, system.M * up));
    const double unit = 6.0 * q * a * a / (t * t);
    const double middle = sides(12 * s.node.at({0, 0}), 0) / unit;
    const double edge = sides(12 * s.node.at({n, 0}), 0) / unit;
    std::printf("[ figure ] plate, %s, clamped: middle %.5f, edge %.5f (times 6 q a^2 / t^2)\n",
                fe_element_name(type), middle, edge);
    EXPECT_NEAR(middle / 0.0231, 1.0, 0.02);
    EXPECT_NEAR(edge / -0.0513, 1.0, 0.02);
  }
}

// Scordelis-Lo roof as in tests/fe/shells_test.cpp: across the span the membrane stresses sum up to
// no force and to the moment of a beam under the weight, in the middle p L^2 / 8.
TEST(ShellStress, ScordelisLoRoofCarriesItsWeight) {
  const Material material{4.32e8, 0.0, 1.0};
  const double R = 25.0, L = 50.0, t = 0.25, half = 40.0 * std::numbers::pi / 180.0;
  for (const FeElementType type : shell_types) {
    const int n = 24;
    const FeModel model = sheet(
        type, n, n,
        [&](double x, double y) {
          return Vec3(0.5 * L * x, R * std::sin(half * y), R * std::cos(half * y));
        },
        material, t);
    std::vector<Held> held;
    for (int j = 0; j <= n; ++j) {
      held.push_back({(n + 1) * j, 1u | 16u | 32u});
      held.push_back({(n + 1) * j + n, 2u | 4u});
    }
    for (int i = 0; i <= n; ++i) held.push_back({i, 2u | 8u | 32u});
    const FeSystem system = assemble(model);
    VecX down = VecX::Zero(system.size());
    for (int k = 0; k < model.nodes(); ++k) down(6 * k + 2) = -90.0 / t;
    const MatX sides = sides_of(model, solve(model, held, system.M * down));
    // At the border of a mesh of triangles the stress is of first order: the next column.
    const int i = type == FeElementType::tri3 ? 1 : 0;
    double force = 0.0, absolute = 0.0, moment = 0.0;
    for (int j = 0; j <= n; ++j) {
      const int node = (n + 1) * j + i;
      const double ds = R * half / n * (j == 0 || j == n ? 0.5 : 1.0);
      const double N = 0.5 * t * (sides(12 * node, 0) + sides(12 * node + 6, 0));
      force += 2.0 * N * ds;
      absolute += 2.0 * std::abs(N) * ds;
      moment -= 2.0 * N * ds * model.positions[node](2);
    }
    const double x = model.positions[i](0);
    const double expected = 90.0 * 2.0 * half * R * (L * L / 8.0 - x * x / 2.0);
    std::printf(
        "[ figure ] Scordelis-Lo, %s: moment %.4f of that of the weight, force %.4f of the "
        "sum of its parts\n",
        type == FeElementType::tri3 ? "tri3" : "quad4", moment / expected, force / absolute);
    EXPECT_NEAR(moment / expected, 1.0, 0.01);
    EXPECT_NEAR(force / absolute, 0.0, 0.01);
  }
}

}  // namespace
}  // namespace floatframe::test

// Shells and the 3-node beam: patch tests, and the textbook problems that tell how accurate they
// are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

constexpr FeElementType kinds[] = {FeElementType::tri3, FeElementType::quad4};

// Constant membrane strain, and constant curvature: an irregular patch held on its edge reproduces
// both at the node inside.
TEST(Shells, PatchTests) {
  const Material steel{2e11, 0.3, 7850};
  Random random(3);
  const Mat3 R = random.rotation();
  for (const FeElementType type : kinds) {
    FeModel model = sheet(
        type, 3, 3, [](double x, double y) { return Vec3(x, 0.8 * y, 0); }, steel, 0.01);
    for (const int inner : {5, 6, 9, 10}) {
      const Vec3 shift = random.vec3(0.06);
      model.positions[inner] += Vec3(shift(0), shift(1), 0);
    }
    VecX flat(96), bent(96);
    for (int k = 0; k < 16; ++k) {
      const Vec3 p = model.positions[k];
      const double x = p(0), y = p(1);
      // u = a x + b y, v = c x + d y, rz = (v_x - u_y)/2
      flat.segment<6>(6 * k) << 0.3 * x + 0.2 * y, -0.1 * x + 0.5 * y, 0, 0, 0, -0.15;
      // w quadratic, rx = w_y, ry = -w_x
      bent.segment<6>(6 * k) << 0, 0, 0.4 * x * x + 0.3 * x * y - 0.2 * y * y, 0.3 * x - 0.4 * y,
          -(0.8 * x + 0.3 * y), 0;
    }
    for (Vec3& p : model.positions) p = R * p;
    for (VecX* u : {&flat, &bent}) {
      for (int i = 0; i < 32; ++i) u->segment<3>(3 * i) = (R * u->segment<3>(3 * i)).eval();
      const VecX f = assemble(model).K * *u;
      for (const int inner : {5, 6, 9, 10}) {
        EXPECT_LT(f.segment<6>(6 * inner).norm(), 1e-10 * f.norm()) << fe_element_name(type);
      }
    }
  }
}

// Slender cantilever under a shear force in its plane, one element through the depth: the membrane
// with drilling rotations bends without locking whatever the aspect ratio.
TEST(Shells, CantileverInItsPlaneAndAcross) {
  const Material material{2e11, 0.0, 7850};
  const double L = 1.0, b = 0.05, h = 0.01;
  for (const FeElementType type : kinds) {
    const int n = 10;
    FeModel model = sheet(
        type, n, 1, [&](double x, double y) { return Vec3(L * x, b * y, 0); }, material, h);
    VecX f = VecX::Zero(6 * model.nodes());
    const std::vector<Held> held = {{0, 63}, {n + 1, 63}};
    for (const int tip : {n, 2 * n + 1}) {
      f(6 * tip + 1) = 50.0;  // in the plane
      f(6 * tip + 2) = 0.5;   // across
    }
    const VecX u = solve(model, held, f);
    const double E = material.young;
    const double in_plane =
        100.0 * L * L * L / (3 * E * h * b * b * b / 12) + 100.0 * L / (5.0 / 6.0 * E / 2 * b * h);
    const double across = 1.0 * L * L * L / (3 * E * b * h * h * h / 12);
    EXPECT_NEAR(u(6 * n + 1) / in_plane, 1.0, 0.01) << fe_element_name(type);
    EXPECT_NEAR(u(6 * n + 2) / across, 1.0, 1e-3) << fe_element_name(type);
  }
}

// Scordelis-Lo roof: R = 25, L = 50, t = 0.25, E = 4.32e8, nu = 0, weight 90 an area, diaphragms at
// the ends. Vertical displacement in the middle of the free edge: 0.3024 (MacNeal and Harder 1985);
// a quarter with n x n elements.
TEST(Shells, ScordelisLoRoof) {
  const Material material{4.32e8, 0.0, 1.0};
  for (const FeElementType type : kinds) {
    double result[2] = {};
    for (int level = 0; level < 2; ++level) {
      const int n = 8 << level;
      // i along the axis from the middle (x = 0) to the diaphragm, j from the crown to the edge.
      const FeModel model = sheet(
          type, n, n,
          [](double x, double y) {
            const double angle = 40.0 * std::numbers::pi / 180.0 * y;
            return Vec3(25.0 * x, 25.0 * std::sin(angle), 25.0 * std::cos(angle));
          },
          material, 0.25);
      std::vector<Held> held;
      for (int j = 0; j <= n; ++j) {
        held.push_back({(n + 1) * j, 1u | 16u | 32u});  // symmetry x = 0
        held.push_back({(n + 1) * j + n, 2u | 4u});     // diaphragm
      }
      for (int i = 0; i <= n; ++i) held.push_back({i, 2u | 8u | 32u});  // symmetry y = 0
      // Weight by the consistent mass: density 1, so m g = 90 A needs 360 times the mass.
      const FeSystem system = assemble(model);
      VecX down = VecX::Zero(system.size());
      for (int k = 0; k < model.nodes(); ++k) down(6 * k + 2) = -360.0;
      const VecX u = solve(model, held, system.M * down);
      result[level] = -u(6 * (n + 1) * n + 2);
    }
    EXPECT_NEAR(result[0] / 0.3024, 1.0, 0.01) << fe_element_name(type);
    EXPECT_NEAR(result[1] / 0.3024, 1.0, 0.008) << fe_element_name(type);
  }
}

// Pinched cylinder with diaphragms: R = 300, L = 600, t = 3, E = 3e6, nu = 0.3, opposite unit
// forces: 1.8248e-5 under the force (Belytschko et al. 1985); an eighth with n x n elements.
TEST(Shells, PinchedCylinder) {
  const Material material{3e6, 0.3, 1.0};
  for (const FeElementType type : kinds) {
    const int n = 20;
    const FeModel model = sheet(
        type, n, n,
        [](double x, double y) {
          const double angle = std::numbers::pi / 2 * y;
          return Vec3(300.0 * x, 300.0 * std::sin(angle), 300.0 * std::cos(angle));
        },
        material, 3.0);
    std::vector<Held> held;
    for (int j = 0; j <= n; ++j) {
      held.push_back({(n + 1) * j, 1u | 16u | 32u});
      held.push_back({(n + 1) * j + n, 2u | 4u});
    }
    for (int i = 0; i <= n; ++i) {
      held.push_back({i, 2u | 8u | 32u});                // y = 0
      held.push_back({(n + 1) * n + i, 4u | 8u | 16u});  // z = 0
    }
    VecX f = VecX::Zero(6 * model.nodes());
    f(2) = -0.25;
    const VecX u = solve(model, held, f);
    EXPECT_NEAR(-u(2) / 1.8248e-5, 1.0, 0.012) << fe_element_name(type);
  }
}

// Three-node Timoshenko beam: tip deflection is exact with one element under a tip force but for
// the reduced points; a ring segment converges.
TEST(Beam3, CantileverAndQuarterRing) {
  const Material material{2e11, 0.3, 7850};
  const BeamSection section = BeamSection::rectangle(0.02, 0.05);
  const double E = 2e11, G = material.shear();
  const auto curve = [&](int elements, const auto& at) {
    FeModel model;
    model.materials = {material};
    model.sections = {section};
    for (int k = 0; k <= 2 * elements; ++k) model.positions.push_back(at(0.5 * k / elements));
    for (int k = 0; k < elements; ++k)
      add_element(model, FeElementType::beam3, {2 * k, 2 * k + 1, 2 * k + 2}).reference =
          Vec3::UnitY();
    validate(model);
    return model;
  };
  const double L = 1.5;
  const FeModel bar = curve(8, [&](double s) { return Vec3(L * s, 0, 0); });
  VecX f = VecX::Zero(6 * bar.nodes());
  f(f.size() - 4) = 1.0;
  const double expected = L * L * L / (3 * E * section.Iy) + L / (5.0 / 6.0 * G * section.A);
  EXPECT_NEAR(solve(bar, {{0, 63}}, f)(f.size() - 4) / expected, 1.0, 1e-9);
  // Quarter ring in the xz plane, radius R, clamped, radial force at the tip: bending, axial and
  // shear strain energy give d = pi R^3/4 P/(E I) + pi R/4 P (1/(E A) + 1/(k G A)).
  const double R = 0.8;
  const FeModel ring = curve(12, [&](double s) {
    const double a = std::numbers::pi / 2 * s;
    return Vec3(R * std::sin(a), 0, R * std::cos(a));
  });
  VecX g = VecX::Zero(6 * ring.nodes());
  g(g.size() - 6) = 1.0;  // outwards at the tip (R, 0, 0)
  const double quarter = std::numbers::pi / 4;
  const double radial = quarter * R * R * R / (E * section.Iy) +
                        quarter * R * (1.0 / (E * section.A) + 1.0 / (5.0 / 6.0 * G * section.A));
  EXPECT_NEAR(solve(ring, {{0, 63}}, g)(g.size() - 6) / radial, 1.0, 1e-4);
}

}  // namespace
}  // namespace floatframe::test

// Orthotropic and anisotropic solids: the elasticity turned as a tensor of fourth order, written
// down here a second time, and uniaxial stress along the turned axes.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "support/random_body.hpp"
#include "support/solid_plies.hpp"

namespace floatframe::test {
namespace {

// E1, E2, E3, nu12, nu13, nu23, G12, G13, G23
constexpr EngineeringConstants wood{1.2e10, 9e8, 5e8, 0.35, 0.42, 0.5, 8e8, 6e8, 6e7};
constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

Mat6 turned_tensor(const Mat6& D, const Mat3& R) {
  int number[3][3];
  for (int c = 0; c < 6; ++c)
    number[pairs[c][0]][pairs[c][1]] = number[pairs[c][1]][pairs[c][0]] = c;
  Mat6 out = Mat6::Zero();
  for (int r = 0; r < 6; ++r)
    for (int s = 0; s < 6; ++s)
      for (int n = 0; n < 81; ++n) {
        const int i = n % 3, j = n / 3 % 3, k = n / 9 % 3, l = n / 27;
        out(r, s) += R(pairs[r][0], i) * R(pairs[r][1], j) * R(pairs[s][0], k) * R(pairs[s][1], l) *
                     D(number[i][j], number[k][l]);
      }
  return out;
}

/// An element of its own with corners moved at random, and an orientation.
ElementInput skewed(FeElementType type, Random& random) {
  const ElementKernel& kernel = element_kernel(type);
  ElementInput in;
  const std::vector<Vec3> corners = natural_corners(type);
  for (std::size_t a = 0; a < corners.size(); ++a) in.p[a] = corners[a] + random.vec3(0.1);
  set_middles(kernel, in.p);
  in.material = anisotropic_material(elasticity_of(wood), false, 600.0);
  in.orientation.emplace();
  in.orientation->axes = random.rotation();
  return in;
}

TEST(Orthotropic, ConstantsGiveTheCompliance) {
  ASSERT_EQ(engineering_error(wood, false), "");
  const Mat6 D = elasticity_of(wood);
  // Uniaxial stress along each axis.
  const double E[3] = {wood.E1, wood.E2, wood.E3};
  const double nu[3][3] = {{0, wood.nu12, wood.nu13},
                           {wood.nu12 * wood.E2 / wood.E1, 0, wood.nu23},
                           {wood.nu13 * wood.E3 / wood.E1, wood.nu23 * wood.E3 / wood.E2, 0}};
  for (int i = 0; i < 3; ++i) {
    Vec6 strain = Vec6::Zero();
    for (int j = 0; j < 3; ++j) strain(j) = i == j ? 1.0 : -nu[i][j];
    const Vec6 stress = D * strain;
    EXPECT_NEAR(stress(i), E[i], 1e-9 * E[i]);
    EXPECT_LT(std::abs(stress.sum() - stress(i)), 1e-9 * E[i]);
  }
  EXPECT_EQ(D(3, 3), wood.G12);
  EXPECT_EQ(D(4, 4), wood.G23);
  EXPECT_EQ(D(5, 5), wood.G13);
  const Material m = anisotropic_material(D, false, 1.0);
  EXPECT_NEAR(m.young, wood.E1, 1e-6 * wood.E1);
  EXPECT_NEAR(m.poisson, wood.nu12, 1e-12);
  EXPECT_LT(
      (plane_stress(m) - plane_stress(anisotropic_material(lamina_elasticity(wood), true, 1.0)))
          .norm(),
      1e-9 * wood.E1);
  Random random(3);
  const Mat3 R = random.rotation();
  EXPECT_LT((turned_elasticity(D, R) - turned_tensor(D, R)).norm(), 1e-12 * D.norm());
}

// Uniaxial stress along the turned axis 1: the field is linear, its energy that of the closed form,
// and so is the stress at the nodes and where stress stiffness takes it.
TEST(Orthotropic, UniaxialStressAlongATurnedAxis) {
  Random random(4);
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    if (kernel.family != ElementFamily::solid || kernel.nodes == 5 || kernel.nodes == 13) continue;
    SCOPED_TRACE(fe_element_name(type));
    const ElementInput in = skewed(type, random);
    ASSERT_EQ(kernel.error(in), "");
    const Mat3& R = in.orientation->axes;
    const Vec3 along(1e6 / wood.E1, -wood.nu12 * 1e6 / wood.E1, -wood.nu13 * 1e6 / wood.E1);
    const Mat3 G = R * along.asDiagonal() * R.transpose();
    VecX u(3 * kernel.nodes);
    for (int a = 0; a < kernel.nodes; ++a) u.segment<3>(3 * a) = G * in.p[a];
    MatX K, M, B;
    kernel.stiffness(in, K);
    kernel.scalar_mass(in, M);
    const double volume = M.sum() / 600.0;
    EXPECT_NEAR(u.dot(K * u), volume * 1e12 / wood.E1, 1e-10 * volume * 1e12 / wood.E1);
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
    const Mat3 sigma = 1e6 * R.col(0) * R.col(0).transpose();
    Vec6 expected;
    for (int c = 0; c < 6; ++c) expected(c) = sigma(pairs[c][0], pairs[c][1]);
    kernel.nodal_strains(in, B);
    for (int a = 0; a < kernel.nodes; ++a)
      EXPECT_LT((elasticity_at(in, in.p[a]) * (B.middleRows<6>(6 * a) * u) - expected).norm(),
                1e-4);
    std::vector<StressedPoint> points;
    kernel.stressed_points(in, points);
    Vec6 sum = Vec6::Zero();
    for (const StressedPoint& point : points) sum += point.stress * u;
    EXPECT_LT((sum / volume - expected).norm(), 1e-4);
  }
}

// The matrix of an isotropic material is that material, whatever its axes.
TEST(Orthotropic, IsotropicMatrixIsTheMaterial) {
  Random random(5);
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    if (kernel.family != ElementFamily::solid || kernel.nodes == 5 || kernel.nodes == 13) continue;
    ElementInput in = skewed(type, random);
    in.material = anisotropic_material(elasticity_matrix({2e11, 0.3, 7850.0}), false, 7850.0);
    in.orientation->kind = Orientation::Kind::cylindrical;
    MatX turned, plain;
    kernel.stiffness(in, turned);
    in.material = {2e11, 0.3, 7850.0};
    kernel.stiffness(in, plain);
    EXPECT_LT((turned - plain).norm(), 1e-12 * plain.norm()) << fe_element_name(type);
  }
}

TEST(Orthotropic, AxesOfCylindersAndSpheres) {
  Random random(6);
  const Mat3 R = random.rotation();
  Orientation o{Orientation::Kind::cylindrical, R, Vec3(1, 2, 3), Mat3::Identity()};
  const Mat3 at = o.at(Vec3(1, 2, 3) + R * Vec3(0.3 * std::cos(2.0), 0.3 * std::sin(2.0), 5));
  EXPECT_LT((at.col(0) - R * Vec3(std::cos(2.0), std::sin(2.0), 0)).norm(), 1e-14);
  EXPECT_LT((at.col(1) - R * Vec3(-std::sin(2.0), std::cos(2.0), 0)).norm(), 1e-14);
  EXPECT_LT((at.col(2) - R.col(2)).norm(), 1e-14);
  o.kind = Orientation::Kind::spherical;
  const Vec3 direction(0.6 * std::cos(2.0), 0.6 * std::sin(2.0), 0.8);
  const Mat3 on = o.at(Vec3(1, 2, 3) + 7.0 * R * direction);
  EXPECT_LT((on.col(0) - R * direction).norm(), 1e-14);
  EXPECT_LT((on.col(2) - R * Vec3(-std::sin(2.0), std::cos(2.0), 0)).norm(), 1e-14);
  EXPECT_NEAR(on.determinant(), 1.0, 1e-14);
}

TEST(Orthotropic, ErrorsNameTheConstant) {
  const auto with = [](auto change, bool lamina = false) {
    EngineeringConstants c = wood;
    change(c);
    return engineering_error(c, lamina);
  };
  using C = EngineeringConstants;
  EXPECT_EQ(with([](C& c) { c.E3 = 0.0; }), "E3 is 0, expected more than 0");
  EXPECT_EQ(with([](C& c) { c.G13 = -1.0; }), "G13 is -1, expected more than 0");
  EXPECT_EQ(with([](C& c) { c.G13 = -1.0; }, true), "");
  EXPECT_EQ(with([](C& c) { c.nu12 = 4.0; }),
            "NU12 is 4, expected a size below 3.65148, the root of E1/E2");
  EXPECT_EQ(with([](C& c) { c.nu23 = 1.5; }),
            "NU23 is 1.5, expected a size below 1.34164, the root of E2/E3");
  EXPECT_EQ(with([](C& c) { c.nu12 = 3.0, c.nu13 = 3.0, c.nu23 = 1.0; }).substr(0, 61),
            "NU12, NU13 and NU23 are 3, 3 and 1, which together are too la");
}

}  // namespace
}  // namespace floatframe::test

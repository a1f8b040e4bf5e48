// Rotations against finite differences and against Eigen, small and large angles.
#include <gtest/gtest.h>

#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

const double angles[] = {0.0, 1e-12, 1e-6, 1e-3, 9.99e-3, 1.001e-2, 0.1, 1.0, 3.0};

TEST(Rotations, ExponentialAgainstAngleAxis) {
  Random random(1);
  for (const double angle : angles) {
    const Vec3 axis = random.vec3().normalized();
    const Mat3 R = rotation_exp(angle * axis);
    const Mat3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((R - expected).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((quaternion_exp(angle * axis).toRotationMatrix() - expected).cwiseAbs().maxCoeff(),
              2e-15);
    EXPECT_LT((quaternion_log(quaternion_exp(angle * axis)) - angle * axis).norm(), 1e-14);
  }
}

TEST(Rotations, SkewIsTheCrossProduct) {
  Random random(2);
  const Vec3 a = random.vec3(), b = random.vec3();
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
  EXPECT_EQ(skew(a).transpose(), -skew(a));
}

TEST(Rotations, TangentAgainstFiniteDifferences) {
  // Rdot R^T = skew(H thetadot)
  Random random(3);
  for (const double angle : angles) {
    const Vec3 theta = angle * random.vec3().normalized();
    const Vec3 rate = random.vec3();
    const double h = 1e-5;
    const Mat3 Rdot = (rotation_exp(theta + h * rate) - rotation_exp(theta - h * rate)) / (2.0 * h);
    const Mat3 W = Rdot * rotation_exp(theta).transpose();
    EXPECT_LT((W - skew(rotation_tangent(theta) * rate)).cwiseAbs().maxCoeff(), 2e-10);
  }
}

TEST(Rotations, TangentBiasAgainstFiniteDifferences) {
  Random random(4);
  for (const double angle : angles) {
    const Vec3 theta = angle * random.vec3().normalized();
    const Vec3 rate = random.vec3();
    const double h = 1e-5;
    const Vec3 expected =
        (rotation_tangent(theta + h * rate) * rate - rotation_tangent(theta - h * rate) * rate) /
        (2.0 * h);
    EXPECT_LT((rotation_tangent_bias(theta, rate) - expected).norm(), 2e-10);
  }
}

TEST(Rotations, SeriesMeetTheClosedForms) {
  // Both branches at the border |theta| = 1e-2.
  const RotationCoefficients below = rotation_coefficients(1e-4 * (1.0 - 1e-12));
  const RotationCoefficients above = rotation_coefficients(1e-4 * (1.0 + 1e-12));
  EXPECT_NEAR(below.s, above.s, 1e-15);
  EXPECT_NEAR(below.a, above.a, 1e-14);
  EXPECT_NEAR(below.b, above.b, 1e-10);
  EXPECT_NEAR(below.da, above.da, 1e-9);
  EXPECT_NEAR(below.db, above.db, 1e-6);
}

TEST(Rotations, OrthonormalComplement) {
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    const Vec3 n = random.vec3().normalized();
    Vec3 a, b;
    orthonormal_complement(n, a, b);
    Mat3 T;
    T << a, b, n;
    EXPECT_LT((T.transpose() * T - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(T.determinant(), 0.0);
  }
}

}  // namespace
}  // namespace floatframe::test

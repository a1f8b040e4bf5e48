// Stress stiffness of beams: axial forces on slopes and on the twist, torques on the twist of
// second order.
#include <gtest/gtest.h>

#include "floatframe/fe/stress_stiffness.hpp"
#include "floatframe/math/so3.hpp"
#include "support/fe_models.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

constexpr int elements = 12;

/// A row of nodes along x from the origin, one metre long.
FeModel row(FeElementType type, const BeamSection& section, const Vec3& x) {
  FeModel model;
  model.materials = {steel};
  model.sections = {section};
  const int step = type == FeElementType::beam2 ? 1 : 2;
  for (int k = 0; k <= elements; ++k) model.positions.push_back(x * k / elements);
  for (int k = 0; k < elements; k += step)
    add_element(model, type, {k, k + 1, k + 2}).reference = Vec3(0.3, -1.0, 0.2);
  return model;
}

NodalShapes shapes(int columns) {
  return {MatX::Zero(3 * elements + 3, columns), MatX::Zero(3 * elements + 3, columns)};
}

const Vec3 axis_of_row = Vec3(2, 1, 2).normalized();
const Vec3 side = axis_of_row.cross(Vec3::UnitZ()).normalized();
const Vec3 up = axis_of_row.cross(side);

double at(int node) { return static_cast<double>(node) / elements; }

TEST(BeamStressStiffness, TensionOnSlopes) {
  for (const FeElementType type : {FeElementType::beam2, FeElementType::beam3}) {
    const FeModel model = row(type, BeamSection::solid_round(0.02), axis_of_row);
    // w = s^2 across a bar with a strain of one.
    NodalShapes mode = shapes(1), pulled = shapes(1);
    for (int k = 0; k <= elements; ++k) {
      const double s = at(k);
      mode.U.block<3, 1>(3 * k, 0) = s * s * side;
      mode.Theta.block<3, 1>(3 * k, 0) = 2.0 * s * up;
      pulled.U.block<3, 1>(3 * k, 0) = s * axis_of_row;
    }
    const double N = steel.young * model.sections[0].A;
    EXPECT_NEAR(stress_stiffness(model, mode, pulled)(0, 0), N * 4.0 / 3.0, 1e-9 * N);
  }
}

// Fibres beside the axis of a twisted bar are longer: N (Iy + Iz)/A int rx'^2 dx.
TEST(BeamStressStiffness, TensionOnTheTwist) {
  for (const FeElementType type : {FeElementType::beam2, FeElementType::beam3}) {
    const FeModel model = row(type, BeamSection::rectangle(0.02, 0.05), axis_of_row);
    NodalShapes mode = shapes(1), pulled = shapes(1);
    for (int k = 0; k <= elements; ++k) {
      mode.Theta.block<3, 1>(3 * k, 0) = 0.7 * at(k) * axis_of_row;
      pulled.U.block<3, 1>(3 * k, 0) = at(k) * axis_of_row;
    }
    const BeamSection& s = model.sections[0];
    const double expected = steel.young * (s.Iy + s.Iz) * 0.49;
    EXPECT_NEAR(stress_stiffness(model, mode, pulled)(0, 0), expected, 1e-9 * expected);
  }
}

/// Twist of the end of a shaft with the curvatures of v = a s^2, w = b s^3 and no torsion, by
/// integration of R' = R kappa.
double twist_of_a_helix(double a, double b) {
  constexpr int steps = 4000;
  Mat3 R = Mat3::Identity();
  for (int k = 0; k < steps; ++k) {
    const double s = (k + 0.5) / steps;
    R = R * rotation_exp(Vec3(0.0, -6.0 * b * s, 2.0 * a) / steps);
  }
  return quaternion_log(Eigen::Quaterniond(R)).x();
}

TEST(BeamStressStiffness, TorqueOnTheTwistOfSecondOrder) {
  const double e = 1e-3;
  const double twist = twist_of_a_helix(e, e) / (e * e);  // of v = s^2, w = s^3
  EXPECT_NEAR(twist, 1.0, 1e-4);                          // 1/2 int v' w'' - w' v'' ds
  for (const FeElementType type : {FeElementType::beam2, FeElementType::beam3}) {
    BeamSection section = BeamSection::rectangle(0.02, 0.05);
    for (const double shear : {0.0, 0.6}) {
      section.shear_y = section.shear_z = shear * section.A;
      const FeModel model = row(type, section, axis_of_row);
      NodalShapes mode = shapes(2), twisted = shapes(2);
      for (int k = 0; k <= elements; ++k) {
        const double s = at(k);
        mode.U.block<3, 1>(3 * k, 0) = s * s * side;
        mode.Theta.block<3, 1>(3 * k, 0) = 2.0 * s * up;
        mode.U.block<3, 1>(3 * k, 1) = s * s * s * up;
        mode.Theta.block<3, 1>(3 * k, 1) = -3.0 * s * s * side;
        twisted.Theta.block<3, 1>(3 * k, 0) = s * axis_of_row;
        twisted.U.block<3, 1>(3 * k, 1) = s * axis_of_row;
      }
      const StressStiffness K =
          shares_of_stress_stiffness(model, mode, twisted, Integration::exact);
      // A torque of G J: its work on the twist of second order is -1/2 u^T K u.
      const double torque = steel.shear() * section.J;
      const double exact = type == FeElementType::beam2 && shear > 0.0 ? 5e-3 : 1e-9;
      EXPECT_NEAR(K.twist(1, 0), -torque * twist, (exact + 1e-4) * torque);
      EXPECT_NEAR(K.twist(0, 0), 0.0, exact * torque);
      EXPECT_NEAR(K.twist(2, 0), 0.0, exact * torque);
      EXPECT_LT(K.direct.col(0).norm(), 1e-9 * torque);
      EXPECT_LT(K.twist.col(1).norm(), 1e-9 * torque);
    }
  }
}

}  // namespace
}  // namespace floatframe::test

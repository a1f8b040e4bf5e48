// Shells whose turn about the normal is their own at some nodes.
#include <gtest/gtest.h>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe::test {
namespace {

const Mat3 drilled_axes = rotation_exp(Vec3(0.3, 0.9, -0.5));

/// Irregular, flat, in a plane of its own.
ElementInput drilled_shell(FeElementType type, unsigned own) {
  ElementInput in;
  in.material.young = 2e11;
  in.material.poisson = 0.3;
  in.shell.thickness = 0.02;
  in.own_drilling = own;
  const bool triangle = type == FeElementType::tri3 || type == FeElementType::tri6;
  const std::vector<Vec3> corners =
      triangle
          ? std::vector<Vec3>{{0.0, 0.0, 0.0}, {1.0, 0.2, 0.0}, {0.3, 0.9, 0.0}}
          : std::vector<Vec3>{{0.0, 0.0, 0.0}, {1.0, 0.2, 0.0}, {1.2, 1.1, 0.0}, {-0.1, 0.8, 0.0}};
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    in.p[k] = drilled_axes * corners[k];
    in.p[n + k] = drilled_axes * (0.5 * (corners[k] + corners[(k + 1) % n]));
  }
  return in;
}

MatX drilled_stiffness(FeElementType type, unsigned own) {
  MatX K;
  element_kernel(type).stiffness(drilled_shell(type, own), K);
  return K;
}

const FeElementType drilled_types[] = {FeElementType::tri3, FeElementType::quad4,
                                       FeElementType::tri6, FeElementType::quad8};

TEST(OwnDrilling, TheTurnOfTheNodeDoesNothing) {
  for (const FeElementType type : drilled_types) {
    const int nodes = element_kernel(type).nodes;
    const MatX free = drilled_stiffness(type, 0), own = drilled_stiffness(type, 0b101);
    for (const int a : {0, 1, 2}) {
      VecX v = VecX::Zero(6 * nodes);
      v.segment<3>(6 * a + 3) = drilled_axes.col(2);
      EXPECT_GT((free * v).norm(), 1e-4 * free.norm()) << nodes;
      if (a == 1)
        EXPECT_GT((own * v).norm(), 1e-4 * free.norm()) << nodes;
      else
        EXPECT_LE((own * v).norm(), 1e-12 * free.norm()) << nodes;
    }
  }
}

/// Constant strain and curvature: what an element without own turns has, it has with them.
TEST(OwnDrilling, ConstantStrainAndCurvatureAreThoseOfTheElement) {
  for (const FeElementType type : drilled_types) {
    const int nodes = element_kernel(type).nodes;
    const ElementInput in = drilled_shell(type, 0);
    for (int field = 0; field < 6; ++field) {
      VecX u(6 * nodes);
      for (int a = 0; a < nodes; ++a) {
        const Vec3 x = drilled_axes.transpose() * in.p[static_cast<std::size_t>(a)];
        Vec3 move = Vec3::Zero(), turn = Vec3::Zero();
        if (field == 0) move(0) = x(0);
        if (field == 1) move(1) = x(1);
        if (field == 2) move(0) = x(1), turn(2) = -0.5;
        if (field == 3) move(2) = 0.5 * x(0) * x(0), turn(1) = -x(0);
        if (field == 4) move(2) = x(0) * x(1), turn = Vec3(x(0), -x(1), 0.0);
        if (field == 5) move = Vec3(-x(1), x(0), 0.0), turn(2) = 1.0;
        u.segment<3>(6 * a) = drilled_axes * move;
        u.segment<3>(6 * a + 3) = drilled_axes * turn;
      }
      const MatX free = drilled_stiffness(type, 0);
      const double scale = free.norm() * 1e-3;
      for (const unsigned own : {1u, 7u}) {
        const MatX K = drilled_stiffness(type, own);
        EXPECT_NEAR(u.dot(K * u) / scale, u.dot(free * u) / scale, 1e-9) << nodes << " " << field;
      }
    }
  }
}

/// The stress of an element is that of its own turns: with any turn of the node the same.
TEST(OwnDrilling, StressIsThatOfTheElement) {
  for (const FeElementType type : drilled_types) {
    const int nodes = element_kernel(type).nodes;
    MatX S;
    element_kernel(type).layer_stresses(drilled_shell(type, 0b10), S);
    VecX v = VecX::Zero(6 * nodes);
    v.segment<3>(9) = drilled_axes.col(2);
    EXPECT_LE((S * v).norm(), 1e-12 * S.norm());
    std::vector<StressedPoint> points;
    element_kernel(type).stressed_points(drilled_shell(type, 0b10), points);
    for (const StressedPoint& point : points)
      EXPECT_LE((point.stress * v).norm(), 1e-12 * point.stress.norm());
  }
}

}  // namespace
}  // namespace floatframe::test

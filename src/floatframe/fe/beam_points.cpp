#include "floatframe/fe/beam_points.hpp"

#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

using Motion = Eigen::Matrix<double, 3, 12>;

/// Displacement of the axis at s (0..1) and turn of the section there, in local axes.
void hermite(double s, double L, Motion& u, Motion& theta) {
  const double s2 = s * s, s3 = s2 * s;
  const double h[4] = {1 - 3 * s2 + 2 * s3, L * (s - 2 * s2 + s3), 3 * s2 - 2 * s3, L * (s3 - s2)};
  const double d[4] = {(-6 * s + 6 * s2) / L, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / L,
                       3 * s2 - 2 * s};
  u.setZero();
  theta.setZero();
  u(0, 0) = theta(0, 3) = 1 - s;
  u(0, 6) = theta(0, 9) = s;
  u(1, 1) = h[0], u(1, 5) = h[1], u(1, 7) = h[2], u(1, 11) = h[3];
  u(2, 2) = h[0], u(2, 4) = -h[1], u(2, 8) = h[2], u(2, 10) = -h[3];
  theta(1, 2) = -d[0], theta(1, 4) = d[1], theta(1, 8) = -d[2], theta(1, 10) = d[3];
  theta(2, 1) = d[0], theta(2, 5) = d[1], theta(2, 7) = d[2], theta(2, 11) = d[3];
}

}  // namespace

std::array<BeamPoint, 20> beam_points(const FeModel& model, const Element& element) {
  const ElementInput in = gather(model, element);
  const BeamSection& section = in.section;
  const Vec3 along = in.p[1] - in.p[0];
  const double L = along.norm();
  const Mat3 A = beam_axes(in);
  Eigen::Matrix<double, 12, 12> to_local = Eigen::Matrix<double, 12, 12>::Zero();
  for (int k = 0; k < 4; ++k) to_local.block<3, 3>(3 * k, 3 * k) = A.transpose();
  const Vec3 offset(0.0, std::sqrt(2.0 * section.Iz / section.A),
                    std::sqrt(2.0 * section.Iy / section.A));
  const LineRule rule = gauss_jacobi(5, 0);
  std::array<BeamPoint, 20> points;
  std::size_t count = 0;
  Motion u, theta;
  for (int q = 0; q < 5; ++q) {
    const double s = rule.u(q);
    hermite(s, L, u, theta);
    for (int axis = 1; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const Vec3 e = side * offset(axis) * Vec3::Unit(axis);
        BeamPoint& point = points[count++];
        point.p = in.p[0] + s * along + A * e;
        point.mass = 0.25 * in.material.density * section.A * L * rule.weight(q);
        point.motion = A * (u - skew(e) * theta) * to_local;
      }
    }
  }
  return points;
}

}  // namespace floatframe

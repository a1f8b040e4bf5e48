#include "floatframe/rotors/whirl.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Both modes of an exact pair of equal frequencies whirl on circles, in opposite senses: their
/// `whirl` forms H = U^H (its quadratic form) U, diagonalised.
void part_by_whirl(TurningMode& a, TurningMode& b, const MatX& first, const MatX& second) {
  b.m -= a.m.dot(b.m) * a.m;
  const double rest = b.m.norm();
  if (!(rest > 1e-6)) return;
  b.m /= rest;
  using Complex = std::complex<double>;
  const auto form = [&](const Eigen::VectorXcd& x, const Eigen::VectorXcd& y) {
    const Eigen::VectorXcd x1 = first * x, x2 = second * x, y1 = first * y, y2 = second * y;
    return Complex(0.0, -1.0) * (x1.dot(y2) - x2.dot(y1));
  };
  const double aa = form(a.m, a.m).real(), bb = form(b.m, b.m).real();
  const Complex ab = form(a.m, b.m);
  if (!(std::abs(ab) > 1e-12)) return;
  const double root = std::sqrt(0.25 * (aa - bb) * (aa - bb) + std::norm(ab));
  const double top = 0.5 * (aa + bb) + root;
  Complex c = ab, d = top - aa;  // eigenvector of `top`
  if (std::abs(d) < 1e-9 * root) c = 1.0, d = 0.0;
  const double size = std::sqrt(std::norm(c) + std::norm(d));
  c /= size;
  d /= size;
  const Eigen::VectorXcd one = c * a.m + d * b.m;
  b.m = (-std::conj(d) * a.m + std::conj(c) * b.m).eval();
  a.m = one;
}

/// Lateral motions of the axis below this fraction of squares count as zero.
constexpr double least_across = 1e-3, least_energy = 1e-10;
/// Unbalance excites a mode above these fractions: of the motion of the axis the component that
/// whirls with the rotor, of the energy of the mode that of the axis.
constexpr double least_forward = 1e-3, least_axis_energy = 1e-6;

double largest_square(const Eigen::VectorXcd& x) {
  return x.size() > 0 ? x.cwiseAbs2().maxCoeff() : 0.0;
}

void describe(const AxisMotion& axis, TurningMode& mode) {
  const Eigen::VectorXcd u1 = axis.across_1 * mode.m, u2 = axis.across_2 * mode.m,
                         u3 = axis.along * mode.m, twist = axis.twist * mode.m;
  const double area = 2.0 * u1.dot(u2).imag(), size = u1.squaredNorm() + u2.squaredNorm();
  const double all = size + u3.squaredNorm() + twist.squaredNorm();
  const Eigen::VectorXcd m = mode.m.head(axis.rotor.rows());
  const double rotor = m.dot(axis.rotor * m).real(), others = m.dot(axis.others * m).real(),
               points = static_cast<double>(std::max<Eigen::Index>(u1.size(), 1));
  const double of_axis = axis.mass * size / points, energy = rotor + others;
  mode.across = of_axis > least_energy * energy && all > 0.0 ? size / all : 0.0;
  // u2 lags u1 by a quarter in a turn from e1 to e2: u1 conj times u2 is -i.
  mode.whirl = mode.across > 0.0 ? -area / size : 0.0;  // else a quotient of round-off
  const double rigid = axis.mass * largest_square(u3) + axis.spin * largest_square(twist);
  if (mode.across >= least_across)
    mode.kind = mode.whirl > 0.1    ? MotionKind::forward
                : mode.whirl < -0.1 ? MotionKind::backward
                                    : MotionKind::planar;
  else if (rotor < 1e-3 * energy)
    mode.kind = MotionKind::other_bodies;
  else
    mode.kind = rigid < 0.25 * rotor ? MotionKind::bending : MotionKind::along_axis;
  mode.unbalance = mode.across >= least_across && 0.5 * (1.0 + mode.whirl) >= least_forward &&
                   of_axis >= least_axis_energy * energy;
}

}  // namespace

void describe_whirl(const AxisMotion& axis, std::vector<TurningMode>& modes) {
  for (std::size_t k = 0; k + 1 < modes.size(); ++k)
    if (std::abs(modes[k].lambda - modes[k + 1].lambda) < 1e-6 * std::abs(modes[k].lambda) &&
        modes[k].lambda.imag() > 0.0)
      part_by_whirl(modes[k], modes[k + 1], axis.across_1, axis.across_2);
  const SymmetricEigen mass = symmetric_eigen(axis.rotor + axis.others);
  const MatX root = mass.values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * mass.vectors.transpose();
  for (TurningMode& mode : modes) {
    describe(axis, mode);
    mode.shape = root * mode.m.head(root.cols());
    const double size = mode.shape.norm();
    if (size > 0.0) mode.shape /= size;
  }
}

const char* kind_of_motion(MotionKind kind) noexcept {
  switch (kind) {
    case MotionKind::forward:
      return "forward";
    case MotionKind::backward:
      return "backward";
    case MotionKind::planar:
      return "planar";
    case MotionKind::bending:
      return "bending";
    case MotionKind::other_bodies:
      return "other bodies";
    case MotionKind::along_axis:
      break;
  }
  return "axial or torsion";
}

}  // namespace floatframe

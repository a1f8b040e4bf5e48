#include "floatframe/simulation/whirl.hpp"

#include <cmath>

namespace floatframe {
namespace {

/// Both of an exact pair of equal frequencies whirl on circles, one each way: their `whirl` forms
/// H = U^H (what it measures) U, made diagonal.
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

}  // namespace

void describe_whirl(const AxisMotion& axis, std::vector<TurningMode>& modes) {
  for (std::size_t k = 0; k + 1 < modes.size(); ++k)
    if (std::abs(modes[k].lambda - modes[k + 1].lambda) < 1e-6 * std::abs(modes[k].lambda) &&
        modes[k].lambda.imag() > 0.0)
      part_by_whirl(modes[k], modes[k + 1], axis.across_1, axis.across_2);
  for (TurningMode& mode : modes) {
    const Eigen::VectorXcd u1 = axis.across_1 * mode.m, u2 = axis.across_2 * mode.m;
    const double area = 2.0 * u1.dot(u2).imag(), size = u1.squaredNorm() + u2.squaredNorm();
    const double all = size + (axis.along * mode.m).squaredNorm();
    // u2 lags u1 by a quarter in a turn from e1 to e2: u1 conj times u2 is -i.
    mode.whirl = size > 0.0 ? -area / size : 0.0;
    mode.across = size > 1e-12 && all > 0.0 ? size / all : 0.0;
  }
}

}  // namespace floatframe

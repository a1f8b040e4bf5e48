#include "floatframe/model/law_energy.hpp"

#include <algorithm>

namespace floatframe {

namespace {

/// Integral of one polynomial piece from x0 to x1.
double piece_integral(const PiecewisePolynomial::Piece& p, double x0, double x1) noexcept {
  const double t0 = x0 - p.centre, t1 = x1 - p.centre;
  double i0 = 0.0, i1 = 0.0;
  for (std::size_t j = p.coefficients.size(); j-- > 0;) {
    const double c = p.coefficients[j] / static_cast<double>(j + 1);
    i0 = i0 * t0 + c;
    i1 = i1 * t1 + c;
  }
  return i1 * t1 - i0 * t0;
}

}  // namespace

double law_energy(const PiecewisePolynomial& law, double s) noexcept {
  const std::vector<double>& breaks = law.breaks();
  double sum = 0.0;
  double from = std::min(0.0, s), to = std::max(0.0, s);
  std::size_t k = law.piece_index(from);
  while (true) {
    const double end = k < breaks.size() ? std::min(breaks[k], to) : to;
    sum += piece_integral(law.pieces()[k], from, end);
    if (end >= to) break;
    from = end;
    ++k;
  }
  return s >= 0.0 ? sum : -sum;
}

}  // namespace floatframe

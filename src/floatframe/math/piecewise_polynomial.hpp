#pragma once
// One scalar function for every law of the step: spring and damper laws, tables, road profiles,
// motion. Piece k holds on [breaks[k-1], breaks[k]); the first and last pieces extend to -inf and
// +inf:
//   f(x) = sum_j c[k][j] (x - centre[k])^j
// Evaluation costs a binary search over the pieces and a Horner scheme; it never allocates.
#include <algorithm>
#include <cstddef>
#include <vector>

namespace floatframe {

class PiecewisePolynomial {
 public:
  struct Piece {
    double centre = 0.0;
    std::vector<double> coefficients;  ///< ascending powers of (x - centre)
  };
  struct Value {
    double f = 0.0, df = 0.0, ddf = 0.0;
  };

  /// The zero function.
  PiecewisePolynomial() : pieces_{{0.0, {0.0}}} {}
  /// breaks ascending (equal neighbours are allowed: a jump); pieces.size() == breaks.size() + 1.
  PiecewisePolynomial(std::vector<double> breaks, std::vector<Piece> pieces)
      : breaks_(std::move(breaks)), pieces_(std::move(pieces)) {}

  static PiecewisePolynomial polynomial(std::vector<double> coefficients) {
    return PiecewisePolynomial({}, {{0.0, std::move(coefficients)}});
  }
  static PiecewisePolynomial linear(double slope, double x0) {
    return PiecewisePolynomial({}, {{x0, {0.0, slope}}});
  }

  Value operator()(double x) const noexcept { return piece_value(piece_index(x), x); }

  /// Index of the piece that holds at x; at a break the right-hand piece.
  std::size_t piece_index(double x) const noexcept {
    return std::upper_bound(breaks_.begin(), breaks_.end(), x) - breaks_.begin();
  }
  Value piece_value(std::size_t k, double x) const noexcept {
    const Piece& p = pieces_[k];
    const double t = x - p.centre;
    Value v;
    for (std::size_t j = p.coefficients.size(); j-- > 0;) {
      v.ddf = v.ddf * t + 2.0 * v.df;
      v.df = v.df * t + v.f;
      v.f = v.f * t + p.coefficients[j];
    }
    return v;
  }
  const std::vector<double>& breaks() const noexcept { return breaks_; }
  const std::vector<Piece>& pieces() const noexcept { return pieces_; }

 private:
  std::vector<double> breaks_;
  std::vector<Piece> pieces_;
};

}  // namespace floatframe

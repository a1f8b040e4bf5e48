#pragma once
// One scalar function for every law of the step: spring and damper laws, tables, road profiles,
// motion. Piece k is valid on [breaks[k-1], breaks[k]); the first and last pieces extend to -inf
// and +inf:
//   f(x) = sum_j c[k][j] (x - centre[k])^j
// Evaluation costs a binary search over the pieces and a Horner scheme; it never allocates.
//
// Edges are the breaks where f or its slope jumps. The pieces between two edges form a segment: a
// function that is continuous with its slope and is extended beyond both edges along its tangents
// (the pieces themselves may grow without bound there).
#include <algorithm>
#include <cassert>
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
      : breaks_(std::move(breaks)), pieces_(std::move(pieces)) {
    if (!breaks_.empty()) find_edges();
  }

  static PiecewisePolynomial polynomial(std::vector<double> coefficients) {
    return PiecewisePolynomial({}, {{0.0, std::move(coefficients)}});
  }
  static PiecewisePolynomial linear(double slope, double x0) {
    return PiecewisePolynomial({}, {{x0, {0.0, slope}}});
  }

  Value operator()(double x) const noexcept { return piece_value(piece_index(x), x); }

  /// Index of the piece that is valid at x; at a break the right-hand piece.
  std::size_t piece_index(double x) const noexcept {
    return std::upper_bound(breaks_.begin(), breaks_.end(), x) - breaks_.begin();
  }
  Value piece_value(std::size_t k, double x) const noexcept {
    assert(k < pieces_.size());
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
  /// Ascending, without duplicates.
  const std::vector<double>& edges() const noexcept { return edges_; }
  /// Segment k is valid on [edges[k-1], edges[k]).
  std::size_t stretch_index(double x) const noexcept {
    return std::upper_bound(edges_.begin(), edges_.end(), x) - edges_.begin();
  }
  /// Of segment k, or of the last one.
  Value stretch_value(std::size_t k, double x) const noexcept {
    if (edges_.empty()) return (*this)(x);
    k = std::min(k, edges_.size());
    double at = x;
    if (k > 0 && x < edges_[k - 1]) at = edges_[k - 1];
    if (k < edges_.size() && x > edges_[k]) at = edges_[k];
    const Stretch& s = stretches_[k];
    assert(s.first <= s.last && s.last < pieces_.size());
    Value v = piece_value(std::clamp(piece_index(at), s.first, s.last), at);
    if (at == x) return v;
    v.f += v.df * (x - at);
    v.ddf = 0.0;
    return v;
  }
  const std::vector<double>& breaks() const noexcept { return breaks_; }
  const std::vector<Piece>& pieces() const noexcept { return pieces_; }

 private:
  struct Stretch {
    std::size_t first, last;  ///< pieces
  };
  void find_edges();  // in piecewise_build.cpp

  std::vector<double> breaks_;
  std::vector<Piece> pieces_;
  std::vector<double> edges_;
  std::vector<Stretch> stretches_;  ///< one more than edges, if there is an edge
};

}  // namespace floatframe

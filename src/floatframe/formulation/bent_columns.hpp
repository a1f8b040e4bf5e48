#pragma once
// One of the fields of a node of a stiffening body, laid out for speed: with symmetric h_j
//   u(y) = X y + 1/2 e_j y^T h_j y,   its columns X(y) = X + e_j y^T h_j,  u(y) = (X + X(y)) y / 2,
// and the acceleration e_j ydot^T h_j ydot of rates.
#include <array>
#include <cassert>

#include "floatframe/body/second_order.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/lanes.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

class BentColumns {
 public:
  BentColumns() = default;
  /// X: 3 x nm; h: nm x nm each.
  BentColumns(const Mat3X& X, const std::array<MatX, 3>& h)
      : bends_(!(h[0].isZero(0.0) && h[1].isZero(0.0) && h[2].isZero(0.0))), X_(X) {
    const Eigen::Index nm = X.cols();
    assert(h[0].rows() == nm && h[0].cols() == nm && is_symmetric(h[0]));
    assert(is_symmetric(h[1]) && is_symmetric(h[2]));
    moved_ = VecX::Zero((3 * nm + 3) & ~3);
    by_mode_ = MatX::Zero(moved_.size(), nm);
    pairs_ = MatX::Zero(4, nm * (nm + 1) / 2);
    Eigen::Index pair = 0;
    for (Eigen::Index b = 0; b < nm; ++b) {
      for (Eigen::Index a = 0; a < nm; ++a)
        for (int j = 0; j < 3; ++j) by_mode_(3 * a + j, b) = h[j](a, b);
      for (Eigen::Index a = 0; a <= b; ++a, ++pair)
        for (int j = 0; j < 3; ++j) pairs_(j, pair) = (a == b ? 1.0 : 2.0) * h[j](a, b);
    }
  }
  /// False if all h_j are zero.
  bool bends() const noexcept { return bends_; }

  /// Writes X(y), 3 x nm, and returns u(y).
  Vec3 bend(const double* y, double* X) noexcept {
    assert(y && X && X_.cols() > 0);
    const int nm = static_cast<int>(X_.cols());
    add_by_mode(y, nm);
    const double* x = X_.data();
    const double* h = moved_.data();
    Vec3 u = Vec3::Zero();
    for (int k = 0; k < nm; ++k, x += 3, h += 3, X += 3)
      for (int j = 0; j < 3; ++j) {
        u[j] += y[k] * (x[j] + 0.5 * h[j]);
        X[j] = x[j] + h[j];
      }
    return u;
  }
  /// u(y + dy)
  Vec3 at(const double* y, const double* dy) const noexcept {
    Vec3 u = 0.5 * sum_of_pairs([&](int k) { return y[k] + dy[k]; });
    for (Eigen::Index k = 0; k < X_.cols(); ++k) u += (y[k] + dy[k]) * X_.col(k);
    return u;
  }
  /// e_j x^T h_j x
  Vec3 quadratic(const double* x) const noexcept {
    return sum_of_pairs([x](int k) { return x[k]; });
  }

 private:
  template <class Amplitude>
  Vec3 sum_of_pairs(Amplitude&& x) const noexcept {
    const int nm = static_cast<int>(X_.cols());
    const double* p = pairs_.data();
    Lanes q = {};
    for (int b = 0; b < nm; ++b) {
      Lanes row = {};
      for (int a = 0; a <= b; ++a, p += 4) row += x(a) * lanes(p);
      q += x(b) * row;
    }
    return {q[0], q[1], q[2]};
  }
  /// moved = y^T h, column by column; four modes at a time.
  void add_by_mode(const double* y, int nm) noexcept {
    const int rows = static_cast<int>(moved_.size());
    double* out = moved_.data();
    const double* c = by_mode_.data();
    assert(nm == by_mode_.cols() && rows == by_mode_.rows());
    int k = 0;
    if (nm & 1) {
      for (int r = 0; r < rows; r += 4) lanes(out + r) = y[0] * lanes(c + r);
      k = 1;
    } else {
      const double y0 = y[0], y1 = y[1];
      const double* d = c + rows;
      for (int r = 0; r < rows; r += 4) lanes(out + r) = y0 * lanes(c + r) + y1 * lanes(d + r);
      k = 2;
    }
    c += static_cast<std::ptrdiff_t>(k) * rows;
    for (; k + 3 < nm; k += 4, c += static_cast<std::ptrdiff_t>(4) * rows) {
      const double y0 = y[k], y1 = y[k + 1], y2 = y[k + 2], y3 = y[k + 3];
      const double *c1 = c + rows, *c2 = c1 + rows, *c3 = c2 + rows;
      for (int r = 0; r < rows; r += 4)
        lanes(out + r) +=
            (y0 * lanes(c + r) + y1 * lanes(c1 + r)) + (y2 * lanes(c2 + r) + y3 * lanes(c3 + r));
    }
    for (; k + 1 < nm; k += 2, c += static_cast<std::ptrdiff_t>(2) * rows) {
      const double y0 = y[k], y1 = y[k + 1];
      const double* d = c + rows;
      for (int r = 0; r < rows; r += 4) lanes(out + r) += y0 * lanes(c + r) + y1 * lanes(d + r);
    }
  }

  bool bends_ = false;
  Mat3X X_;       ///< at y = 0
  MatX by_mode_;  ///< row 3a+j, column b: h_j(a, b); rows filled up to whole lanes
  MatX pairs_;    ///< 4 x nm (nm+1)/2, of the pairs of modes a <= b, those of two modes twice
  VecX moved_;    ///< scratch: e_j y^T h_j
};

/// A node of a stiffening body.
struct BentNode {
  const SecondOrderNode* h = nullptr;
  BentColumns place, turn;
};

}  // namespace floatframe

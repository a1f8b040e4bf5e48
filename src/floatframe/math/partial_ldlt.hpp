#pragma once
// Dense partial factorisation F = L D L^T of the leading columns of a symmetric front (multifrontal
// elimination). The front holds its lower triangle, column major. After `partial_ldlt(n, ne)`:
//   columns 0..ne-1 below the diagonal   L
//   their diagonal                       1/D
//   trailing (n-ne) block                the Schur complement
// No pivoting: the tangents of this code are dominated by mass and penalty. A pivot that cancels to
// round-off, or is not finite, stops the factorisation. Cost: sum over eliminated columns of
// (n-j)^2/2 multiplications.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "floatframe/math/lanes.hpp"

namespace floatframe {

/// Pivots smaller than this fraction of the original diagonal are round-off.
inline constexpr double pivot_tolerance = 1e-14;

/// Leading dimension of a front of n rows: a multiple of four, so that whole SIMD lanes are
/// processed.
inline constexpr int front_stride(int n) noexcept { return (n + 3) & ~3; }

/// The W columns c0, ... from row j0 on: L of the panel, its pivots and their inverses. Returns -1
/// or the column whose pivot vanished.
template <int W>
inline int factorise_panel(double* c0, int j0, int ld, const double* original, double* d,
                           double* inverse, double tolerance) noexcept {
  double w[4][W] = {}, l[4][W] = {};  // the triangle: L D and L
  for (int j = 0; j < W; ++j) {
    double* cj = c0 + j * ld + j0;
    for (int i = j; i < 4; ++i) {
      double x = cj[i];
      for (int p = 0; p < j; ++p) x -= l[i][p] * w[j][p];
      w[i][j] = x;
    }
    const double pivot = w[j][j];
    if (!(std::abs(pivot) > tolerance * std::abs(original[j])) || !std::isfinite(pivot)) return j;
    d[j] = pivot;
    inverse[j] = 1.0 / pivot;
    for (int i = j + 1; i < 4; ++i) cj[i] = l[i][j] = w[i][j] * inverse[j];
  }
  // Below the triangle, four rows of the panel in registers.
  for (int i = j0 + 4; i < ld; i += 4) {
    Lanes x[W];
    for (int j = 0; j < W; ++j) {
      x[j] = lanes(c0 + j * ld + i);
      for (int p = 0; p < j; ++p) x[j] -= w[j][p] * x[p];
      x[j] *= inverse[j];
      lanes(c0 + j * ld + i) = x[j];
    }
  }
  return -1;
}

/// Trailing update of the columns from j1 on by the W of a panel.
template <int W>
inline void take_panel(double* f, const double* c0, int j1, int n, int ld,
                       const double* d) noexcept {
  for (int k = j1; k < n; ++k) {
    double* a = f + k * ld;
    double w[W];
    for (int p = 0; p < W; ++p) w[p] = c0[p * ld + k] * d[p];
    for (int i = k & ~3; i < ld; i += 4) {
      Lanes x = lanes(a + i);
      for (int p = 0; p < W; ++p) x -= w[p] * lanes(c0 + p * ld + i);
      lanes(a + i) = x;
    }
  }
}

/// Rows n and beyond, which whole lanes read, of the columns to the left of the last lane.
inline bool padding_is_zero(const double* f, int n) noexcept {
  const int ld = front_stride(n);
  for (int j = 0; j < (n & ~3); ++j)
    for (int i = n; i < ld; ++i)
      if (f[j * ld + i] != 0.0 && !std::isnan(f[j * ld + i])) return false;
  return true;
}

/// Returns -1, or the first column whose pivot is at most `tolerance` times `original` (size ne):
/// its diagonal before any elimination, including that in earlier fronts. The leading dimension is
/// `front_stride(n)`; rows n and beyond must be zero, and entries above the diagonal are scratch.
/// The diagonal of eliminated columns receives 1/D.
inline int partial_ldlt(double* f, int n, int ne, const double* original,
                        double tolerance) noexcept {
  assert(0 <= ne && ne <= n && tolerance >= 0.0);
  assert(padding_is_zero(f, n));
  const int ld = front_stride(n);
  constexpr int width = 4;
  for (int j0 = 0; j0 < ne; j0 += width) {
    const int j1 = std::min(j0 + width, ne);
    double* c0 = f + j0 * ld;
    double inverse[width] = {}, d[width] = {};
    const int failed =
        j1 - j0 == 4   ? factorise_panel<4>(c0, j0, ld, original + j0, d, inverse, tolerance)
        : j1 - j0 == 3 ? factorise_panel<3>(c0, j0, ld, original + j0, d, inverse, tolerance)
        : j1 - j0 == 2 ? factorise_panel<2>(c0, j0, ld, original + j0, d, inverse, tolerance)
                       : factorise_panel<1>(c0, j0, ld, original + j0, d, inverse, tolerance);
    if (failed >= 0) return j0 + failed;
    // Trailing update, two columns at a time with the panel's four.
    if (j1 - j0 == width) {
      const double* c1 = c0 + ld;
      const double* c2 = c1 + ld;
      const double* c3 = c2 + ld;
      int k = j1;
      for (; k + 1 < n; k += 2) {
        double* a = f + k * ld;
        double* b = a + ld;
        const double a0 = c0[k] * d[0], a1 = c1[k] * d[1], a2 = c2[k] * d[2], a3 = c3[k] * d[3];
        const double b0 = c0[k + 1] * d[0], b1 = c1[k + 1] * d[1], b2 = c2[k + 1] * d[2],
                     b3 = c3[k + 1] * d[3];
        for (int i = k & ~3; i < ld; i += 4) {
          const Lanes l0 = lanes(c0 + i), l1 = lanes(c1 + i), l2 = lanes(c2 + i),
                      l3 = lanes(c3 + i);
          lanes(a + i) -= (a0 * l0 + a1 * l1) + (a2 * l2 + a3 * l3);
          lanes(b + i) -= (b0 * l0 + b1 * l1) + (b2 * l2 + b3 * l3);
        }
      }
      if (k < n) {
        double* a = f + k * ld;
        const double a0 = c0[k] * d[0], a1 = c1[k] * d[1], a2 = c2[k] * d[2], a3 = c3[k] * d[3];
        for (int i = k & ~3; i < ld; i += 4)
          lanes(a + i) -=
              (a0 * lanes(c0 + i) + a1 * lanes(c1 + i)) + (a2 * lanes(c2 + i) + a3 * lanes(c3 + i));
      }
    } else if (j1 - j0 == 3) {
      take_panel<3>(f, c0, j1, n, ld, d);
    } else if (j1 - j0 == 2) {
      take_panel<2>(f, c0, j1, n, ld, d);
    } else {
      take_panel<1>(f, c0, j1, n, ld, d);
    }
    for (int j = j0; j < j1; ++j) f[j * ld + j] = inverse[j - j0];
  }
  return -1;
}

/// The same for a single front: `original` receives its diagonal.
inline int partial_ldlt(double* f, int n, int ne, double* original) noexcept {
  assert(0 <= ne && ne <= n);
  const int ld = front_stride(n);
  for (int j = 0; j < ne; ++j) original[j] = f[j * ld + j];
  return partial_ldlt(f, n, ne, original, pivot_tolerance);
}

/// b(0..n) with the front's L: forward substitution of the eliminated columns, then division by D.
/// The trailing part of b becomes b2 - L21 L11^-1 b1. b has room for `front_stride(n)` finite
/// numbers.
inline void partial_forward(const double* f, int n, int ne, double* b) noexcept {
  assert(0 <= ne && ne <= n);
  const int ld = front_stride(n);
  for (int j0 = 0; j0 < ne; j0 += 4) {
    const int j1 = std::min(j0 + 4, ne), rest = j0 + 4;
    const double* c = f + j0 * ld;
    if (j1 == rest) {
      const double *c1 = c + ld, *c2 = c1 + ld, *c3 = c2 + ld;
      double* t = b + j0;
      const double b0 = t[0];
      const double b1 = t[1] - b0 * c[j0 + 1];
      const double b2 = t[2] - b0 * c[j0 + 2] - b1 * c1[j0 + 2];
      const double b3 = t[3] - b0 * c[j0 + 3] - b1 * c1[j0 + 3] - b2 * c2[j0 + 3];
      lanes(t) = Lanes{b0, b1, b2, b3};
      for (int i = rest; i < ld; i += 4)
        lanes(b + i) -=
            (b0 * lanes(c + i) + b1 * lanes(c1 + i)) + (b2 * lanes(c2 + i) + b3 * lanes(c3 + i));
    } else {
      for (int j = j0; j < j1; ++j, c += ld) {
        for (int i = j + 1; i < rest; ++i) b[i] -= b[j] * c[i];
        for (int i = rest; i < ld; i += 4) lanes(b + i) -= b[j] * lanes(c + i);
      }
    }
  }
  for (int j = 0; j < ne; ++j) b[j] *= f[j * ld + j];
}

/// Backward substitution: b(0..ne) -= L21^T b(ne..n), then L11^-T.
inline void partial_backward(const double* f, int n, int ne, double* b) noexcept {
  assert(0 <= ne && ne <= n);
  const int ld = front_stride(n);
  for (int j0 = (ne - 1) & ~3; j0 >= 0; j0 -= 4) {
    const int j1 = std::min(j0 + 4, ne), rest = j0 + 4;
    const double* c = f + j0 * ld;
    if (j1 == rest) {
      const double *c1 = c + ld, *c2 = c1 + ld, *c3 = c2 + ld;
      Lanes s0 = {}, s1 = {}, s2 = {}, s3 = {};
      for (int i = rest; i < ld; i += 4) {
        const Lanes x = lanes(b + i);
        s0 += x * lanes(c + i);
        s1 += x * lanes(c1 + i);
        s2 += x * lanes(c2 + i);
        s3 += x * lanes(c3 + i);
      }
      double* t = b + j0;
      const double x3 = t[3] - sum(s3);
      const double x2 = t[2] - sum(s2) - c2[j0 + 3] * x3;
      const double x1 = t[1] - sum(s1) - c1[j0 + 3] * x3 - c1[j0 + 2] * x2;
      const double x0 = t[0] - sum(s0) - c[j0 + 3] * x3 - c[j0 + 2] * x2 - c[j0 + 1] * x1;
      lanes(t) = Lanes{x0, x1, x2, x3};  // read as lanes by the next panel
      continue;
    }
    for (int j = j1; j-- > j0;) {
      const double* cj = f + j * ld;
      Lanes v = {};
      for (int i = rest; i < ld; i += 4) v += lanes(b + i) * lanes(cj + i);
      double s = sum(v);
      for (int i = j + 1; i < rest; ++i) s += cj[i] * b[i];
      b[j] -= s;
    }
  }
}

}  // namespace floatframe

#pragma once
// Dense partial factorisation F = L D L^T of the leading columns of a symmetric front (multifrontal
// elimination). The front holds its lower triangle, column major. After `partial_ldlt(n, ne)`:
//   columns 0..ne-1 below the diagonal: L; diagonal: D; trailing (n-ne) block: the Schur
//   complement.
// No pivoting: the tangents of this code are dominated by mass and penalty. A pivot that cancels to
// round-off, or is not finite, stops the factorisation. Cost: sum over eliminated columns of
// (n-j)^2/2 multiplications.
#include <algorithm>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Pivots smaller than this fraction of the original diagonal are round-off.
inline constexpr double pivot_tolerance = 1e-14;

/// Leading dimension for a front of n rows: a multiple of four, so that whole SIMD lanes are worked
/// on.
inline constexpr int front_stride(int n) noexcept { return (n + 3) & ~3; }

/// Returns -1, or the first column whose pivot vanished. `original` receives the diagonal before
/// elimination (size ne). With a leading dimension that is a multiple of four, rows n..ld must be
/// zero, and entries above the diagonal are scratch.
inline int partial_ldlt(double* f, int ld, int n, int ne, double* original) noexcept {
  for (int j = 0; j < ne; ++j) original[j] = f[j * ld + j];
  const bool padded = ld % 4 == 0;
  const int end = padded ? front_stride(n) : n;
  const int mask = padded ? ~3 : ~0;
  constexpr int width = 4;
  for (int j0 = 0; j0 < ne; j0 += width) {
    const int j1 = std::min(j0 + width, ne);
    for (int j = j0; j < j1; ++j) {  // factorise the panel column by column, left-looking inside it
      double* __restrict cj = f + j * ld;
      for (int p = j0; p < j; ++p) {
        const double* __restrict cp = f + p * ld;
        const double w = cp[j] * cp[p];
        for (int i = j & mask; i < end; ++i) cj[i] -= w * cp[i];
      }
      const double d = cj[j];
      if (!(std::abs(d) > pivot_tolerance * std::abs(original[j])) || !std::isfinite(d)) return j;
      const double inverse = 1.0 / d;
      for (int i = j + 1; i < end; ++i) cj[i] *= inverse;
    }
    const double* __restrict c0 = f + j0 * ld;
    if (j1 - j0 == width) {  // trailing update with four columns at once
      const double* __restrict c1 = c0 + ld;
      const double* __restrict c2 = c1 + ld;
      const double* __restrict c3 = c2 + ld;
      const double d0 = c0[j0], d1 = c1[j0 + 1], d2 = c2[j0 + 2], d3 = c3[j0 + 3];
      for (int k = j1; k < n; ++k) {
        double* __restrict ck = f + k * ld;
        const double w0 = c0[k] * d0, w1 = c1[k] * d1, w2 = c2[k] * d2, w3 = c3[k] * d3;
        for (int i = k & mask; i < end; ++i)
          ck[i] -= w0 * c0[i] + w1 * c1[i] + w2 * c2[i] + w3 * c3[i];
      }
    } else {
      for (int p = j0; p < j1; ++p) {
        const double* __restrict cp = f + p * ld;
        const double d = cp[p];
        for (int k = j1; k < n; ++k) {
          double* __restrict ck = f + k * ld;
          const double w = cp[k] * d;
          for (int i = k & mask; i < end; ++i) ck[i] -= w * cp[i];
        }
      }
    }
  }
  return -1;
}

/// b(0..n) with the front's L: forward substitution of the eliminated columns, then division by D.
/// The trailing part of b becomes b2 - L21 L11^-1 b1.
inline void partial_forward(const double* f, int ld, int n, int ne, double* b) noexcept {
  for (int j = 0; j < ne; ++j) {
    const double* __restrict c = f + j * ld;
    const double w = b[j];
    for (int i = j + 1; i < n; ++i) b[i] -= w * c[i];
  }
  for (int j = 0; j < ne; ++j) b[j] /= f[j * ld + j];
}

/// Backward substitution: b(0..ne) -= L21^T b(ne..n), then L11^-T.
inline void partial_backward(const double* f, int ld, int n, int ne, double* b) noexcept {
  for (int j = ne; j-- > 0;) {
    const double* __restrict c = f + j * ld;
    double sum = 0.0;
    for (int i = j + 1; i < n; ++i) sum += c[i] * b[i];
    b[j] -= sum;
  }
}

}  // namespace floatframe

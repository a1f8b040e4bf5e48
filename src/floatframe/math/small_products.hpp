#pragma once
// Products with small column-major matrices, most of them twist directions (six rows): too small
// for a general matrix product to be efficient.
#include <cassert>

#include "floatframe/math/lanes.hpp"

namespace floatframe {

/// z += A x, A 6 x n.
inline void add_times(const double* A, int n, const double* x, double* z) noexcept {
  assert(n >= 0 && (n == 0 || (A && x)) && z);
  double z0 = z[0], z1 = z[1], z2 = z[2], z3 = z[3], z4 = z[4], z5 = z[5];
  for (int j = 0; j < n; ++j, A += 6) {
    const double w = x[j];
    z0 += A[0] * w;
    z1 += A[1] * w;
    z2 += A[2] * w;
    z3 += A[3] * w;
    z4 += A[4] * w;
    z5 += A[5] * w;
  }
  z[0] = z0;
  z[1] = z1;
  z[2] = z2;
  z[3] = z3;
  z[4] = z4;
  z[5] = z5;
}

inline double dot6(const double* a, const double* b) noexcept {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5]);
}

/// out += A x, A rows x columns.
inline void add_product(const double* A, int rows, int columns, const double* x,
                        double* out) noexcept {
  assert(rows >= 0 && columns >= 0 && (out < x || out >= x + columns));
  int j = 0;
  for (; j + 1 < columns; j += 2, A += 2 * rows) {
    const double x0 = x[j], x1 = x[j + 1];
    const double* B = A + rows;
    int i = 0;
    for (; i + 4 <= rows; i += 4) lanes(out + i) += x0 * lanes(A + i) + x1 * lanes(B + i);
    for (; i < rows; ++i) out[i] += A[i] * x0 + B[i] * x1;
  }
  if (j == columns) return;
  int i = 0;
  for (; i + 4 <= rows; i += 4) lanes(out + i) += x[j] * lanes(A + i);
  for (; i < rows; ++i) out[i] += A[i] * x[j];
}

/// out += A^T f, A 6 x n.
inline void add_transposed_times(const double* A, int n, const double* f, double* out) noexcept {
  assert(n >= 0 && (n == 0 || (A && out)) && f);
  for (int j = 0; j < n; ++j, A += 6) out[j] += dot6(A, f);
}

/// out = A^T f, A 6 x n.
inline void transposed_times(const double* A, int n, const double* f, double* out) noexcept {
  assert(n >= 0 && (n == 0 || (A && out)) && f);
  for (int j = 0; j < n; ++j, A += 6) out[j] = dot6(A, f);
}

}  // namespace floatframe

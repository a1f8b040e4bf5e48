#pragma once
// Dense partial factorisation P F P^T = L D L^T of the leading columns of a symmetric indefinite
// front with pivots chosen among them, as `partial_ldlt` without the choice: D has blocks of 1x1
// and 2x2 (Bunch and Kaufman 1977). For fronts in which a diagonal may vanish: the coordinates of a
// massless body together with the multipliers that constrain it. The front contains its lower
// triangle, column major, with leading dimension `front_stride(n)`; it is small and rare: simple
// loops.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Pivot choices needed for the solution; memory for `columns` of them.
struct PivotOrder {
  PivotOrder() = default;
  explicit PivotOrder(int columns)
      : row(columns, 0),
        pair(columns, 0),
        diagonal(VecX::Zero(columns)),
        beside(VecX::Zero(columns)),
        size(VecX::Zero(columns)),
        work(VecX::Zero(columns)) {}
  std::vector<int> row;   ///< row[j]: the column of the front that is eliminated as the j-th
  std::vector<int> pair;  ///< 1 at the first column of a 2x2 pivot
  VecX diagonal, beside;  ///< of D^-1; `beside`: off-diagonal, at the first column of a 2x2 pivot
  VecX size;              ///< of each diagonal: largest sum of its terms
  VecX work;
};

/// Swaps columns and rows i < j of the front, both among the leading ne.
inline void swap_in_front(double* f, int n, int i, int j, PivotOrder& p) noexcept {
  assert(0 <= i && i < j && j < n && j < std::ssize(p.row));
  const int ld = front_stride(n);
  const auto at = [&](int row, int column) -> double& { return f[column * ld + row]; };
  for (int k = 0; k < i; ++k) std::swap(at(i, k), at(j, k));
  std::swap(at(i, i), at(j, j));
  for (int k = i + 1; k < j; ++k) std::swap(at(k, i), at(j, k));
  for (int k = j + 1; k < n; ++k) std::swap(at(k, i), at(k, j));
  std::swap(p.row[i], p.row[j]);
  std::swap(p.size[i], p.size[j]);
}

/// Returns -1, or a column (of the front as given) for which no remaining pivot exceeds `tolerance`
/// times the terms of its diagonal.
inline int pivoted_ldlt(double* f, int n, int ne, PivotOrder& p, double tolerance) noexcept {
  assert(0 <= ne && ne <= n && tolerance >= 0.0);
  assert(std::ssize(p.row) == ne && p.size.size() == ne);
  const int ld = front_stride(n);
  const auto at = [&](int row, int column) -> double& { return f[column * ld + row]; };
  for (int j = 0; j < ne; ++j) {
    p.row[j] = j;
    p.pair[j] = 0;
    p.size[j] = std::abs(at(j, j));
  }
  // The usual bound of growth: (1 + sqrt(17))/8.
  constexpr double bound = 0.6403882032022076;
  const auto largest_beside = [&](int column, int from, int& where) {
    double most = 0.0;
    where = -1;
    for (int i = from; i < ne; ++i) {
      if (i == column) continue;
      const double x = std::abs(i > column ? at(i, column) : at(column, i));
      if (x > most) most = x, where = i;
    }
    return most;
  };
  for (int k = 0; k < ne;) {
    int r = -1, other = -1;
    const double beside = largest_beside(k, k, r);
    bool two = false;
    if (std::abs(at(k, k)) < bound * beside) {
      const double in_r = largest_beside(r, k, other);
      if (std::abs(at(k, k)) * in_r >= bound * beside * beside) {
        // The diagonal entry is large enough.
      } else if (std::abs(at(r, r)) >= bound * in_r) {
        swap_in_front(f, n, k, r, p);
      } else {
        two = true;
        if (r != k + 1) swap_in_front(f, n, k + 1, r, p);
      }
    }
    if (!two) {
      const double d = at(k, k);
      if (!(std::abs(d) > tolerance * p.size[k]) || !std::isfinite(d)) return p.row[k];
      const double inverse = 1.0 / d;
      for (int j = k + 1; j < n; ++j) {
        const double l = at(j, k) * inverse;
        if (l == 0.0) continue;
        if (j < ne) p.size[j] = std::max(p.size[j], std::abs(at(j, j)) + std::abs(l * at(j, k)));
        for (int i = j; i < n; ++i) at(i, j) -= l * at(i, k);
      }
      for (int j = k + 1; j < n; ++j) at(j, k) *= inverse;
      p.diagonal[k] = inverse;
      p.beside[k] = 0.0;
      k += 1;
      continue;
    }
    const double a = at(k, k), b = at(k + 1, k), c = at(k + 1, k + 1);
    const double det = a * c - b * b;  // |a c| < bound^2 b^2: no cancellation
    if (!(std::abs(det) > 0.0) || !std::isfinite(det)) return p.row[k];
    const double ia = c / det, ib = -b / det, ic = a / det;
    for (int j = k + 2; j < n; ++j) {
      const double x = at(j, k), y = at(j, k + 1);
      const double lx = ia * x + ib * y, ly = ib * x + ic * y;
      if (lx == 0.0 && ly == 0.0) continue;
      if (j < ne)
        p.size[j] = std::max(p.size[j], std::abs(at(j, j)) + std::abs(lx * x) + std::abs(ly * y));
      for (int i = j; i < n; ++i) at(i, j) -= lx * at(i, k) + ly * at(i, k + 1);
    }
    for (int j = k + 2; j < n; ++j) {
      const double x = at(j, k), y = at(j, k + 1);
      at(j, k) = ia * x + ib * y;
      at(j, k + 1) = ib * x + ic * y;
    }
    p.pair[k] = 1;
    p.diagonal[k] = ia;
    p.diagonal[k + 1] = ic;
    p.beside[k] = ib;
    p.beside[k + 1] = 0.0;
    k += 2;
  }
  return -1;
}

/// log |det D|.
inline double pivoted_log(int ne, const PivotOrder& p) noexcept {
  assert(p.diagonal.size() == ne);
  double sum = 0.0;
  for (int k = 0; k < ne; ++k) {
    double inverse = p.diagonal[k];
    if (p.pair[k] != 0) {
      inverse = p.diagonal[k] * p.diagonal[k + 1] - p.beside[k] * p.beside[k];
      ++k;
    }
    sum -= std::log(std::abs(inverse));
  }
  return sum;
}

/// As `partial_forward`: the leading part of b becomes D^-1 L^-1 P b1, the trailing one
/// b2 - L21 L11^-1 P b1.
inline void pivoted_forward(const double* f, int n, int ne, PivotOrder& p, double* b) noexcept {
  assert(0 <= ne && ne <= n && p.work.size() == ne);
  const int ld = front_stride(n);
  for (int j = 0; j < ne; ++j) p.work[j] = b[p.row[j]];
  for (int j = 0; j < ne; ++j) b[j] = p.work[j];
  for (int j = 0; j < ne; ++j) {
    const double* column = f + j * ld;
    for (int i = j + 1 + p.pair[j]; i < n; ++i) b[i] -= column[i] * b[j];
  }
  for (int j = 0; j < ne; ++j) {
    if (p.pair[j] == 0) {
      b[j] *= p.diagonal[j];
      continue;
    }
    const double x = b[j], y = b[j + 1];
    b[j] = p.diagonal[j] * x + p.beside[j] * y;
    b[j + 1] = p.beside[j] * x + p.diagonal[j + 1] * y;
    ++j;
  }
}

/// As `partial_backward`, with the order of the front restored.
inline void pivoted_backward(const double* f, int n, int ne, PivotOrder& p, double* b) noexcept {
  assert(0 <= ne && ne <= n && p.work.size() == ne);
  const int ld = front_stride(n);
  for (int j = ne; j-- > 0;) {
    const double* column = f + j * ld;
    double sum = 0.0;
    for (int i = j + 1 + p.pair[j]; i < n; ++i) sum += column[i] * b[i];
    b[j] -= sum;
  }
  for (int j = 0; j < ne; ++j) p.work[p.row[j]] = b[j];
  for (int j = 0; j < ne; ++j) b[j] = p.work[j];
}

}  // namespace floatframe

#pragma once
// What asserts of step time say of numbers, and NaN in place of results before they are computed.
// A Newton iteration that diverges is no mistake of a programmer: what must be unit, orthonormal or
// symmetric may also be NaN, and only `all_finite` fails then. Release builds call none of this.
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <type_traits>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// n numbers from x on.
inline bool all_finite(const double* x, Eigen::Index n) noexcept {
  while (n > 0 && std::isfinite(x[n - 1])) --n;
  return n == 0;
}
template <class D>
bool all_finite(const Eigen::DenseBase<D>& x) noexcept {
  return x.allFinite();
}

template <class X>
bool is_index(std::ptrdiff_t i, const X& x) noexcept {
  return i >= 0 && i < std::ssize(x);
}

/// |x| = 1: a direction, or the coefficients of a quaternion.
template <class D>
bool is_unit(const Eigen::MatrixBase<D>& x) noexcept {
  return !(std::abs(x.squaredNorm() - 1.0) > 1e-6);
}
inline bool is_unit(const Eigen::Quaterniond& q) noexcept { return is_unit(q.coeffs()); }

/// R^T R = I and det R = 1.
inline bool is_rotation(const Mat3& R) noexcept {
  return !((R.transpose() * R - Mat3::Identity()).norm() > 1e-6) && !(R.determinant() < 0.0);
}

template <class D>
bool is_symmetric(const Eigen::MatrixBase<D>& M) noexcept {
  return M.rows() == M.cols() && !((M - M.transpose()).norm() > 1e-9 * M.norm());
}

/// Debug builds: x, a number or a matrix, is NaN until it is computed.
template <class X>
inline void poison([[maybe_unused]] X&& x) noexcept {
#ifndef NDEBUG
  if constexpr (std::is_arithmetic_v<std::remove_reference_t<X>>)
    x = std::numeric_limits<double>::quiet_NaN();
  else
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
#endif
}

}  // namespace floatframe

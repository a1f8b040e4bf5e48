#pragma once
// Dual numbers x + sum_k d_k e_k, e_j e_k = 0: a value with its derivatives in n directions, exact
// to rounding: Dual those of the motion and rates of a marker, 12. Laws of elements are templates
// over their scalar, so that one text gives the value and its derivatives. Works as a scalar of
// Eigen.
#include <Eigen/Core>
#include <cmath>
#include <type_traits>

namespace floatframe {

inline constexpr int dual_directions = 12;

template <int n>
struct DualNumber {
  using Directions = Eigen::Array<double, n, 1>;
  double v = 0.0;
  Directions d = Directions::Zero();

  DualNumber() = default;
  DualNumber(double value) noexcept : v(value) {}  // NOLINT: a constant is a number
  DualNumber(double value, const Directions& directions) noexcept : v(value), d(directions) {}
  /// The number with the unit derivative in one direction.
  static DualNumber variable(double value, int direction) noexcept {
    DualNumber x(value);
    x.d[direction] = 1.0;
    return x;
  }

  DualNumber& operator+=(const DualNumber& b) noexcept {
    return *this = DualNumber(v + b.v, d + b.d);
  }
  DualNumber& operator-=(const DualNumber& b) noexcept {
    return *this = DualNumber(v - b.v, d - b.d);
  }
  DualNumber& operator*=(const DualNumber& b) noexcept {
    return *this = DualNumber(v * b.v, d * b.v + v * b.d);
  }
  DualNumber& operator/=(const DualNumber& b) noexcept {
    return *this = DualNumber(v / b.v, (d - (v / b.v) * b.d) / b.v);
  }
  friend DualNumber operator+(DualNumber a, const DualNumber& b) noexcept { return a += b; }
  friend DualNumber operator-(DualNumber a, const DualNumber& b) noexcept { return a -= b; }
  friend DualNumber operator*(DualNumber a, const DualNumber& b) noexcept { return a *= b; }
  friend DualNumber operator/(DualNumber a, const DualNumber& b) noexcept { return a /= b; }
  friend DualNumber operator-(const DualNumber& a) noexcept { return {-a.v, -a.d}; }
  // A constant has no derivatives to multiply.
  friend DualNumber operator+(const DualNumber& a, double b) noexcept { return {a.v + b, a.d}; }
  friend DualNumber operator+(double a, const DualNumber& b) noexcept { return {a + b.v, b.d}; }
  friend DualNumber operator-(const DualNumber& a, double b) noexcept { return {a.v - b, a.d}; }
  friend DualNumber operator-(double a, const DualNumber& b) noexcept { return {a - b.v, -b.d}; }
  friend DualNumber operator*(const DualNumber& a, double b) noexcept { return {a.v * b, a.d * b}; }
  friend DualNumber operator*(double a, const DualNumber& b) noexcept { return {a * b.v, a * b.d}; }
  friend DualNumber operator/(const DualNumber& a, double b) noexcept { return {a.v / b, a.d / b}; }
  friend DualNumber operator/(double a, const DualNumber& b) noexcept {
    const double q = a / b.v;
    return {q, -(q / b.v) * b.d};
  }
  friend bool operator==(const DualNumber& a, const DualNumber& b) noexcept { return a.v == b.v; }
  friend auto operator<=>(const DualNumber& a, const DualNumber& b) noexcept { return a.v <=> b.v; }
};
using Dual = DualNumber<dual_directions>;

/// f(x) of a function with the value f and the slope df at x.
template <int n>
DualNumber<n> chained(double f, double df, const DualNumber<n>& x) noexcept {
  return {f, df * x.d};
}
inline double chained(double f, double, double) noexcept { return f; }
/// f(x, y) of a function with the value f and the slopes f_x, f_y there.
template <int n>
DualNumber<n> chained(double f, double f_x, const DualNumber<n>& x, double f_y,
                      const DualNumber<n>& y) noexcept {
  return {f, f_x * x.d + f_y * y.d};
}
inline double chained(double f, double, double, double, double) noexcept { return f; }

/// At zero, where it has no derivative, that is taken as zero: a length of nothing stays at rest.
template <int n>
DualNumber<n> sqrt(const DualNumber<n>& x) noexcept {
  const double root = std::sqrt(x.v);
  if (root == 0.0) return root;
  return {root, x.d / (2.0 * root)};
}
template <int n>
DualNumber<n> abs(const DualNumber<n>& x) noexcept {
  return x.v < 0.0 ? -x : x;
}
template <int n>
DualNumber<n> sin(const DualNumber<n>& x) noexcept {
  return chained(std::sin(x.v), std::cos(x.v), x);
}
template <int n>
DualNumber<n> cos(const DualNumber<n>& x) noexcept {
  return chained(std::cos(x.v), -std::sin(x.v), x);
}
template <int n>
DualNumber<n> exp(const DualNumber<n>& x) noexcept {
  return chained(std::exp(x.v), std::exp(x.v), x);
}
template <int n>
DualNumber<n> pow(const DualNumber<n>& x, double power) noexcept {
  return chained(std::pow(x.v, power), power * std::pow(x.v, power - 1.0), x);
}
template <int n>
DualNumber<n> atan2(const DualNumber<n>& y, const DualNumber<n>& x) noexcept {
  return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / (x.v * x.v + y.v * y.v)};
}

/// The value without derivatives.
inline double value_of(double x) noexcept { return x; }
template <int n>
double value_of(const DualNumber<n>& x) noexcept {
  return x.v;
}

/// Over another scalar B: itself, or a double without its derivatives.
template <class B, class S>
B in_scalar(const S& x) noexcept {
  if constexpr (std::is_same_v<B, S>)
    return x;
  else
    return value_of(x);
}

}  // namespace floatframe

namespace Eigen {
template <>
struct NumTraits<floatframe::Dual> : NumTraits<double> {
  using Real = floatframe::Dual;
  using NonInteger = floatframe::Dual;
  using Nested = floatframe::Dual;
  using Literal = floatframe::Dual;
  enum { IsComplex = 0, RequireInitialization = 1, ReadCost = 12, AddCost = 12, MulCost = 36 };
};
template <class Op>
struct ScalarBinaryOpTraits<floatframe::Dual, double, Op> {
  using ReturnType = floatframe::Dual;
};
template <class Op>
struct ScalarBinaryOpTraits<double, floatframe::Dual, Op> {
  using ReturnType = floatframe::Dual;
};
}  // namespace Eigen

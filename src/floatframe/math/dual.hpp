#pragma once
// Dual numbers x + sum_k d_k e_k, e_j e_k = 0: a value with its derivatives in 12 directions, exact
// to rounding. Laws of elements are templates over their scalar, so that one text gives the value
// and its derivatives. Works as a scalar of Eigen.
#include <Eigen/Core>
#include <cmath>

namespace floatframe {

inline constexpr int dual_directions = 12;

struct Dual {
  using Directions = Eigen::Array<double, dual_directions, 1>;
  double v = 0.0;
  Directions d = Directions::Zero();

  Dual() = default;
  Dual(double value) noexcept : v(value) {}  // NOLINT: a constant is a number
  Dual(double value, const Directions& directions) noexcept : v(value), d(directions) {}
  /// The number with the unit derivative in one direction.
  static Dual variable(double value, int direction) noexcept {
    Dual x(value);
    x.d[direction] = 1.0;
    return x;
  }

  Dual& operator+=(const Dual& b) noexcept { return *this = Dual(v + b.v, d + b.d); }
  Dual& operator-=(const Dual& b) noexcept { return *this = Dual(v - b.v, d - b.d); }
  Dual& operator*=(const Dual& b) noexcept { return *this = Dual(v * b.v, d * b.v + v * b.d); }
  Dual& operator/=(const Dual& b) noexcept {
    return *this = Dual(v / b.v, (d - (v / b.v) * b.d) / b.v);
  }
  friend Dual operator+(Dual a, const Dual& b) noexcept { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) noexcept { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) noexcept { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) noexcept { return a /= b; }
  friend Dual operator-(const Dual& a) noexcept { return {-a.v, -a.d}; }
  friend bool operator==(const Dual& a, const Dual& b) noexcept { return a.v == b.v; }
  friend auto operator<=>(const Dual& a, const Dual& b) noexcept { return a.v <=> b.v; }
};

/// f(x) of a function with the value f and the slope df at x.
inline Dual chained(double f, double df, const Dual& x) noexcept { return {f, df * x.d}; }
inline double chained(double f, double, double) noexcept { return f; }

/// At zero, where it has no derivative, that is taken as zero: a length of nothing stays at rest.
inline Dual sqrt(const Dual& x) noexcept {
  const double root = std::sqrt(x.v);
  if (root == 0.0) return root;
  return {root, x.d / (2.0 * root)};
}
inline Dual abs(const Dual& x) noexcept { return x.v < 0.0 ? -x : x; }
inline Dual sin(const Dual& x) noexcept { return chained(std::sin(x.v), std::cos(x.v), x); }
inline Dual cos(const Dual& x) noexcept { return chained(std::cos(x.v), -std::sin(x.v), x); }
inline Dual exp(const Dual& x) noexcept { return chained(std::exp(x.v), std::exp(x.v), x); }
inline Dual pow(const Dual& x, double n) noexcept {
  return chained(std::pow(x.v, n), n * std::pow(x.v, n - 1.0), x);
}
inline Dual atan2(const Dual& y, const Dual& x) noexcept {
  return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / (x.v * x.v + y.v * y.v)};
}

/// The value without derivatives.
inline double value_of(double x) noexcept { return x; }
inline double value_of(const Dual& x) noexcept { return x.v; }

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

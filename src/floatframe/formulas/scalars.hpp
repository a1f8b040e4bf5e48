#pragma once
// The scalars that formulas are evaluated over: double, dual numbers (math/dual.hpp) and
// polynomials of second order in time.
#include "floatframe/math/dual.hpp"

namespace floatframe {

/// A function of time: value, first and second derivative.
struct Jet {
  double f = 0.0, df = 0.0, ddf = 0.0;

  Jet() = default;
  Jet(double value, double first = 0.0, double second = 0.0) noexcept  // NOLINT: a constant
      : f(value), df(first), ddf(second) {}
  friend Jet operator+(const Jet& a, const Jet& b) noexcept {
    return {a.f + b.f, a.df + b.df, a.ddf + b.ddf};
  }
  friend Jet operator-(const Jet& a, const Jet& b) noexcept {
    return {a.f - b.f, a.df - b.df, a.ddf - b.ddf};
  }
  friend Jet operator*(const Jet& a, const Jet& b) noexcept {
    return {a.f * b.f, a.df * b.f + a.f * b.df, a.ddf * b.f + 2.0 * a.df * b.df + a.f * b.ddf};
  }
  friend Jet operator/(const Jet& a, const Jet& b) noexcept {
    const double q = a.f / b.f, dq = (a.df - q * b.df) / b.f;
    return {q, dq, (a.ddf - 2.0 * dq * b.df - q * b.ddf) / b.f};
  }
  friend Jet operator-(const Jet& a) noexcept { return {-a.f, -a.df, -a.ddf}; }
};
inline double value_of(const Jet& x) noexcept { return x.f; }

/// A function of one number and its derivatives there.
struct FunctionValue {
  double f = 0.0, df = 0.0, ddf = 0.0;
};
/// The function of x.
inline double composed(const FunctionValue& g, double) noexcept { return g.f; }
template <int n>
DualNumber<n> composed(const FunctionValue& g, const DualNumber<n>& x) noexcept {
  return chained(g.f, g.df, x);
}
inline Jet composed(const FunctionValue& g, const Jet& x) noexcept {
  return {g.f, g.df * x.df, g.ddf * x.df * x.df + g.df * x.ddf};
}

}  // namespace floatframe

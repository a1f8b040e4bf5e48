#pragma once
// A function of x and y at one place: value, first and second derivatives. A scalar of formulas.
#include "floatframe/formulas/scalars.hpp"

namespace floatframe {

struct SurfaceJet {
  double f = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  SurfaceJet() = default;
  SurfaceJet(double value) noexcept : f(value) {}  // NOLINT: a constant is a function
  SurfaceJet(double value, double dx, double dy, double dxx, double dxy, double dyy) noexcept
      : f(value), x(dx), y(dy), xx(dxx), xy(dxy), yy(dyy) {}
  friend SurfaceJet operator+(const SurfaceJet& a, const SurfaceJet& b) noexcept {
    return {a.f + b.f, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend SurfaceJet operator-(const SurfaceJet& a) noexcept {
    return {-a.f, -a.x, -a.y, -a.xx, -a.xy, -a.yy};
  }
  friend SurfaceJet operator-(const SurfaceJet& a, const SurfaceJet& b) noexcept { return a + -b; }
  friend SurfaceJet operator*(const SurfaceJet& a, const SurfaceJet& b) noexcept {
    return {a.f * b.f,
            a.x * b.f + a.f * b.x,
            a.y * b.f + a.f * b.y,
            a.xx * b.f + 2.0 * a.x * b.x + a.f * b.xx,
            a.xy * b.f + a.x * b.y + a.y * b.x + a.f * b.xy,
            a.yy * b.f + 2.0 * a.y * b.y + a.f * b.yy};
  }
  /// q = a / b from q b = a.
  friend SurfaceJet operator/(const SurfaceJet& a, const SurfaceJet& b) noexcept {
    const double q = a.f / b.f, qx = (a.x - q * b.x) / b.f, qy = (a.y - q * b.y) / b.f;
    return {q,
            qx,
            qy,
            (a.xx - 2.0 * qx * b.x - q * b.xx) / b.f,
            (a.xy - qx * b.y - qy * b.x - q * b.xy) / b.f,
            (a.yy - 2.0 * qy * b.y - q * b.yy) / b.f};
  }
};
inline double value_of(const SurfaceJet& a) noexcept { return a.f; }
inline SurfaceJet composed(const FunctionValue& g, const SurfaceJet& a) noexcept {
  return {g.f,
          g.df * a.x,
          g.df * a.y,
          g.ddf * a.x * a.x + g.df * a.xx,
          g.ddf * a.x * a.y + g.df * a.xy,
          g.ddf * a.y * a.y + g.df * a.yy};
}

}  // namespace floatframe

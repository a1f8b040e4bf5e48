#pragma once
// Weights of four neighbours f_-1, f_0, f_1, f_2 for a value between f_0 and f_1: the cubic with
// the values f_0, f_1 and the slopes of the parabolas through f_-1, f_0, f_1 and f_0, f_1, f_2
// (Catmull-Rom where steps are equal), so that the function is continuous with its slope.
#include <array>

namespace floatframe {

struct CubicWeights {
  std::array<double, 4> f, df, ddf;  ///< of the value, the slope and the second derivative
};

/// At the part s of the step h; the steps before and behind it, 0 at an end: there the slope is
/// that of the step itself.
inline CubicWeights cubic_weights(double s, double before, double h, double behind) noexcept {
  // Hermite's polynomials for f_0, f_1 and the slopes m_0, m_1.
  const double s2 = s * s, s3 = s2 * s;
  const std::array<double, 3> f1{3.0 * s2 - 2.0 * s3, (6.0 * s - 6.0 * s2) / h,
                                 (6.0 - 12.0 * s) / (h * h)};
  const std::array<double, 3> m0{(s - 2.0 * s2 + s3) * h, 1.0 - 4.0 * s + 3.0 * s2,
                                 (6.0 * s - 4.0) / h};
  const std::array<double, 3> m1{(s3 - s2) * h, 3.0 * s2 - 2.0 * s, (6.0 * s - 2.0) / h};
  // m_0 = p (f_0 - f_-1) + q (f_1 - f_0) with the weights of the parabola, m_1 the same behind.
  const double p = before > 0.0 ? h / (before * (before + h)) : 0.0;
  const double q = before > 0.0 ? before / (h * (before + h)) : 1.0 / h;
  const double r = behind > 0.0 ? behind / (h * (behind + h)) : 1.0 / h;
  const double t = behind > 0.0 ? h / (behind * (behind + h)) : 0.0;
  CubicWeights w;
  const auto put = [&](std::array<double, 4>& to, int k) {
    const double one = k == 0 ? 1.0 : 0.0;
    to = {-p * m0[k], one - f1[k] + (p - q) * m0[k] - r * m1[k],
          f1[k] + q * m0[k] + (r - t) * m1[k], t * m1[k]};
  };
  put(w.f, 0);
  put(w.df, 1);
  put(w.ddf, 2);
  return w;
}

}  // namespace floatframe

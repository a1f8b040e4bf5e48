#pragma once
// Small motions of a pair of markers and derivatives by differences, for tests of elements between
// two markers.
#include "floatframe/math/so3.hpp"
#include "floatframe/model/marker_state.hpp"

namespace floatframe::test {

struct MarkerPair {
  MarkerState a, b;
};

/// Translations in world axes, rotations from the left; velocities held.
inline MarkerPair moved(const MarkerPair& p, const Vec12& x) {
  MarkerPair q = p;
  q.a.r += x.segment<3>(part_of::r_a);
  q.a.R = rotation_exp(x.segment<3>(part_of::pi_a)) * p.a.R;
  q.b.r += x.segment<3>(part_of::r_b);
  q.b.R = rotation_exp(x.segment<3>(part_of::pi_b)) * p.b.R;
  return q;
}

inline MarkerPair with_velocity(const MarkerPair& p, const Vec12& v) {
  MarkerPair q = p;
  q.a.v = v.segment<3>(part_of::r_a);
  q.a.w = v.segment<3>(part_of::pi_a);
  q.b.v = v.segment<3>(part_of::r_b);
  q.b.w = v.segment<3>(part_of::pi_b);
  return q;
}

inline Vec12 velocity(const MarkerPair& p) {
  Vec12 x;
  x << p.a.v, p.a.w, p.b.v, p.b.w;
  return x;
}

/// d f(h)/dh at 0: central differences, extrapolated (error h^4).
template <class F>
auto derivative(const F& f, double h = 2e-4) {
  const auto f1 = f(h), f2 = f(-h), f3 = f(2 * h), f4 = f(-2 * h);
  return ((8.0 * (f1 - f2) - (f3 - f4)) / (12.0 * h)).eval();
}

/// d f(x)/dx at 0, of `n` numbers x, column by column; f returns a vector.
template <class F>
MatX jacobian(const F& f, Eigen::Index n = 12) {
  MatX J;
  for (Eigen::Index k = 0; k < n; ++k) {
    const VecX column = derivative([&](double h) { return VecX(f(VecX(h * VecX::Unit(n, k)))); });
    if (k == 0) J.resize(column.size(), n);
    J.col(k) = column;
  }
  return J;
}

}  // namespace floatframe::test

#pragma once
// Values of a stress given as xx yy zz xy yz zx.
#include <Eigen/Dense>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe::test {

inline double von_mises(const Vec6& s) {
  const double a = s(0) - s(1), b = s(1) - s(2), c = s(2) - s(0);
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s.tail<3>().squaredNorm());
}

/// Of all places, one column.
inline VecX von_mises_of(const VecX& stress) {
  VecX out(stress.size() / 6);
  for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = von_mises(stress.segment<6>(6 * k));
  return out;
}

}  // namespace floatframe::test

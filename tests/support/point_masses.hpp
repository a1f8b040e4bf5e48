#pragma once
// Point masses with mode shapes of any kind: the integrals are sums.
#include <vector>

#include "floatframe/body/inertia_invariants.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {

struct PointMasses {
  std::vector<double> m;
  std::vector<Vec3> p;
  std::vector<Mat3X> X;
};

inline PointMasses random_point_masses(Random& random, int n, int nm) {
  PointMasses points;
  for (int i = 0; i < n; ++i) {
    points.m.push_back(random(0.5, 2.0));
    points.p.push_back(random.vec3());
    points.X.emplace_back(random.matrix(3, nm));
  }
  return points;
}

inline InertiaInvariants integrals_of(const PointMasses& points, int nm) {
  InertiaInvariants v = InertiaInvariants::zero(nm);
  for (std::size_t i = 0; i < points.m.size(); ++i) {
    const double m = points.m[i];
    const Vec3& p = points.p[i];
    const Mat3X& X = points.X[i];
    v.m += m;
    v.m_u += m * p;
    v.P_u += m * p * p.transpose();
    v.S += m * X;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto row = static_cast<Eigen::Index>(a);
      v.Si[a] += m * p(row) * X;
      for (std::size_t b = 0; b < 3; ++b)
        v.Sij[a][b] += m * X.row(row).transpose() * X.row(static_cast<Eigen::Index>(b));
    }
  }
  return v;
}

}  // namespace floatframe::test

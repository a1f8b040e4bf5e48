// The integrals of geometric stiffening, laid out for speed.
#include <cassert>

#include "floatframe/inertia/preprocessing.hpp"

namespace floatframe {

StiffeningData::StiffeningData(const PreprocessingData& data, const SecondOrder& second_order)
    : S_ij(data.Sij), S_ij_by_modes(data.by_modes.Sij), S(data.S), S_by_mode(data.by_modes.S) {
  const int nm = data.modes(), nl = data.by_modes.stride;
  assert(second_order.S2[0].rows() == nm && second_order.S2[0].cols() == nm);
  S2 = MatX::Zero(3 * nm, nm);
  S2_by_modes = MatX::Zero(3 * nl, nm);
  pairs = MatX::Zero(12, nm * (nm + 1) / 2);
  int pair = 0;
  for (int b = 0; b < nm; ++b) {
    for (int a = 0; a < nm; ++a) {
      const double twice = a == b ? 1.0 : 2.0;
      for (int j = 0; j < 3; ++j) {
        const double s = second_order.S2[j](b, a);
        S2(3 * a + j, b) = S2_by_modes(j * nl + a, b) = s;
        if (a <= b) pairs(j, pair) = twice * s;
        for (int i = 0; i < 3; ++i) {
          const double si = second_order.S2i[i][j](b, a);
          S_ij(9 * a + 3 * i + j, b) += si;
          S_ij_by_modes((3 * i + j) * nl + a, b) += si;
          if (a <= b) pairs(3 + 3 * i + j, pair) = twice * si;
        }
      }
      if (a <= b) ++pair;
    }
  }
  assert(pair == pairs.cols());
}

void add_stiffness(const SecondOrder& second_order, const Vec3& a, const Mat3& G, double weight,
                   MatX& out) noexcept {
  const Eigen::Index n = out.size();
  assert(out.rows() == out.cols() && out.rows() == second_order.S2[0].rows());
  assert(second_order.S2i[2][2].size() == n);
  double* o = out.data();
  for (int j = 0; j < 3; ++j) {
    const double c = weight * a[j], c0 = weight * G(j, 0), c1 = weight * G(j, 1);
    const double c2 = weight * G(j, 2);
    const double* s = second_order.S2[j].data();
    const double* s0 = second_order.S2i[0][j].data();
    const double* s1 = second_order.S2i[1][j].data();
    const double* s2 = second_order.S2i[2][j].data();
    for (Eigen::Index k = 0; k < n; ++k)
      o[k] += (c * s[k] + c0 * s0[k]) + (c1 * s1[k] + c2 * s2[k]);
  }
}

RateForces rate_forces(const StiffeningData& stiffening, int nm, const double* ydot) noexcept {
  assert((ydot || nm == 0) && stiffening.pairs.cols() == nm * (nm + 1) / 2);
  Eigen::Matrix<double, 12, 1> sum = Eigen::Matrix<double, 12, 1>::Zero();
  int pair = 0;
  for (int b = 0; b < nm; ++b)
    for (int a = 0; a <= b; ++a)
      sum += (ydot[a] * ydot[b]) * stiffening.pairs.col(pair++).head<12>();
  return {sum.head<3>(), Eigen::Map<const Mat3>(sum.data() + 3)};
}

}  // namespace floatframe

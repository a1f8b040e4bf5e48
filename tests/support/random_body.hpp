#pragma once
// Random states and bodies with a fixed seed.
#include <random>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low = -1.0, double high = 1.0) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vec3(double scale = 1.0) { return scale * Vec3((*this)(), (*this)(), (*this)()); }
  Mat3 rotation() { return rotation_exp(vec3(2.0)); }
  VecX vector(int n, double scale = 1.0) {
    VecX v(n);
    for (int i = 0; i < n; ++i) v(i) = scale * (*this)();
    return v;
  }
  MatX matrix(int rows, int columns, double scale = 1.0) {
    MatX m(rows, columns);
    for (int j = 0; j < columns; ++j) m.col(j) = vector(rows, scale);
    return m;
  }

 private:
  std::mt19937_64 engine_;
};

/// State of one body; Adot = skew(omega) A.
struct BodyState {
  Vec3 r0, omega, sdot;
  Mat3 A, Adot;
  VecX y, ydot;
};

inline BodyState random_state(Random& random, int modes) {
  BodyState s;
  s.r0 = random.vec3(2.0);
  s.omega = random.vec3(5.0);
  s.sdot = random.vec3(3.0);
  s.A = random.rotation();
  s.Adot = skew(s.omega) * s.A;
  s.y = random.vector(modes, 0.05);
  s.ydot = random.vector(modes, 1.0);
  return s;
}

/// (r0dot, udot, vdot, wdot, ydot) = T (sdot, omega, ydot):  r0dot = sdot + omega x r0, column i:
/// omega x A_i.
inline MatX absolute_from_relative(const BodyState& s) {
  const Eigen::Index nm = s.y.size();
  MatX T = MatX::Zero(12 + nm, 6 + nm);
  T.block<3, 3>(0, 0).setIdentity();
  T.block<3, 3>(0, 3) = -skew(s.r0);
  for (int i = 0; i < 3; ++i) T.block<3, 3>(3 + 3 * i, 3) = -skew(s.A.col(i));
  T.bottomRightCorner(nm, nm).setIdentity();
  return T;
}

/// Second derivatives of the absolute coordinates at (sddot, omegadot, yddot) = 0, sddot of the
/// material point.
inline VecX absolute_bias(const BodyState& s) {
  VecX bias = VecX::Zero(12 + s.y.size());
  bias.head<3>() = s.omega.cross(s.omega.cross(s.r0));
  for (int i = 0; i < 3; ++i) bias.segment<3>(3 + 3 * i) = s.omega.cross(s.omega.cross(s.A.col(i)));
  return bias;
}

}  // namespace floatframe::test

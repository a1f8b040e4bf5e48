#pragma once
// Rotations on SO(3): the skew operator, the exponential map and its tangent.
//   skew(a) b = a x b
//   rotation_exp(t) = exp(skew(t))                                        R(t)
//   rotation_tangent(t) = H(t) = I + (1-cos)/t^2 skew(t) + (t-sin)/t^3 skew(t)^2
//     so that Rdot R^T = skew(H tdot) (angular velocity in the frame R maps into).
// Series are used below |t| = 1e-2 so that no digits are lost. Source: theory.md section 10
// (docs/theory.md).
#include <cassert>
#include <cmath>
#include <type_traits>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Skew-symmetric matrix of a: skew(a) * b = a.cross(b).
inline Mat3 skew(const Vec3& a) noexcept {
  Mat3 s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return s;
}

/// Coefficients of the exponential map: s = sin(t)/t, a = (1-cos t)/t^2, b = (t-sin t)/t^3 with t =
/// |theta|, and the derivatives divided by t: da = a'(t)/t, db = b'(t)/t.
struct RotationCoefficients {
  double s, a, b, da, db;
};

inline RotationCoefficients rotation_coefficients(double t2) noexcept {
  assert(!(t2 < 0.0));
  RotationCoefficients c;
  if (t2 < 1e-4) {
    c.s = 1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0));
    c.a = 0.5 - t2 / 24.0 * (1.0 - t2 / 30.0 * (1.0 - t2 / 56.0));
    c.b = 1.0 / 6.0 - t2 / 120.0 * (1.0 - t2 / 42.0 * (1.0 - t2 / 72.0));
    c.da = -1.0 / 12.0 + t2 / 180.0 * (1.0 - t2 / 37.33333333333333);
    c.db = -1.0 / 60.0 + t2 / 1260.0 * (1.0 - t2 / 48.0);
  } else {
    const double t = std::sqrt(t2);
    const double sine = std::sin(t);
    const double half = std::sin(0.5 * t);
    c.s = sine / t;
    c.a = 2.0 * half * half / t2;
    c.b = (t - sine) / (t2 * t);
    c.da = (c.s - 2.0 * c.a) / t2;
    c.db = (c.a - 3.0 * c.b) / t2;
  }
  return c;
}

/// Rotation matrix exp(skew(theta)).
inline Mat3 rotation_exp(const Vec3& theta) noexcept {
  const RotationCoefficients c = rotation_coefficients(theta.squaredNorm());
  const Mat3 k = skew(theta);
  Mat3 r = Mat3::Identity() + c.s * k;
  r.noalias() += c.a * (k * k);
  assert(is_rotation(r));
  return r;
}

/// H(theta): angular velocity = H thetadot, in the frame that exp(skew(theta)) maps into.
inline Mat3 rotation_tangent(const Vec3& theta) noexcept {
  const RotationCoefficients c = rotation_coefficients(theta.squaredNorm());
  const Mat3 k = skew(theta);
  Mat3 h = Mat3::Identity() + c.a * k;
  h.noalias() += c.b * (k * k);
  return h;
}

/// Hdot(theta, thetadot) * thetadot: the angular acceleration for thetaddot = 0.
inline Vec3 rotation_tangent_bias(const Vec3& theta, const Vec3& rate) noexcept {
  const RotationCoefficients c = rotation_coefficients(theta.squaredNorm());
  const double tr = theta.dot(rate);
  const Vec3 u = theta.cross(rate);
  return c.da * tr * u + c.db * tr * theta.cross(u) + c.b * rate.cross(u);
}

/// Unit quaternion exp(theta/2) of the rotation vector theta.
inline Eigen::Quaterniond quaternion_exp(const Vec3& theta) noexcept {
  const double t2 = theta.squaredNorm();
  const double half = 0.5 * std::sqrt(t2);
  const double s = t2 < 1e-8 ? 0.5 - t2 / 48.0 : std::sin(half) / (2.0 * half);
  return Eigen::Quaterniond(std::cos(half), s * theta.x(), s * theta.y(), s * theta.z());
}

/// Rotation vector of a unit quaternion, length in [0, pi]; also over dual numbers.
template <class S>
Eigen::Matrix<S, 3, 1> quaternion_log(const Eigen::Quaternion<S>& q) noexcept {
  using std::atan2;
  if constexpr (std::is_same_v<S, double>) assert(is_unit(q));
  const S sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix<S, 3, 1> v = sign * q.vec();
  const S n = v.norm();
  if (n < 1e-9) return S(2.0) * v;
  return S(S(2.0) * atan2(n, S(sign * q.w())) / n) * v;
}

/// Two unit vectors that complete the unit vector n to a right-handed orthonormal triad (t1, t2,
/// n).
inline void orthonormal_complement(const Vec3& n, Vec3& t1, Vec3& t2) noexcept {
  assert(is_unit(n));
  int k = 0;
  n.cwiseAbs().minCoeff(&k);
  t1 = n.cross(Vec3::Unit(k)).normalized();
  t2 = n.cross(t1);
}

/// Axes with z along the unit vector n.
inline Mat3 frame_with_z(const Vec3& n) noexcept {
  Vec3 x, y;
  orthonormal_complement(n, x, y);
  Mat3 R;
  R << x, y, n;
  return R;
}

}  // namespace floatframe

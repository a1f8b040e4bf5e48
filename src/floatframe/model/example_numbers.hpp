#pragma once
// Repeatable random numbers and marker motions for the examples of each kind of force and
// constraint; used by tests.
#include <random>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/marker_state.hpp"

namespace floatframe {

class ExampleNumbers {
 public:
  explicit ExampleNumbers(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double scale = 1.0) {
    const double x = (*this)(-scale, scale), y = (*this)(-scale, scale);
    return {x, y, (*this)(-scale, scale)};
  }
  Vec3 direction() {
    Vec3 v = vector();
    while (v.norm() < 0.1) v = vector();
    return v.normalized();
  }
  Mat3 rotation() { return rotation_exp(vector(1.8)); }
  /// Position within a metre, arbitrary orientation and velocity.
  MarkerState marker() {
    const Vec3 r = vector(), v = vector(2.0), w = vector(2.0);
    return {r, rotation(), v, w, Vec3::Zero(), Vec3::Zero()};
  }
  /// A marker that shares the z axis of `a`, like the child's marker of a hinge.
  MarkerState marker_on_axis(const MarkerState& a) {
    MarkerState b = a;
    b.R = a.R * rotation_exp((*this)(-2.5, 2.5) * Vec3::UnitZ());
    b.w += (*this)(-2.0, 2.0) * a.R.col(2);
    return b;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace floatframe

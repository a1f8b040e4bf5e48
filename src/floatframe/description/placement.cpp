#include "floatframe/description/placement.hpp"

namespace floatframe {
namespace {

template <class F>
void place_three(std::vector<double>& values, std::size_t at, F placed) {
  if (values.size() < at + 3) return;
  Eigen::Map<Vec3> v(values.data() + at);
  v = placed(Vec3(v));
}

}  // namespace

Placement operator*(const Placement& outer, const Placement& inner) {
  return {outer.P * inner.P, outer.P * inner.t + outer.t};
}

Placement reflection(int axis, double at) {
  Placement x;
  x.P(axis, axis) = -1.0;
  x.t[axis] = 2.0 * at;
  return x;
}

Placement translation(const Vec3& shift) { return {Mat3::Identity(), shift}; }

void place_polar(std::vector<double>& values, std::size_t at, const Placement& x) {
  place_three(values, at, [&](const Vec3& v) { return x.polar(v); });
}

void place_axial(std::vector<double>& values, std::size_t at, const Placement& x) {
  place_three(values, at, [&](const Vec3& v) { return x.axial(v); });
}

void change_sign(std::vector<double>& values, std::size_t at, double sign) {
  if (values.size() > at) values[at] *= sign;
}

}  // namespace floatframe

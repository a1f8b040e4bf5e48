#pragma once
// Distance of two points and the direction of the line between them, with what is common to
// elements along a line: s = |d|, d = r_b - r_a, n = d/s, sdot = n.(v_b - v_a).
#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

/// Points closer than this define no line: the force keeps the direction x, and the tangent only
/// contains the slope of the law [m].
inline constexpr double coincident = 1e-12;

template <class S>
struct Line {
  Eigen::Matrix<S, 3, 1> n;
  S length, rate;
};

template <class S>
Line<S> line_between(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto &a = in.marker(0), &b = in.marker(1);
  const V d = b.r - a.r;
  S length = value_of(d.squaredNorm()) > 0.0 ? S(d.norm()) : d.x();
  const V n = length > coincident ? V(d / length) : V(V::UnitX());
  const S rate = n.dot(b.v - a.v);
  return {n, length, rate};
}

/// The rows f/s (I - n n^T) of a tension f along a line.
template <class S>
void add_transverse_rows(const Eigen::Matrix<S, 3, 1>& n, const S& length,
                         EffortsOf<S>& out) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    if (!(length > coincident)) return;
    const Vec3 zero = Vec3::Zero();
    Vec3 t1, t2;
    orthonormal_complement(n, t1, t2);
    const double k = out.force / length;
    out.add_pair_row({{-t1, zero}, {t1, zero}}, k, 0.0);
    out.add_pair_row({{-t2, zero}, {t2, zero}}, k, 0.0);
  }
}

// Of an element with the ends `from` and `to`.
void validate_line(const ElementCheck& check);
bool build_line(ElementBuild& build);
Picture picture_of_line(const Element& element);

}  // namespace floatframe

#pragma once
// What elements between two markers measure, and what a force of it does to them.
//   along a line    s = |d|, d = r_b - r_a, n = d/s; f n on a, -f n on b: tension is positive
//   of a joint      its coordinate, z the axis of marker a; -f acts on it:
//     along           s = z.d (axis_measure.hpp)
//     about           s = angle of x_b about z, followed over several turns; g = (0, -z, 0, z),
//                     sdot = z.(w_b - w_a)
//   of any joint    a displacement along a direction of a, the angle about z, or one of the angles
//                   about e of a and n of b (constraints/drive_axis_angle.cpp), each within half a
//                   turn of 0; g of these as there
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

/// Points closer than this define no line: the force keeps the direction x, and the tangent only
/// contains the slope of the law [m].
inline constexpr double coincident_points = 1e-12;

template <class S>
struct LineMeasure {
  Eigen::Matrix<S, 3, 1> n;
  S length, rate;
};

template <class S>
LineMeasure<S> line_measure(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto &a = in.marker(0), &b = in.marker(1);
  const V d = b.r - a.r;
  S length = value_of(d.squaredNorm()) > 0.0 ? S(d.norm()) : d.x();
  const V n = length > coincident_points ? V(d / length) : V(V::UnitX());
  const S rate = n.dot(b.v - a.v);
  return {n, length, rate};
}

/// A force of the slopes k and c along the line: rows k n n^T + f/s (I - n n^T) and c n n^T,
/// between the points.
template <class S>
void pull_along(const LineMeasure<S>& line, const S& force, double k, double c,
                EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto& [n, length, rate] = line;
  const V zero = V::Zero();
  out.length = length;
  out.rate = rate;
  out.force = force;
  const V pull = force * n;
  out.wrench[0] = {pull, zero};
  out.wrench[1] = {-pull, zero};
  out.add_pair_row({{-n, zero}, {n, zero}}, k, c);
  if constexpr (std::is_same_v<S, double>)
    if (length > coincident_points) {
      Vec3 t1, t2;
      orthonormal_complement(n, t1, t2);
      const double across = force / length;
      out.add_pair_row({{-t1, zero}, {t1, zero}}, across, 0.0);
      out.add_pair_row({{-t2, zero}, {t2, zero}}, across, 0.0);
    }
}

/// The markers of a hinge share the axis. Where they do not (cut joints before they close) the
/// torque stays along z.
template <class S>
AxisMeasure<S> coordinate_measure(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto &a = in.marker(0), &b = in.marker(1);
  const V z = a.R.col(2);
  if (!in.element.rotational) return axis_measure(z, a, b);
  const V zero = V::Zero();
  return {angle_about_z<S>(a, b, in.reference_angle), z.dot(b.w - a.w), {{zero, -z}, {zero, z}}};
}

/// A coordinate of a joint with any number of them, but no component of a rotation vector.
struct MeasuredCoordinate {
  enum class Of { displacement, common_angle, first_angle, second_angle } of = Of::common_angle;
  Vec3 e = Vec3::UnitZ();  ///< in a: the direction of a displacement, or the first axis
  Vec3 n = Vec3::UnitX();  ///< in b: the second axis
};
/// Of a joint as it is built.
MeasuredCoordinate measured_coordinate(const Joint& joint, int component);

/// An angle about one of two axes. With p the axis and r the other one, r0 as drawn, k = p.r:
/// alpha = +-atan2(r.(p x r0), r.(r0 - k p)) and g = (p - k r) / (1 - k^2).
template <class S, class Marker>
AxisMeasure<S> axis_angle_measure(const MeasuredCoordinate& c, const Marker& a,
                                  const Marker& b) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  using std::atan2;
  const bool second = c.of == MeasuredCoordinate::Of::second_angle;
  const V e_a = c.e.template cast<S>(), n_b = c.n.template cast<S>();
  const V e = a.R * e_a, n = b.R * n_b;
  const V &p = second ? n : e, &r = second ? e : n;
  const V r0 = second ? V(b.R * e_a) : V(a.R * n_b);
  const S k = p.dot(r);
  const V across = p - k * r, g = across / S(1.0 - k * k), level = r0 - p.dot(r0) * p;
  const S angle = atan2(S(r.dot(p.cross(r0))), S(r.dot(level)));
  const V zero = V::Zero();
  return {second ? S(-angle) : angle, g.dot(V(b.w - a.w)), {{zero, -g}, {zero, g}}};
}

template <class S, class Marker>
AxisMeasure<S> coordinate_measure(const MeasuredCoordinate& c, const Marker& a, const Marker& b,
                                  double reference) noexcept {
  using Of = MeasuredCoordinate::Of;
  using V = Eigen::Matrix<S, 3, 1>;
  if (c.of == Of::displacement) return axis_measure(V(a.R * V(c.e.template cast<S>())), a, b);
  if (c.of != Of::common_angle) return axis_angle_measure<S>(c, a, b);
  const V z = a.R.col(2), zero = V::Zero();
  return {angle_about_z<S>(a, b, reference), z.dot(b.w - a.w), {{zero, -z}, {zero, z}}};
}
/// Between the first two markers.
template <class S>
AxisMeasure<S> coordinate_measure(const PortsOf<S>& in, const MeasuredCoordinate& c) noexcept {
  return coordinate_measure<S>(c, in.marker(0), in.marker(1), in.reference_angle);
}

/// A force of the slopes k and c against the coordinate: the rows k g g^T and c g g^T.
template <class S>
void pull_back(const AxisMeasure<S>& m, const S& force, double k, double c,
               EffortsOf<S>& out) noexcept {
  out.length = m.s;
  out.rate = m.rate;
  out.force = force;
  out.set_pair(-force, m.g);
  out.add_pair_row(m.g, k, c);
}

/// What spring and damper are laws of, if their element has a target in signal 1, with the rate in
/// signal 2 or its own: they pull a measure s and its rate there.
template <class S>
struct TowardTarget {
  S stretch;     ///< s - target
  S rate;        ///< sdot - rate of the target
  double moves;  ///< rate of the target in the present motion: an input is constant in a step
};
template <class S>
TowardTarget<S> toward_target(const PortsOf<S>& in, const S& s, const S& s_dot) noexcept {
  const SignalValue<S> at = in.signal(1);
  const S rate = in.element.signals[2].given ? in.signal(2).f : S(at.df);
  return {s - at.f, s_dot - rate, at.df};
}
/// Its keys `target` and `target_rate` need a law.
void validate_target(const ElementCheck& check);

// Of an element with the ends `from` and `to`, and of one with the key `joint`.
void validate_line(const ElementCheck& check);
bool build_line(ElementBuild& build);
Picture picture_of_line(const Element& element);
void validate_coordinate(const ElementCheck& check);
bool build_coordinate(ElementBuild& build);
Picture picture_of_coordinate(const Element& element);

// Of an element with the keys `joint` and `coordinate`.
/// The coordinate is one of the joint and no component of a rotation vector.
void validate_any_coordinate(const ElementCheck& check);
/// None after an error.
std::optional<MeasuredCoordinate> build_any_coordinate(ElementBuild& build);

}  // namespace floatframe

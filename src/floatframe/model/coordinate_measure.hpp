#pragma once
// The only coordinate of a joint as an element measures it, z the axis of marker a:
//   along   s = z.d (axis_measure.hpp)
//   about   s = angle of x_b about z, followed over several turns; g = (0, -z, 0, z),
//           sdot = z.(w_b - w_a)
// The markers of a hinge share the axis. Where they do not (cut joints before they close) a torque
// stays along z.
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

template <class S>
AxisMeasure<S> coordinate(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto &a = in.marker(0), &b = in.marker(1);
  const V z = a.R.col(2);
  if (!in.element.rotational) return axis_measure(z, a, b);
  const V zero = V::Zero();
  return {angle_about_z<S>(a, b, in.reference_angle), z.dot(b.w - a.w), {{zero, -z}, {zero, z}}};
}

// Of an element with the key `joint`.
void validate_coordinate(const ElementCheck& check);
bool build_coordinate(ElementBuild& build);
Picture picture_of_coordinate(const Element& element);

}  // namespace floatframe

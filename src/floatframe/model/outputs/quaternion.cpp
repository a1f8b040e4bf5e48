// Rotation of a body from its design orientation, or from another frame, as a unit quaternion
// (w, x, y, z). Of q and -q it is the one nearest to the last sample; at the first one w >= 0.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

/// w, x, y, z with w >= 0.
template <class S>
Eigen::Matrix<S, 4, 1> quaternion_of(const MeasurePorts<S>& in) noexcept {
  const Eigen::Quaternion<S> q(in.rotation());
  const double sign = value_of(q.w()) < 0.0 ? -1.0 : 1.0;
  Eigen::Matrix<S, 4, 1> x;
  x << q.w(), q.x(), q.y(), q.z();
  return S(sign) * x;
}

template <class S>
S quaternion_measure(const MeasurePorts<S>& in) noexcept {
  return quaternion_of(in)[in.output.component];
}

}  // namespace

template <>
double output_value_of<OutputType::quaternion>(const SystemMotion& motion, const Output& output,
                                               FollowedOutput& last) noexcept {
  assert(output.component >= 0 && output.component < 4);
  Eigen::Map<Eigen::Vector4d> followed(last.values.data());
  const Eigen::Vector4d q = quaternion_of(measure_ports(motion, output));
  followed = (last.started && followed.dot(q) < 0.0 ? -1.0 : 1.0) * q;
  last.started = true;
  last.time = motion.t;
  return followed[output.component];
}

constinit const OutputKind quaternion_output = {
    .about = "rotation from the design orientation, or from that of `relative_to`",
    .of = OutputOf::body,
    .components = quaternion_components,
    .unit = "-",
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::axial,
    FLOATFRAME_MEASURE(quaternion)};

}  // namespace floatframe

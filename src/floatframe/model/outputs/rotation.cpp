// Rotation of a body from its design orientation, R_WB R_WB,design^T, or from another frame [rad]:
//   R = Rz(yaw) Ry(pitch) Rx(roll)
// R has the angles (roll, pitch, yaw) and (roll + pi, pi - pitch, yaw + pi), and those by turns.
// The ones of a sample are nearest to
//   x_last + (t - t_last) (xdot_last + xdot) / 2
// so that they go on over turns and through pitch = +-pi/2. With the angular velocity w of R and
// the cosine c and sine s of yaw:
//   rolldot = (c w_x + s w_y) / cos pitch,  pitchdot = c w_y - s w_x,
//   yawdot = w_z + (c w_x + s w_y) tan pitch
// where 1/cos is taken as cos/max(cos^2, 0.01): bounded, where roll and yaw are not defined.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S rotation_measure(const MeasurePorts<S>& in) noexcept {
  return near_angle(roll_pitch_yaw<S>(in.rotation())[in.output.component], in.reference);
}

/// Of the angles x with the angular velocity w.
Vec3 rotation_rates(const Vec3& x, const Vec3& w) noexcept {
  const double c = std::cos(x[2]), s = std::sin(x[2]), cos_pitch = std::cos(x[1]);
  const double rolldot =
      (c * w.x() + s * w.y()) * cos_pitch / std::max(cos_pitch * cos_pitch, 0.01);
  return {rolldot, c * w.y() - s * w.x(), w.z() + rolldot * std::sin(x[1])};
}

/// x, each angle within half a turn of the reference.
Vec3 rotation_near(Vec3 x, const Vec3& reference) noexcept {
  for (int k = 0; k < 3; ++k) x[k] = near_angle(x[k], reference[k]);
  return x;
}

}  // namespace

template <>
double output_value_of<OutputType::rotation>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput& last) noexcept {
  assert(output.component >= 0 && output.component < 3);
  const MeasurePorts<double> in = measure_ports(motion, output);
  Eigen::Map<Vec3> x(last.values.data()), xdot(last.values.data() + 3);
  const Vec3 w = in.rotation_velocity();
  constexpr double pi = std::numbers::pi;
  Vec3 a = roll_pitch_yaw<double>(in.rotation()), a_dot = rotation_rates(a, w);
  if (last.started) {
    Vec3 b(a[0] + pi, pi - a[1], a[2] + pi), b_dot = rotation_rates(b, w);
    const double half = 0.5 * (motion.t - last.time);
    const Vec3 a_expected = x + half * (xdot + a_dot), b_expected = x + half * (xdot + b_dot);
    a = rotation_near(a, a_expected);
    b = rotation_near(b, b_expected);
    if ((b - b_expected).squaredNorm() < (a - a_expected).squaredNorm()) a = b, a_dot = b_dot;
  }
  last.started = true;
  last.time = motion.t;
  x = a;
  xdot = a_dot;
  return x[output.component];
}

constinit const OutputKind rotation_output = {
    .about =
        "from the design orientation, or from that of `relative_to`: R = Rz(yaw) Ry(pitch) "
        "Rx(roll); full turns are counted",
    .of = OutputOf::body,
    .components = roll_pitch_yaw_angles,
    .unit = "rad",
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::axial,
    FLOATFRAME_MEASURE(rotation)};

}  // namespace floatframe

// Acceleration of a point, d2p_WP/dt2 [m/s2], or as seen in a frame F that moves, with
// d = p_P - p_F and the velocity v seen there:
//   a_P - a_F - wdot_F x d - w_F x (w_F x d) - 2 w_F x v
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::acceleration>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  assert(is_index(output.marker, motion.marker_accelerations));
  const MeasurePorts<double> in = measure_ports(motion, output);
  Vec3 a = motion.marker_accelerations[output.marker];
  if (in.relative) {
    const Vec3 d = in.position(), v = in.velocity(), w = in.relative->w;
    a -= motion.marker_accelerations[output.relative] +
         motion.marker_angular_accelerations[output.relative].cross(d) + w.cross(w.cross(d)) +
         2.0 * w.cross(v);
  }
  return in.along(a);
}

constinit const OutputKind acceleration_output = {
    .about = "in the world, or as seen from `relative_to`",
    .of = OutputOf::point,
    .components = world_axes,
    .unit = "m/s2",
    .needs_of_motion = {.accelerations = true},
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::polar};

}  // namespace floatframe

// Angular acceleration of a body [rad/s2], or as seen in a frame F that moves:
//   wdot_B - wdot_F - w_F x (w_B - w_F)
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::angular_acceleration>(const SystemMotion& motion,
                                                         const Output& output,
                                                         FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  const MeasurePorts<double> in = measure_ports(motion, output);
  Vec3 a = motion.body(output.body).alpha_WB;
  if (in.relative)
    a -= motion.marker_angular_accelerations[output.relative] +
         in.relative->w.cross(in.angular_velocity());
  return in.along(a);
}

constinit const OutputKind angular_acceleration_output = {
    .about = "in the world, or as seen from `relative_to`",
    .of = OutputOf::body,
    .components = world_axes,
    .unit = "rad/s2",
    .needs_of_motion = {.accelerations = true, .reactions = true},
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::axial};

}  // namespace floatframe

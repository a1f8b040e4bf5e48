// Angular acceleration of a body [rad/s2], world axes.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::angular_acceleration>(const SystemMotion& motion,
                                                         const Output& output,
                                                         FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  return motion.body(output.body).alpha_WB[output.component];
}

constinit const OutputKind angular_acceleration_output = {
    .about = "in world axes",
    .of = OutputOf::body,
    .components = world_axes,
    .unit = "rad/s2",
    .needs_of_motion = {.accelerations = true, .reactions = true}};

}  // namespace floatframe

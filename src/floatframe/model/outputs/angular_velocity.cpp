// Angular velocity of a body, w_WB [rad/s], world axes.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::angular_velocity>(const SystemMotion& motion,
                                                     const Output& output,
                                                     FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  return motion.body(output.body).w_WB[output.component];
}

constinit const OutputKind angular_velocity_output = {
    .about = "in world axes", .of = OutputOf::body, .components = world_axes, .unit = "rad/s"};

}  // namespace floatframe

// Velocity of a point, dp_WP/dt [m/s].
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::velocity>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  return motion.marker(output.marker).v[output.component];
}

constinit const OutputKind velocity_output = {
    .about = "in world axes", .of = OutputOf::point, .components = world_axes, .unit = "m/s"};

}  // namespace floatframe

// Acceleration of a point, d2p_WP/dt2 [m/s2].
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::acceleration>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  assert(is_index(output.marker, motion.marker_accelerations));
  return motion.marker_accelerations[output.marker][output.component];
}

constinit const OutputKind acceleration_output = {.about = "in world axes",
                                                  .of = OutputOf::point,
                                                  .components = world_axes,
                                                  .unit = "m/s2",
                                                  .needs_of_motion = {.accelerations = true}};

}  // namespace floatframe

// Position of a point, p_WP [m].
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::position>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  return motion.place(output.marker)[output.component];
}

constinit const OutputKind position_output = {
    .about = "in the world", .of = OutputOf::point, .components = world_axes, .unit = "m"};

}  // namespace floatframe

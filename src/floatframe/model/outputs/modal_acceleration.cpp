// Second derivative of the amplitude of a mode of a flexible body.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::modal_acceleration>(const SystemMotion& motion,
                                                       const Output& output,
                                                       FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < motion.body(output.body).ydd.size());
  return motion.body(output.body).ydd[output.component];
}

constinit const OutputKind modal_acceleration_output = {
    .about = "second derivative of the amplitude of the mode",
    .of = OutputOf::mode,
    .unit = "1/s2",
    .needs_of_motion = {.accelerations = true, .reactions = true}};

}  // namespace floatframe

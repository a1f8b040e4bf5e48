// Power of a prescribed motion, its force times the rate of the coordinate, positive into the
// system [W].
#include <cassert>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::motion_power>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  const Joint& joint = motion.model.joints[output.joint];
  assert(motion.reactions && joint.motion);
  return motion.reactions->motions[output.joint] * evaluate(*joint.motion, motion.t).df;
}

constinit const OutputKind motion_power_output = {
    .about = "power of the motor, positive into the system",
    .of = OutputOf::motion,
    .unit = "W",
    .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

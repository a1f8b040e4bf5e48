// Power of a prescribed motion, its force times the rate of the coordinate, positive into the
// system [W].
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::motion_power>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(is_index(output.element, motion.reactions->forces));
  const Signal& motor = motion.model.elements[output.element].signals[0];
  return motion.reactions->forces[output.element] * evaluate(motor.function, motion.t).df;
}

constinit const OutputKind motion_power_output = {
    .about = "power of the motor, positive into the system",
    .of = OutputOf::motion,
    .unit = "W",
    .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

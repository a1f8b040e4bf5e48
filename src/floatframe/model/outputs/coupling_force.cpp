// Force [N] or torque [N m] of a coupling: the generalised force on a coordinate is this times its
// factor.
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::coupling_force>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput&) noexcept {
  // Of elastic teeth and belts it is no reaction.
  if (motion.model.elements[output.element].acts) return motion.effort(output.element).force;
  assert(is_index(output.element, motion.reactions->forces));
  return motion.reactions->forces[output.element];
}

constinit const OutputKind coupling_force_output = {
    .about = "what it exerts on a coordinate, divided by the factor of that",
    .of = OutputOf::coupling,
    .unit = "N or N m",
    .unit_of = unit_of_force<ElementQuantity::force>,
    .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

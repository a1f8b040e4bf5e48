// Force [N] or torque [N m] of a prescribed motion along its coordinate, on the child: the load of
// a motor.
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::motion_force>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(is_index(output.element, motion.reactions->forces));
  return motion.reactions->forces[output.element];
}

constinit const OutputKind motion_force_output = {
    .about = "force or torque along the coordinate that drives it, on the child",
    .of = OutputOf::motion,
    .unit = "N or N m",
    .unit_of = unit_of_force<ElementQuantity::force>,
    .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

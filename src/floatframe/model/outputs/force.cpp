// Scalar force of a force element, tension positive [N], or its torque [N m].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::force>(const SystemMotion& motion, const Output& output,
                                          FollowedOutput&) noexcept {
  return motion.effort(output.element).force;
}

constinit const OutputKind force_output = {
    .about = "force or torque, tension positive; of a tyre the contact force",
    .of = OutputOf::force,
    .unit = "N or N m",
    .unit_of = unit_of_force<ElementQuantity::force>,
    .is_signal = true};

}  // namespace floatframe

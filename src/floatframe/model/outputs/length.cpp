// Measure of a force element: its length or deflection [m], or its angle [rad].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::length>(const SystemMotion& motion, const Output& output,
                                           FollowedOutput&) noexcept {
  return motion.effort(output.element).length;
}

constinit const OutputKind length_output = {
    .about = "length, deflection or angle; not of applied loads",
    .of = OutputOf::force,
    .unit = "m or rad",
    .unit_of = unit_of_force<ElementQuantity::length>,
    .needs = ElementQuantity::length,
    .is_signal = true};

}  // namespace floatframe

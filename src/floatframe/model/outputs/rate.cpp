// Rate of the measure of a force element [m/s or rad/s].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::rate>(const SystemMotion& motion, const Output& output,
                                         FollowedOutput&) noexcept {
  return motion.effort(output.element).rate;
}

constinit const OutputKind rate_output = {
    .about = "rate of the length, deflection or angle; not of applied loads",
    .of = OutputOf::force,
    .unit = "m/s or rad/s",
    .unit_of = unit_of_force<ElementQuantity::rate>,
    .needs = ElementQuantity::rate,
    .is_signal = true};

}  // namespace floatframe

// Power of a prescribed motion, its force times the rate of the coordinate, positive into the
// system [W].
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::motion_power>(const OutputView& view, const Output& output,
                                                 FollowedOutput&) noexcept {
  const Joint& joint = view.model().joints[output.joint];
  return view.reactions().motions[output.joint] * evaluate(*joint.motion, view.time()).df;
}

constinit const OutputKind motion_power_output = {
    .about = "power of the motor, positive into the system",
    .of = OutputOf::motion,
    .unit = "W",
    .terms = OutputTerms::reactions};

}  // namespace floatframe

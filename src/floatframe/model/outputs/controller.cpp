// Value of a controller.
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::controller>(const SystemMotion& motion, const Output& output,
                                               FollowedOutput&) noexcept {
  return motion.effort(output.element).force;
}

constinit const OutputKind controller_output = {
    .about = "its value", .of = OutputOf::controller, .unit = "-", .is_signal = true};

}  // namespace floatframe

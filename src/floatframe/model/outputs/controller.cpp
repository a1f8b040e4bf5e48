// Value of a controller.
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::controller>(const SystemMotion& motion, const Output& output,
                                               FollowedOutput&) noexcept {
  return motion.effort(output.element).result(output.component > 0 ? 2 + output.component : 0);
}

constinit const OutputKind controller_output = {.about = "its value, or one of several",
                                                .of = OutputOf::controller,
                                                .unit = "-",
                                                .is_signal = true,
                                                .one_of_values = true,
                                                .named_unit = true};

}  // namespace floatframe

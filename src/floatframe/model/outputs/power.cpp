// Power of a force element, positive into the bodies it acts on [W]: the sum of F . v + T . w over
// its markers.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::power>(const SystemMotion& motion, const Output& output,
                                          FollowedOutput&) noexcept {
  return motion.power(output.element);
}

constinit const OutputKind power_output = {
    .about = "power of its force, positive into the bodies", .of = OutputOf::force, .unit = "W"};

}  // namespace floatframe

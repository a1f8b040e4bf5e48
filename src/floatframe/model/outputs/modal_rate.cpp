// Rate of the amplitude of a mode of a flexible body.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::modal_rate>(const SystemMotion& motion, const Output& output,
                                               FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < motion.body(output.body).yd.size());
  return motion.body(output.body).yd[output.component];
}

constinit const OutputKind modal_rate_output = {
    .about = "rate of the amplitude of the mode", .of = OutputOf::mode, .unit = "1/s"};

}  // namespace floatframe

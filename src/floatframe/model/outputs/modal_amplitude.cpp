// Amplitude of a mode of a flexible body.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::modal_amplitude>(const SystemMotion& motion,
                                                    const Output& output,
                                                    FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < motion.body(output.body).y.size());
  return motion.body(output.body).y[output.component];
}

constinit const OutputKind modal_amplitude_output = {
    .about = "amplitude of the mode", .of = OutputOf::mode, .unit = "-"};

}  // namespace floatframe

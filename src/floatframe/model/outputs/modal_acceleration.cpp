// Second derivative of the amplitude of a mode of a flexible body.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::modal_acceleration>(const OutputView& view, const Output& output,
                                                       FollowedOutput&) noexcept {
  return view.amplitude_acceleration(output.body, output.component);
}

constinit const OutputKind modal_acceleration_output = {
    .about = "second derivative of the amplitude of the mode",
    .of = OutputOf::mode,
    .unit = "1/s2",
    .terms = OutputTerms::reactions};

}  // namespace floatframe

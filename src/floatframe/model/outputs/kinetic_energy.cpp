// Kinetic energy of a body, including that of its modes [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::kinetic_energy>(const OutputView& view, const Output& output,
                                                   FollowedOutput&) noexcept {
  return view.kinetic_energy(output.body);
}

constinit const OutputKind kinetic_energy_output = {
    .about = "kinetic energy, that of the modes included",
    .of = OutputOf::body,
    .unit = "J",
    .terms = OutputTerms::inertia};

}  // namespace floatframe

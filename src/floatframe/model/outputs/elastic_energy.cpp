// Energy of the deformation of a flexible body, 1/2 y^T K y [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::elastic_energy>(const OutputView& view, const Output& output,
                                                   FollowedOutput&) noexcept {
  return view.elastic_energy(output.body);
}

constinit const OutputKind elastic_energy_output = {
    .about = "energy of the deformation; of a rigid body zero", .of = OutputOf::body, .unit = "J"};

}  // namespace floatframe

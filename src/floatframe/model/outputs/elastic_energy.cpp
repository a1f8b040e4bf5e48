// Energy of the deformation of a flexible body, 1/2 y^T K y [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::elastic_energy>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput&) noexcept {
  return sum_of_bodies(motion, output.body,
                       [](const BodyKinematics& b) { return b.elastic_energy; });
}

constinit const OutputKind elastic_energy_output = {
    .about = "energy of the deformation; of a rigid body zero",
    .of = OutputOf::mass,
    .unit = "J",
    .needs_of_motion = {.energies = true}};

}  // namespace floatframe

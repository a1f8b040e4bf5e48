// Kinetic energy of a body, including that of its modes [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::kinetic_energy>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput&) noexcept {
  return sum_of_bodies(motion, output.body,
                       [](const BodyKinematics& b) { return b.kinetic_energy; });
}

constinit const OutputKind kinetic_energy_output = {
    .about = "kinetic energy, that of the modes included",
    .of = OutputOf::mass,
    .unit = "J",
    .needs_of_motion = {.energies = true}};

}  // namespace floatframe

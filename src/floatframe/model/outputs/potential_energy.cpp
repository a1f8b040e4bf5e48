// Energy of a body in gravity, -g . (m p_WC) with its centre of mass C [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::potential_energy>(const SystemMotion& motion,
                                                     const Output& output,
                                                     FollowedOutput&) noexcept {
  return sum_of_bodies(motion, output.body,
                       [](const BodyKinematics& b) { return b.gravity_energy; });
}

constinit const OutputKind potential_energy_output = {
    .about = "energy in gravity, zero with the centre of mass at the height of the origin",
    .of = OutputOf::mass,
    .unit = "J",
    .needs_of_motion = {.energies = true}};

}  // namespace floatframe

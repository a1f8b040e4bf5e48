// Energy of a body in gravity, -g . (m p_WC) with its centre of mass C [J].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::potential_energy>(const SystemMotion& motion,
                                                     const Output& output,
                                                     FollowedOutput&) noexcept {
  return motion.body(output.body).gravity_energy;
}

constinit const OutputKind potential_energy_output = {
    .about = "energy in gravity, zero with the centre of mass at the height of the origin",
    .of = OutputOf::body,
    .unit = "J",
    .needs_of_motion = {.energies = true}};

}  // namespace floatframe

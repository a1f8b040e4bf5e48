// Centre of mass of a body, deformed, or of all bodies: (sum m p_WC) / (sum m) [m], in the world or
// from the origin of a frame.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::centre_of_mass>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput&) noexcept {
  const MeasurePorts<double> in = measure_ports(motion, output);
  Vec3 place = sum_of_bodies(motion, output.body,
                             [](const BodyKinematics& b) { return Vec3(b.first_moment); });
  place /= mass_of(motion.model, output.body);
  if (in.relative) place -= motion.place(output.relative);
  return in.along(place);
}

constinit const OutputKind centre_of_mass_output = {
    .about = "in the world, or from the origin of `relative_to`",
    .of = OutputOf::mass,
    .components = world_axes,
    .unit = "m",
    .needs_of_motion = {.energies = true},
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::point};

}  // namespace floatframe

// Angular momentum of a body, that of its modes included, or of all bodies [N m s], about the
// origin of the world, or with the momentum p about a point P:
//   L_P = L_W - p_WP x p
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::angular_momentum>(const SystemMotion& motion,
                                                     const Output& output,
                                                     FollowedOutput&) noexcept {
  Vec3 sum = sum_of_bodies(motion, output.body,
                           [](const BodyKinematics& b) { return Vec3(b.angular_momentum); });
  if (output.marker >= 0)
    sum -= motion.place(output.marker)
               .cross(sum_of_bodies(motion, output.body,
                                    [](const BodyKinematics& b) { return Vec3(b.momentum); }));
  return measure_ports(motion, output).along(sum);
}

constinit const OutputKind angular_momentum_output = {
    .about = "about the origin of the world, or the point `about`",
    .of = OutputOf::mass,
    .components = world_axes,
    .unit = "N m s",
    .about_point = true,
    .needs_of_motion = {.energies = true},
    .frames = OutputFrames::in,
    .reflects = Reflects::axial};

}  // namespace floatframe

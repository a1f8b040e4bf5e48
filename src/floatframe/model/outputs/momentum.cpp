// Momentum of a body, that of its modes included, or of all bodies [kg m/s].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::momentum>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput&) noexcept {
  return measure_ports(motion, output)
      .along(sum_of_bodies(motion, output.body,
                           [](const BodyKinematics& b) { return Vec3(b.momentum); }));
}

constinit const OutputKind momentum_output = {.about = "mass times velocity, of the world",
                                              .of = OutputOf::mass,
                                              .components = world_axes,
                                              .unit = "N s",
                                              .needs_of_motion = {.energies = true},
                                              .frames = OutputFrames::in,
                                              .reflects = Reflects::polar};

}  // namespace floatframe

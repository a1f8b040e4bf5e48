// Impulse of the velocity projection onto the constraints on the child of a joint, or on the body
// at `to` of a rod, in the last step [N s]: it is not included in the reactions.
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::projection_impulse>(const SystemMotion& motion,
                                                       const Output& output,
                                                       FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  assert(motion.reactions && (output.element >= 0 || output.joint >= 0));
  const Reactions& all = *motion.reactions;
  const Vec3& impulse =
      output.element >= 0 ? all.element_impulses[output.element] : all.joint_impulses[output.joint];
  if (output.to < 0) return impulse[output.component];
  return motion.marker(output.to).R.col(output.component).dot(impulse);
}

constinit const OutputKind projection_impulse_output = {
    .about =
        "impulse on the child in the projection of the velocities of the last step; of tree "
        "joints in relative coordinates zero",
    .of = OutputOf::reaction,
    .components = world_axes,
    .unit = "N s",
    .needs_of_motion = {.reactions = true},
    .reflects = Reflects::polar};

}  // namespace floatframe

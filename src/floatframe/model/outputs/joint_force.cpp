// Force of a joint on its child, including that of its motion, of a rod or a constraint on the
// body at `to` [N].
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::joint_force>(const SystemMotion& motion, const Output& output,
                                                FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  assert(motion.reactions && (output.element >= 0 || output.joint >= 0));
  const Reactions& all = *motion.reactions;
  const Reactions::Wrench& w =
      output.element >= 0 ? all.elements[output.element] : all.joints[output.joint];
  if (output.to < 0) return w.force[output.component];
  return motion.marker(output.to).R.col(output.component).dot(w.force);
}

constinit const OutputKind joint_force_output = {
    .about = "force on the child, on the body at `to` of a rod or constraint",
    .of = OutputOf::reaction,
    .components = world_axes,
    .unit = "N",
    .needs_of_motion = {.reactions = true},
    .reflects = Reflects::polar};

}  // namespace floatframe

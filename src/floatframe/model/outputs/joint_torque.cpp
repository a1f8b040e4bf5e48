// Torque of a joint on its child, including that of its motion, of a rod or a constraint on the
// body at `to` [N m]. With the force F and the torque T_M about the point M of the joint on the
// child (of a rod or a constraint its end at `to`), the torque about a point P is
//   T_P = T_M + (p_WM - p_WP) x F
#include <cassert>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::joint_torque>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  assert(motion.reactions && (output.element >= 0 || output.joint >= 0));
  const Model& model = motion.model;
  const bool rod = output.element >= 0;
  const Reactions& all = *motion.reactions;
  const Reactions::Wrench& w = rod ? all.elements[output.element] : all.joints[output.joint];
  Vec3 torque = w.torque;
  if (output.marker >= 0) {
    const int own =
        rod ? model.elements[output.element].markers[1] : model.joints[output.joint].frame_M;
    torque += (motion.marker(own).r - motion.marker(output.marker).r).cross(w.force);
  }
  if (output.to < 0) return torque[output.component];
  return motion.marker(output.to).R.col(output.component).dot(torque);
}

constinit const OutputKind joint_torque_output = {
    .about = "torque on the child, on the body at `to` of a rod or constraint",
    .of = OutputOf::reaction,
    .components = world_axes,
    .unit = "N m",
    .about_point = true,
    .needs_of_motion = {.reactions = true},
    .reflects = Reflects::axial};

}  // namespace floatframe

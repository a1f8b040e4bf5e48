// Force [N] or torque [N m] of a prescribed motion along its coordinate, on the child: the load of
// a motor.
#include <cassert>

#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

const char* motion_force_unit(const Model& model, const Output& output) {
  return joint_unit(model.joints[output.joint].type, 0) == JointUnit::rad ? "N m" : "N";
}

}  // namespace

template <>
double output_value_of<OutputType::motion_force>(const SystemMotion& motion, const Output& output,
                                                 FollowedOutput&) noexcept {
  assert(motion.reactions && motion.model.joints[output.joint].motion);
  return motion.reactions->motions[output.joint];
}

constinit const OutputKind motion_force_output = {
    .about = "force or torque along the coordinate that drives it, on the child",
    .of = OutputOf::motion,
    .unit = "N or N m",
    .unit_of = motion_force_unit,
    .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

// Rate of a joint coordinate, measured at its frames F and M, as in H v.
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

const char* joint_velocity_unit(const Model& model, const Output& output) {
  return joint_unit_name(model.joints[output.joint].type, output.component, true);
}

}  // namespace

template <>
double output_value_of<OutputType::joint_velocity>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput&) noexcept {
  const Joint& joint = motion.model.joints[output.joint];
  return joint_velocity(joint, motion.marker(joint.frame_F), motion.marker(joint.frame_M),
                        output.component);
}

constinit const OutputKind joint_velocity_output = {
    .about = "rate of the coordinate; of rotation vectors the angular velocity",
    .of = OutputOf::joint,
    .unit = "m/s or rad/s",
    .unit_of = joint_velocity_unit};

}  // namespace floatframe

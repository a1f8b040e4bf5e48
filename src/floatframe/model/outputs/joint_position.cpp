// Coordinate of a joint, measured at its frames F and M. Turns of angles are counted with the mean
// velocity since the last sample: of the possible angles the value is that nearest to
//   q_last + (t - t_last) (qdot_last + qdot) / 2
// The first one is nearest to `SystemMotion::start_position`.
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

const char* joint_position_unit(const Model& model, const Output& output) {
  return joint_unit_name(model.joints[output.joint].type, output.component);
}

}  // namespace

template <>
double output_value_of<OutputType::joint_position>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput& last) noexcept {
  const Joint& joint = motion.model.joints[output.joint];
  const MarkerState& F = motion.marker(joint.frame_F);
  const MarkerState& M = motion.marker(joint.frame_M);
  const double rate = joint_velocity(joint, F, M, output.component);
  const double expected = last.started
                              ? last.position + 0.5 * (motion.t - last.time) * (last.rate + rate)
                              : motion.start_position(output.joint, output.component);
  last = {true, motion.t, joint_position(joint, F, M, output.component, expected), rate};
  return last.position;
}

constinit const OutputKind joint_position_output = {.about = "coordinate; full turns are counted",
                                                    .of = OutputOf::joint,
                                                    .unit = "m or rad",
                                                    .unit_of = joint_position_unit};

}  // namespace floatframe

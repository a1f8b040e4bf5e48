// Rotation of a body from its design orientation [rad]:
//   R_WB R_WB,design^T = Rz(yaw) Ry(pitch) Rx(roll).
#include <cassert>

#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::rotation>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput&) noexcept {
  assert(output.component >= 0 && output.component < 3);
  const Mat3& design = motion.model.bodies[output.body].X_WB.R;
  return roll_pitch_yaw(motion.body(output.body).R_WB * design.transpose())[output.component];
}

constinit const OutputKind rotation_output = {
    .about = "from the design orientation: R = Rz(yaw) Ry(pitch) Rx(roll)",
    .of = OutputOf::body,
    .components = roll_pitch_yaw_angles,
    .unit = "rad"};

}  // namespace floatframe

// Weld: M is fixed to F.
//   coordinates  none: R_FM = I, p_FM = 0
//   parts        r_M = r_F and three direction rows: z_F.x_M = z_F.y_M = x_F.y_M = 0
//   mirrored, reversed: nothing to change; the frames have world axes in the design configuration
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::weld>(const JointDirections&, const double*,
                                      JointMotion&) noexcept {}

template <>
void joint_bias_of<JointType::weld>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S weld_position(const JointPose<S>&, int) noexcept {
  return 0.0;
}

template <class S>
S weld_velocity(const JointTwist<S>&, int) noexcept {
  return 0.0;
}

}  // namespace

FLOATFRAME_COORDINATES(weld)

namespace {

void weld_parts(JointParts& parts) {
  parts.add(ConstraintType::coincident);
  parts.same_axes();
}

void weld_mirror(JointDescription&, const Placement&) {}

void weld_reverse(JointDirections&, double*, double*) {}

}  // namespace

constinit const JointKind weld_joint = {.about = "does not move",
                                        .coordinates = {},
                                        .parts = weld_parts,
                                        .mirror = weld_mirror,
                                        .reverse = weld_reverse};

}  // namespace floatframe

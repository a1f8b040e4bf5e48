// Planar: M slides in the plane normal to z, the common normal of F and M, and rotates about z. The
// first direction in the plane, e1, is axis_2 without its component along z; e2 = z x e1. Both are
// fixed in F.
//   coordinates  x, y: displacements along e1 and e2 [m]; q: angle from x_F to x_M about z [rad]
//   pose         R_FM = R_z(q), p_FM = x e1 + y e2
//   velocity     v_FM = xdot e1 + ydot e2, w_FM = z qdot: H constant, so the bias is zero
//   parts        z_F.(r_M - r_F) = 0; z_F.x_M = z_F.y_M = 0
//   measured     x = e1.p_FM, y = e2.p_FM, q = atan2(y_F.x_M, x_F.x_M); rates from v_FM, z.w_FM
//   mirrored     an axial axis and a polar axis_2: then e1, e2 are polar, since
//                (det P z) x (P e1) = P (z x e1), and all coordinates keep their values
//   reversed     R_MF = R_z(-q), p_MF = -R_z(-q) p_FM, pdot_MF = -R_z(-q) (pdot_FM - qdot z x p_FM)
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

namespace {

struct PlanarDirections {
  Vec3 z, e1, e2;
  PlanarDirections(const Vec3& normal, const Vec3& axis_2) noexcept
      : z(normal), e1((axis_2 - normal.dot(axis_2) * normal).normalized()), e2(normal.cross(e1)) {
    assert(is_unit(z) && is_unit(e1));
  }
};

}  // namespace

template <>
void joint_motion_of<JointType::planar>(const JointDirections& axes, const double* q,
                                        JointMotion& m) noexcept {
  const PlanarDirections d(axes.axis, axes.axis_2);
  m.p_FM = q[0] * d.e1 + q[1] * d.e2;
  m.R_FM = rotation_about_z(q[2]);
  m.H.block<3, 1>(0, 0) = d.e1;
  m.H.block<3, 1>(0, 1) = d.e2;
  m.H.block<3, 1>(3, 2) = d.z;
}

template <>
void joint_bias_of<JointType::planar>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S planar_position(const JointPose<S>& pose, int component) noexcept {
  if (component == 2) return pose.angle_about_z();
  const PlanarDirections d(Vec3::UnitZ(), pose.axis_2);
  return pose.p_FM.dot(component == 0 ? d.e1 : d.e2);
}

template <class S>
S planar_velocity(const JointTwist<S>& twist, int component) noexcept {
  if (component == 2) return twist.w_FM.z();
  const PlanarDirections d(Vec3::UnitZ(), twist.axis_2);
  return twist.v_FM.dot(component == 0 ? d.e1 : d.e2);
}

}  // namespace

FLOATFRAME_COORDINATES(planar)

namespace {

void planar_parts(JointParts& parts) {
  parts.add(ConstraintType::in_plane);
  parts.parallel_z();
}

void planar_mirror(JointDescription& joint, const Placement& x) {
  joint.axis = x.axial(joint.axis);
  joint.axis_2 = x.polar(joint.axis_2);
}

void planar_reverse(JointDirections&, double* position, double* velocity) {
  const double c = std::cos(position[2]), s = std::sin(position[2]);
  const auto turn_back = [&](double x, double y, double* out) {  // -R_z(-q) (x e1 + y e2)
    out[0] = -(c * x + s * y);
    out[1] = s * x - c * y;
  };
  turn_back(velocity[0] + velocity[2] * position[1], velocity[1] - velocity[2] * position[0],
            velocity);
  turn_back(position[0], position[1], position);
  position[2] = -position[2];
  velocity[2] = -velocity[2];
}

}  // namespace

constinit const JointKind planar_joint = {
    .about =
        "slides in the plane normal to `axis` and turns about `axis`; `axis_2`, fixed in the "
        "parent, is the first direction in the plane (its part along `axis` is left out), "
        "the second is `axis` x the first",
    .coordinates = {{"first displacement", JointUnit::m},
                    {"second displacement", JointUnit::m},
                    {"angle", JointUnit::rad}},
    .axes = JointAxes::two,
    .parts = planar_parts,
    .mirror = planar_mirror,
    .reverse = planar_reverse};

}  // namespace floatframe

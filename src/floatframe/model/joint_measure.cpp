#include "floatframe/model/joint_measure.hpp"

#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"

namespace floatframe {

namespace {

double near(double angle, double reference) noexcept {
  return reference + std::remainder(angle - reference, 2.0 * std::numbers::pi);
}

}  // namespace

double joint_position(const Joint& joint, const MarkerState& F, const MarkerState& M, int component,
                      double reference) noexcept {
  const Mat3 R = F.R.transpose() * M.R;
  const Vec3 p = F.R.transpose() * (M.r - F.r);
  switch (joint.type) {
    case JointType::weld:
      return 0.0;
    case JointType::revolute:
      return near(std::atan2(R(1, 0), R(0, 0)), reference);
    case JointType::prismatic:
      return p.z();
    case JointType::cylindrical:
      return component == 0 ? p.z() : near(std::atan2(R(1, 0), R(0, 0)), reference);
    case JointType::universal: {
      // R = exp(z q1) exp(e2 q2): q1 turns e2 about z onto R e2; q2 is what is left about e2.
      const Vec3 e2 = joint.axis_2, z = Vec3::UnitZ();
      const Vec3 turned = R * e2;
      const double q1 = std::atan2(z.dot(e2.cross(turned)), e2.dot(turned) - e2.z() * turned.z());
      if (component == 0) return near(q1, reference);
      const Mat3 rest = rotation_exp(-q1 * z) * R;
      Vec3 t1, t2;
      orthonormal_complement(e2, t1, t2);
      const Vec3 s = rest * t1;
      return near(std::atan2(s.dot(t2), s.dot(t1)), reference);
    }
    case JointType::spherical:
      return quaternion_log(Eigen::Quaterniond(R))[component];
    case JointType::free:
      return component < 3 ? p[component] : quaternion_log(Eigen::Quaterniond(R))[component - 3];
  }
  return 0.0;
}

double joint_velocity(const Joint& joint, const MarkerState& F, const MarkerState& M,
                      int component) noexcept {
  const Vec3 d = M.r - F.r;
  const Vec3 w = F.R.transpose() * (M.w - F.w);
  const Vec3 v = F.R.transpose() * (M.v - F.v - F.w.cross(d));
  switch (joint.type) {
    case JointType::weld:
      return 0.0;
    case JointType::revolute:
      return w.z();
    case JointType::prismatic:
      return v.z();
    case JointType::cylindrical:
      return component == 0 ? v.z() : w.z();
    case JointType::universal: {
      const Mat3 R = F.R.transpose() * M.R;
      const Vec3 z = Vec3::UnitZ();
      const Vec3 e2 = R * joint.axis_2;  // w = z q1dot + e2 q2dot
      const double c = z.dot(e2);
      const double a = z.dot(w), b = e2.dot(w);
      const double det = 1.0 - c * c;
      return component == 0 ? (a - c * b) / det : (b - c * a) / det;
    }
    case JointType::spherical:
      return w[component];
    case JointType::free:
      return component < 3 ? v[component] : w[component - 3];
  }
  return 0.0;
}

Vec3 roll_pitch_yaw(const Mat3& R) noexcept {
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace floatframe

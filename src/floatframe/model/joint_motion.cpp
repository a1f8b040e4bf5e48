#include "floatframe/model/joint_motion.hpp"

#include <utility>

namespace floatframe {

namespace {

Eigen::Quaterniond read_quaternion(const double* q) noexcept { return {q[0], q[1], q[2], q[3]}; }

void write_quaternion(const Eigen::Quaterniond& r, double* q) noexcept {
  q[0] = r.w();
  q[1] = r.x();
  q[2] = r.y();
  q[3] = r.z();
}

Mat3 rotation_z(double angle) noexcept {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 r;
  r << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return r;
}

}  // namespace

void joint_motion(JointType type, const Vec3& axis_1, const Vec3& axis_2, const double* q,
                  const double* v, JointMotion& m) noexcept {
  m.R_FM.setIdentity();
  m.p_FM.setZero();
  m.H.setZero();
  m.bias.setZero();
  switch (type) {
    case JointType::weld:
      break;
    case JointType::revolute:
      m.R_FM = rotation_z(q[0]);
      m.H(5, 0) = 1.0;
      break;
    case JointType::prismatic:
      m.p_FM.z() = q[0];
      m.H(2, 0) = 1.0;
      break;
    case JointType::cylindrical:
      m.p_FM.z() = q[0];
      m.R_FM = rotation_z(q[1]);
      m.H(2, 0) = 1.0;
      m.H(5, 1) = 1.0;
      break;
    case JointType::universal: {
      const Mat3 r1 = rotation_exp(q[0] * axis_1);
      m.R_FM = r1 * rotation_exp(q[1] * axis_2);
      const Vec3 e2 = r1 * axis_2;
      m.H.block<3, 1>(3, 0) = axis_1;
      m.H.block<3, 1>(3, 1) = e2;
      m.bias.tail<3>() = v[0] * v[1] * axis_1.cross(e2);
      break;
    }
    case JointType::spherical:
      m.R_FM = read_quaternion(q).toRotationMatrix();
      m.H.block<3, 3>(3, 0).setIdentity();
      break;
    case JointType::free:
      m.p_FM = Vec3(q[0], q[1], q[2]);
      m.R_FM = read_quaternion(q + 3).toRotationMatrix();
      m.H.setIdentity();
      break;
  }
}

void joint_retract(JointType type, const double* q0, const double* x, double* q) noexcept {
  const int rotation = quaternion_offset(type);
  const int plain = rotation < 0 ? joint_velocities(type) : rotation;
  for (int i = 0; i < plain; ++i) q[i] = q0[i] + x[i];
  if (rotation >= 0) {
    const Eigen::Quaterniond r =
        quaternion_exp(Vec3(x[rotation], x[rotation + 1], x[rotation + 2])) *
        read_quaternion(q0 + rotation);
    write_quaternion(r.normalized(), q + rotation);
  }
}

void joint_advance(JointType type, double* x, const double* delta) noexcept {
  const int rotation = quaternion_offset(type);
  const int plain = rotation < 0 ? joint_velocities(type) : rotation;
  for (int i = 0; i < plain; ++i) x[i] += delta[i];
  if (rotation >= 0) {
    Eigen::Map<Vec3> theta(x + rotation);
    const Vec3 step(delta[rotation], delta[rotation + 1], delta[rotation + 2]);
    theta = quaternion_log(quaternion_exp(step) * quaternion_exp(theta));
  }
}

void joint_configuration(JointType type, const double* user, double* q) noexcept {
  const int rotation = quaternion_offset(type);
  const int plain = rotation < 0 ? joint_velocities(type) : rotation;
  for (int i = 0; i < plain; ++i) q[i] = user[i];
  if (rotation >= 0)
    write_quaternion(quaternion_exp(Vec3(user[rotation], user[rotation + 1], user[rotation + 2])),
                     q + rotation);
}

void joint_reverse(JointType type, double* position, double* velocity) noexcept {
  if (type == JointType::universal) {
    std::swap(position[0], position[1]);
    std::swap(velocity[0], velocity[1]);
  }
  const int rotation = quaternion_offset(type);
  if (rotation >= 0) {
    Eigen::Map<Vec3> omega(velocity + rotation);
    const Mat3 R_MF = rotation_exp(-Eigen::Map<const Vec3>(position + rotation));
    if (type == JointType::free) {
      Eigen::Map<Vec3> p(position), p_dot(velocity);
      p_dot = (R_MF * (p_dot - omega.cross(p))).eval();
      p = (R_MF * p).eval();
    }
    omega = (R_MF * omega).eval();
  }
  for (int i = 0; i < joint_velocities(type); ++i) {
    position[i] = -position[i];
    velocity[i] = -velocity[i];
  }
}

double joint_coordinate(JointType type, const double* q, int component) noexcept {
  const int rotation = quaternion_offset(type);
  if (rotation < 0 || component < rotation) return q[component];
  return quaternion_log(read_quaternion(q + rotation))[component - rotation];
}

}  // namespace floatframe

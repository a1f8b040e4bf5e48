// Relative motion of the two frames of a joint: motion subspace and bias against finite
// differences, increments, start values, and what is read back from two markers.
#include "floatframe/model/joint_motion.hpp"

#include <gtest/gtest.h>

#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

class JointMotionOf : public ::testing::TestWithParam<JointType> {
 protected:
  JointMotionOf() {
    axis_2_ = random_.vec3().normalized();
    const VecX user = random_.vector(nv_, 0.9);
    q_ = VecX::Zero(joint_configurations(type_));
    joint_configuration(type_, user.data(), q_.data());
    user_ = user;
    v_ = random_.vector(nv_, 2.0);
    a_ = random_.vector(nv_, 3.0);
  }
  JointMotion motion(const VecX& q, const VecX& v) const {
    JointMotion m;
    joint_motion(type_, {Vec3::UnitZ(), axis_2_}, q.data(), m);
    joint_bias(type_, v.data(), m);
    return m;
  }
  VecX moved(const VecX& x) const {
    VecX q = q_;
    joint_retract(type_, q_.data(), x.data(), q.data());
    return q;
  }
  /// Linear and angular velocity of M in F at time h of the motion with accelerations a.
  Vec6 twist(double h) const {
    const VecX v = v_ + h * a_;
    return motion(moved(h * v_ + 0.5 * h * h * a_), v).H.leftCols(nv_) * v;
  }
  const JointType type_ = GetParam();
  const int nv_ = joint_velocities(type_);
  Random random_{static_cast<unsigned>(type_) + 50};
  Vec3 axis_2_;
  VecX q_, v_, a_, user_;
};

TEST_P(JointMotionOf, SubspaceAgainstFiniteDifferences) {
  const double h = 1e-6;
  const JointMotion m = motion(q_, v_), plus = motion(moved(h * v_), v_),
                    minus = motion(moved(-h * v_), v_);
  const Vec6 velocity = m.H.leftCols(nv_) * v_;
  EXPECT_LT((velocity.head<3>() - (plus.p_FM - minus.p_FM) / (2 * h)).norm(), 1e-8);
  const Mat3 Rdot = (plus.R_FM - minus.R_FM) / (2 * h);
  EXPECT_LT(largest(skew(velocity.tail<3>()) * m.R_FM - Rdot), 1e-8);
  EXPECT_LT(largest(m.R_FM * m.R_FM.transpose() - Mat3::Identity()), 1e-14);
}

TEST_P(JointMotionOf, BiasAgainstFiniteDifferences) {
  const double h = 1e-5;
  const JointMotion m = motion(q_, v_);
  const Vec6 exact = m.H.leftCols(nv_) * a_ + m.bias;
  EXPECT_LT((exact - (twist(h) - twist(-h)) / (2 * h)).norm(), 1e-7);
}

TEST_P(JointMotionOf, IncrementsAddUp) {
  VecX x = random_.vector(nv_, 0.8);
  const VecX delta = random_.vector(nv_, 0.5);
  VecX expected = q_;
  const VecX first = moved(x);
  joint_retract(type_, first.data(), delta.data(), expected.data());
  joint_advance(type_, x.data(), delta.data());
  const JointMotion a = motion(moved(x), v_), b = motion(expected, v_);
  EXPECT_LT(largest(a.R_FM - b.R_FM), 1e-14);
  EXPECT_LT((a.p_FM - b.p_FM).norm(), 1e-15);
}

TEST_P(JointMotionOf, CoordinatesAreReadBack) {
  // By markers: F anywhere, M where the joint puts it.
  const JointMotion m = motion(q_, v_);
  const Vec6 twist = m.H.leftCols(nv_) * v_;
  MarkerState F{random_.vec3(), random_.rotation(), random_.vec3(),
                random_.vec3(), Vec3::Zero(),       Vec3::Zero()};
  MarkerState M = F;
  const Vec3 d = F.R * m.p_FM;
  M.r = F.r + d;
  M.R = F.R * m.R_FM;
  M.w = F.w + F.R * twist.tail<3>();
  M.v = F.v + F.w.cross(d) + F.R * twist.head<3>();
  Joint joint;
  joint.type = type_;
  joint.axis_2 = axis_2_;
  for (int k = 0; k < nv_; ++k) {
    EXPECT_NEAR(joint_position(joint, F, M, k, 0.0), user_[k], 1e-13);
    EXPECT_NEAR(joint_velocity(joint, F, M, k), v_[k], 1e-12);
  }
}

// Seen from the child the same motion has the inverse pose and the opposite twist.
TEST_P(JointMotionOf, ReversedJointIsTheInverseMotion) {
  VecX position = user_, velocity = v_;
  JointDirections axes{Vec3::UnitZ(), axis_2_};
  joint_kind(type_).reverse(axes, position.data(), velocity.data());
  VecX q = q_;
  joint_configuration(type_, position.data(), q.data());
  JointMotion r;
  joint_motion(type_, axes, q.data(), r);
  const JointMotion m = motion(q_, v_);
  EXPECT_LT(largest(r.R_FM - m.R_FM.transpose()), 1e-14);
  EXPECT_LT((r.p_FM + m.R_FM.transpose() * m.p_FM).norm(), 1e-14);
  const Vec6 forth = m.H.leftCols(nv_) * v_, back = r.H.leftCols(nv_) * velocity;
  EXPECT_LT((back.tail<3>() + m.R_FM.transpose() * forth.tail<3>()).norm(), 1e-13);
  const Vec3 expected = m.R_FM.transpose() * (forth.tail<3>().cross(m.p_FM) - forth.head<3>());
  EXPECT_LT((back.head<3>() - expected).norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(EveryJoint, JointMotionOf, ::testing::ValuesIn(all_joint_types),
                         [](const auto& c) { return std::string(joint_type_name(c.param)); });

TEST(JointMeasure, AnglesStayNearTheReference) {
  Joint joint;
  joint.type = JointType::revolute;
  MarkerState F{}, M{};
  F.r.setZero();
  M.r.setZero();
  F.R.setIdentity();
  for (const double angle : {-20.0, -3.2, 0.1, 3.1, 6.4, 100.0}) {
    M.R = rotation_exp(std::remainder(angle, 2 * M_PI) * Vec3::UnitZ());
    EXPECT_NEAR(joint_position(joint, F, M, 0, angle + 0.4), angle, 1e-12);
  }
}

TEST(JointMeasure, RollPitchYaw) {
  const Vec3 rpy(0.3, -0.7, 2.1);
  const Mat3 R = rotation_exp(rpy.z() * Vec3::UnitZ()) * rotation_exp(rpy.y() * Vec3::UnitY()) *
                 rotation_exp(rpy.x() * Vec3::UnitX());
  EXPECT_LT((roll_pitch_yaw(R) - rpy).norm(), 1e-14);
}

}  // namespace
}  // namespace floatframe::test

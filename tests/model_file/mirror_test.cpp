// Mirror rules: twice is the identity, two planes are a half turn, handed quantities change as
// vectors of their kind.
#include "floatframe/model_file/mirror.hpp"

#include <gtest/gtest.h>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const Vec3 p(0.3, -1.2, 0.7), a(0.2, 0.5, -0.4);

JointDescription joint(JointType type, std::vector<double> q) {
  JointDescription j;
  j.type = type;
  j.parent.point = j.child.point = p;
  j.axis = a.normalized();
  j.axis_2 = Vec3(1.0, 0.3, 0.1).normalized();
  j.position = j.velocity = std::move(q);
  return j;
}

void expect_equal(const JointDescription& x, const JointDescription& y) {
  EXPECT_LT((x.parent.point - y.parent.point).norm(), 1e-15);
  EXPECT_LT((x.axis - y.axis).norm(), 1e-15);
  EXPECT_LT((x.axis_2 - y.axis_2).norm(), 1e-15);
  ASSERT_EQ(x.position.size(), y.position.size());
  for (std::size_t i = 0; i < x.position.size(); ++i) {
    EXPECT_NEAR(x.position[i], y.position[i], 1e-15);
    EXPECT_NEAR(x.velocity[i], y.velocity[i], 1e-15);
  }
}

/// Every joint of the library's list, with start values.
std::vector<JointDescription> all_joints() {
  std::vector<JointDescription> all;
  for (const JointType type : joint_types) {
    std::vector<double> q;
    for (int k = 0; k < joint_velocities(type); ++k) q.push_back(0.3 + 0.1 * k);
    all.push_back(joint(type, q));
  }
  return all;
}

TEST(Mirror, TwiceIsTheOriginal) {
  const Placement m = reflection(1, 0.35);
  for (const JointDescription& j : all_joints()) {
    JointDescription image = j;
    place(image, m);
    place(image, m);
    expect_equal(image, j);
  }
  const Placement twice = m * m;
  EXPECT_EQ(twice.P, Mat3::Identity());
  EXPECT_EQ(twice.t, Vec3::Zero());
}

TEST(Mirror, OneAfterTheOtherIsTheProduct) {
  const Placement x = reflection(0, -0.0385), y = reflection(1, 0.2);
  for (const JointDescription& j : all_joints()) {
    JointDescription steps = j, once = j;
    place(steps, x);
    place(steps, y);
    place(once, y * x);
    expect_equal(steps, once);
  }
}

/// Two planes are a half turn about their common line: every vector turns, polar or axial.
TEST(Mirror, TwoPlanesAreAHalfTurn) {
  const Placement both = reflection(1, 0.0) * reflection(0, 0.0);
  const Mat3 R = rotation_exp(Vec3(0.0, 0.0, std::acos(-1.0)));
  EXPECT_LT((both.P - R).norm(), 1e-15);
  EXPECT_EQ(both.polar(a), both.axial(a));
  EXPECT_LT((both.point(p) - R * p).norm(), 1e-15);
}

TEST(Mirror, VectorsOfBothKinds) {
  const Placement m = reflection(1, 0.1);  // y -> 0.2 - y
  EXPECT_EQ(m.point(Vec3(1, 2, 3)), Vec3(1, -1.8, 3));
  EXPECT_EQ(m.polar(Vec3(1, 2, 3)), Vec3(1, -2, 3));
  EXPECT_EQ(m.axial(Vec3(1, 2, 3)), Vec3(-1, 2, -3));
}

/// What a joint does in the world: R, p of the child and its twist against the parent.
JointMotion motion_in_world(const JointDescription& j) {
  const Mat3 R_WF = joint_frame(j);
  double q[7] = {};
  joint_configuration(j.type, j.position.data(), q);
  JointMotion m;
  joint_motion(j.type, {Vec3::UnitZ(), R_WF.transpose() * j.axis_2}, q, m);
  m.R_FM = (R_WF * m.R_FM * R_WF.transpose()).eval();
  m.p_FM = (R_WF * m.p_FM).eval();
  Vec6 twist = Vec6::Zero();
  for (int k = 0; k < joint_velocities(j.type); ++k) twist += j.velocity[k] * m.H.col(k);
  m.bias << R_WF * twist.head<3>(), R_WF * twist.tail<3>();
  return m;
}

/// The image of a joint with its start values moves as the mirror image of its motion.
TEST(Mirror, ImageOfEveryJointMeansTheMirroredMotion) {
  for (const Placement& x : {reflection(0, 0.4), reflection(1, 0.0), reflection(2, 0.0),
                             reflection(0, 1.0) * reflection(1, 0.0),
                             reflection(0, 1.0) * reflection(1, 0.0) * reflection(2, -0.3)})
    for (const JointDescription& j : all_joints()) {
      JointDescription image = j;
      place(image, x);
      const JointMotion m = motion_in_world(j), mirrored = motion_in_world(image);
      EXPECT_LT((mirrored.R_FM - x.P * m.R_FM * x.P).norm(), 1e-14) << joint_type_name(j.type);
      EXPECT_LT((mirrored.p_FM - x.polar(m.p_FM)).norm(), 1e-14) << joint_type_name(j.type);
      EXPECT_LT((mirrored.bias.head<3>() - x.polar(m.bias.head<3>())).norm(), 1e-14);
      EXPECT_LT((mirrored.bias.tail<3>() - x.axial(m.bias.tail<3>())).norm(), 1e-14);
    }
}

TEST(Mirror, RigidBody) {
  BodyDescription b;
  b.X_WB = {p, rotation_exp(a)};
  RigidDescription r;
  r.mass = 2.0;
  r.p_BC = Vec3(0.1, 0.2, 0.3);
  r.J_C << 2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0;
  b.kind = r;
  const Placement m = reflection(1, 0.5);
  BodyDescription image = b;
  place(image, m);
  const auto& s = std::get<RigidDescription>(image.kind);
  // Centre of mass and inertia in world axes are the mirror images.
  EXPECT_LT((image.X_WB * s.p_BC - m.point(b.X_WB * r.p_BC)).norm(), 1e-15);
  const Mat3 J = b.X_WB.R * r.J_C * b.X_WB.R.transpose();
  EXPECT_LT((image.X_WB.R * s.J_C * image.X_WB.R.transpose() - m.P * J * m.P).norm(), 1e-14);
  EXPECT_NEAR(image.X_WB.R.determinant(), 1.0, 1e-14);
  EXPECT_EQ(image.mirror, Mat3::Identity());
  place(image, m);
  EXPECT_LT((image.X_WB.p - b.X_WB.p).norm(), 1e-15);
  EXPECT_LT((std::get<RigidDescription>(image.kind).J_C - r.J_C).norm(), 1e-15);
}

TEST(Mirror, FlexibleBodyKeepsItsDescription) {
  BodyDescription b;
  b.X_WB = b.X_WT = {p, rotation_exp(a)};
  FlexibleDescription f;
  f.points["tip"] = Vec3(1, 2, 3);
  b.kind = f;
  const Placement m = reflection(0, -0.0385);
  place(b, m);
  EXPECT_EQ(b.mirror, m.P);
  EXPECT_EQ(b.X_WT.p, p);
  // A point of the template, in template body coordinates, ends at its mirror image.
  const Vec3 in_body = b.X_WT.inverse() * Vec3(1, 2, 3);
  EXPECT_LT((b.X_WB * Vec3(b.mirror * in_body) - m.point(Vec3(1, 2, 3))).norm(), 1e-14);
}

TEST(Mirror, Loads) {
  const Placement m = reflection(2, 0.0);
  AppliedLoad load;
  load.direction = a;
  ElementDescription force{"force", AppliedForce{load}, {}},
      torque{"torque", AppliedTorque{load}, {}};
  place(force, m);
  place(torque, m);
  EXPECT_EQ(std::get<AppliedForce>(force.kind).direction, m.polar(a));
  EXPECT_EQ(std::get<AppliedTorque>(torque.kind).direction, m.axial(a));
}

// A screw becomes one of the other hand; gears stay what they are.
TEST(Mirror, FactorsOfCouplings) {
  const test::TemporaryFolder folder;
  folder.write("drive.yaml", R"(floatframe: 1
bodies:
  nut: {position: [0, 1, 0], rigid: {mass: 1}}
  wheel: {position: [0, 1, 0], rigid: {mass: 1}}
joints:
  nut: {type: cylindrical, child: nut, at: [0, 1, 0], axis: z}
  wheel: {type: revolute, child: wheel, at: [0, 1, 0], axis: z}
couplings:
  screw:
    terms:
      - {joint: nut, coordinate: displacement}
      - {joint: nut, coordinate: angle, factor: 0.002}
      - {joint: wheel, factor: 3}
)");
  const ModelDescription d = read_model(folder.write("model.yaml", R"(floatframe: 1
subsystems:
  left: {file: drive.yaml}
  right: {file: drive.yaml, mirror: [{normal: y}]}
  turned: {file: drive.yaml, mirror: [{normal: x}, {normal: y}]}
)"));
  ASSERT_EQ(d.couplings.size(), 3u);
  for (const ElementDescription& e : d.couplings) {
    const auto& terms = std::get<Coupling>(e.kind).terms;
    ASSERT_EQ(terms.size(), 3u);
    EXPECT_EQ(terms[0].factor, 1.0);
    EXPECT_EQ(terms[1].factor, e.name == "right.screw" ? -0.002 : 0.002) << e.name;
    EXPECT_EQ(terms[2].factor, 3.0);
    EXPECT_EQ(terms[1].coordinate, 1);
  }
  EXPECT_EQ(std::get<Coupling>(d.couplings[1].kind).terms[2].joint, "right.wheel");
}

}  // namespace
}  // namespace floatframe

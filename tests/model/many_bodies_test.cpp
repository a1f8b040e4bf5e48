// Models of very many bodies are checked and built in time in proportion to their size: with work
// of its square this test would take minutes.
#include <gtest/gtest.h>

#include "floatframe/model/topology.hpp"
#include "support/error_of.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

constexpr int n = 20000;

AttachmentDescription place_on(const std::string& body, const Vec3& point) {
  AttachmentDescription a;
  a.body = body;
  a.point = point;
  return a;
}

std::string numbered(const char* word, int k) { return word + std::to_string(k); }

/// Chains of 20, the last body first in the list, each body with a joint, a motor, a spring to the
/// ground, a load and outputs of all three.
ModelDescription many_bodies() {
  ModelDescription d;
  RigidDescription rigid;
  rigid.mass = 1.0;
  rigid.J_C = 0.1 * Mat3::Identity();
  for (int k = n - 1; k >= 0; --k) {
    const Vec3 p(k % 20, k / 20, 0.0);
    BodyDescription b;
    b.name = numbered("b", k);
    b.kind = rigid;
    b.X_WB.p = b.X_WT.p = p;
    d.bodies.push_back(b);
    JointDescription j;
    j.name = numbered("j", k);
    j.type = JointType::revolute;
    j.parent = place_on(k % 20 == 0 ? ground_name : numbered("b", k - 1), p);
    j.child = place_on(b.name, p);
    if (k % 500 != 0) d.joints.push_back(j);  // chains that hang from free joints are left
    JointSpringDescription motor;
    motor.joint = k % 500 == 0 ? numbered("j", k + 1) : j.name;
    motor.spring = PiecewisePolynomial::linear(5.0, 0.0);
    d.forces.push_back({numbered("motor", k), motor, {}});
    SpringDamperDescription spring;
    spring.a = place_on(ground_name, p + Vec3::UnitZ());
    spring.b = place_on(b.name, p);
    spring.spring = PiecewisePolynomial::linear(5.0, 1.0);
    d.forces.push_back({numbered("spring", k), spring, {}});
    OutputDescription o;
    o.name = numbered("z", k);
    o.at = place_on(b.name, p);
    o.component = 2;
    d.outputs.push_back(o);
    o.name = motor.joint;
    o.name[0] = k % 500 == 0 ? 'Q' : 'q';
    o.type = OutputType::joint_position;
    o.entity = motor.joint;
    o.component = 0;
    d.outputs.push_back(o);
    o.name = numbered("F", k);
    o.type = OutputType::force;
    o.entity = numbered("spring", k);
    d.outputs.push_back(o);
  }
  return d;
}

TEST(ManyBodies, AreBuilt) {
  const Model m = build_model(many_bodies());
  EXPECT_EQ(m.bodies.size(), 20000u);
  EXPECT_EQ(m.forces.size(), 40000u);
  EXPECT_EQ(m.outputs.size(), 60000u);
  EXPECT_EQ(m.joints.size(), 20000u);
  int automatic = 0;
  for (const Joint& j : m.joints) automatic += j.automatic ? 1 : 0;
  EXPECT_EQ(automatic, n / 500);
  // Two on the ground for a joint and a spring, one on each body for both, one more on its parent.
  EXPECT_LE(m.markers.size(), 4u * n);
  const Topology t = find_topology(m);
  EXPECT_EQ(t.links.size(), 20000u);
  EXPECT_TRUE(t.cut_joints.empty());
  for (Output o : m.outputs) {
    if (o.type == OutputType::joint_position) {
      EXPECT_EQ(m.joints[o.joint].name, o.name.replace(0, 1, "j"));
    } else if (o.type == OutputType::force) {
      EXPECT_EQ(m.forces[o.force].name, o.name.replace(0, 1, "spring"));
    }
    if (HasFailure()) break;
  }
}

TEST(ManyBodies, AreRefused) {
  ModelDescription d = many_bodies();
  for (JointDescription& j : d.joints) j.child.body += "x";
  try {
    build_model(d);
    ADD_FAILURE();
  } catch (const InputError& error) {
    ASSERT_EQ(error.errors().size(), d.joints.size());
    EXPECT_EQ(test::code_of(error.errors()[0]), "joints.j19999.child: not_found");
    EXPECT_EQ(test::code_of(error.errors().back()), "joints.j1.child: not_found");
  }
}

}  // namespace
}  // namespace floatframe

// Models of very many bodies are checked and built in time in proportion to their size: with work
// of its square this test would take minutes.
#include <gtest/gtest.h>

#include "floatframe/model/topology.hpp"
#include "support/descriptions.hpp"
#include "support/error_of.hpp"
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

constexpr int n = 20000;

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
    const std::string body = numbered("b", k);
    d.bodies.push_back(make_body(body, rigid, p));
    const JointDescription j =
        make_joint(numbered("j", k), JointType::revolute,
                   k % 20 == 0 ? ground_name : numbered("b", k - 1), body, p);
    if (k % 500 != 0) d.joints.push_back(j);  // chains that hang from free joints are left
    JointSpring motor;
    motor.joint = k % 500 == 0 ? numbered("j", k + 1) : j.name;
    motor.spring = PiecewisePolynomial::linear(5.0, 0.0);
    d.forces.push_back({numbered("motor", k), motor, {}});
    SpringDamper spring;
    spring.a = place_on(ground_name, p + Vec3::UnitZ());
    spring.b = place_on(body, p);
    spring.spring = PiecewisePolynomial::linear(5.0, 1.0);
    d.forces.push_back({numbered("spring", k), spring, {}});
    d.outputs.push_back(make_output(numbered("z", k), place_on(body, p), 2));
    std::string angle = motor.joint;
    angle[0] = k % 500 == 0 ? 'Q' : 'q';
    d.outputs.push_back(make_output(angle, OutputType::joint_position, motor.joint));
    d.outputs.push_back(make_output(numbered("F", k), OutputType::force, numbered("spring", k)));
  }
  return d;
}

TEST(ManyBodies, AreBuilt) {
  const Model m = build_model(many_bodies());
  EXPECT_EQ(m.bodies.size(), 20000u);
  EXPECT_EQ(m.elements.size(), 40000u);
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
      EXPECT_EQ(m.elements[o.element].name, o.name.replace(0, 1, "spring"));
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
}  // namespace floatframe::test

// Force elements that follow inputs: a value from outside does the same as that value written as a
// function of time, to the last bit; signs; targets; the stiffness of an actuator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "floatframe/model/force_evaluation.hpp"
#include "floatframe/model/model.hpp"
#include "support/error_of.hpp"

namespace floatframe {
namespace {

using Values = std::vector<double>;

MarkerState at(const Vec3& r, const Vec3& v = Vec3::Zero()) {
  MarkerState s;
  s.r = r;
  s.R = Mat3::Identity();
  s.v = v;
  s.w.setZero();
  s.a_bias.setZero();
  s.alpha_bias.setZero();
  return s;
}

ForceState evaluated(const Force& f, const Values& inputs, const MarkerState& a,
                     const MarkerState& b, double t = 0.3) {
  ForceState s;
  evaluate_force(Model{}, f, a, b, Vec3::Zero(), t, 0.0, s, inputs);
  return s;
}
ForceState evaluated(const Force& f, const Values& inputs) {
  return evaluated(f, inputs, at({0.1, 0.2, -0.3}, {0.5, 0, 0.1}), at({0.4, -0.5, 0.9}, {0, 1, 2}));
}

Force element(ForceType type) {
  Force f;
  f.type = type;
  f.a = 0;
  f.b = 1;
  f.spring = PiecewisePolynomial::linear(300.0, 0.4);
  f.damper = PiecewisePolynomial::linear(7.0, 0.0);
  f.axis = Vec3(1, 2, -1).normalized();
  f.driven = type != ForceType::force && type != ForceType::torque;
  return f;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

class Driven : public ::testing::TestWithParam<ForceType> {};

TEST_P(Driven, ByAnInputAsByAConstant) {
  Force constant = element(GetParam());
  constant.magnitude.pieces = PiecewisePolynomial::polynomial({7.3});
  Force follows = element(GetParam());
  follows.input = 1;
  const ForceState a = evaluated(constant, {}), b = evaluated(follows, {99.0, 7.3});
  EXPECT_TRUE(same_bits(a.force, b.force));
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(same_bits(a.wrench.Fb[k], b.wrench.Fb[k])) << k;
    EXPECT_TRUE(same_bits(a.wrench.Ta[k], b.wrench.Ta[k])) << k;
    EXPECT_TRUE(same_bits(a.wrench.Tb[k], b.wrench.Tb[k])) << k;
  }
  EXPECT_NE(a.force, evaluated(follows, {7.3, 99.0}).force);
}

TEST_P(Driven, FunctionOfTimeAndInputAddUp) {
  Force f = element(GetParam());
  f.magnitude = {PiecewisePolynomial::polynomial({1.0, 2.0}), 0.0, 0.0, 0.0};
  f.input = 0;
  Force sum = element(GetParam());
  sum.magnitude.pieces = PiecewisePolynomial::polynomial({1.6 + 5.0});
  EXPECT_NEAR(evaluated(f, {5.0}).force, evaluated(sum, {}).force, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(AllTypes, Driven,
                         ::testing::Values(ForceType::spring_damper, ForceType::guided_spring,
                                           ForceType::joint_spring, ForceType::force,
                                           ForceType::torque),
                         [](const auto& type) { return std::string(force_type_name(type.param)); });

TEST(Actuator, PullsTheEndsOfASpringTogether) {
  Force f;
  f.driven = true;
  f.input = 0;
  const ForceState s = evaluated(f, {40.0}, at({0, 0, 0}), at({0, 0, 2}));
  EXPECT_EQ(s.force, 40.0);
  EXPECT_EQ(s.wrench.Fa, Vec3(0, 0, 40));
  EXPECT_EQ(s.wrench.Fb, Vec3(0, 0, -40));
}

TEST(Actuator, RaisesTheCoordinateOfAJoint) {
  Force f;
  f.type = ForceType::joint_spring;
  f.driven = true;
  f.input = 0;
  EXPECT_EQ(evaluated(f, {40.0}, at({0, 0, 0}), at({0, 0, 1})).wrench.Fb, Vec3(0, 0, 40));
  f.rotational = true;
  EXPECT_EQ(evaluated(f, {40.0}, at({0, 0, 0}), at({0, 0, 0})).wrench.Tb, Vec3(0, 0, 40));
}

TEST(Actuator, TurnsWithItsLine) {  // the geometric stiffness of its force is in the tangent
  Force f;
  f.driven = true;
  f.input = 0;
  const MarkerState a = at({0, 0, 0}), b = at({0.3, -0.2, 0.7});
  const ForceState s = evaluated(f, {40.0}, a, b);
  for (int k = 0; k < 3; ++k) {
    const Vec3 step = 1e-6 * Vec3::Unit(k);
    const Vec3 change = evaluated(f, {40.0}, a, at(b.r + step)).wrench.Fb -
                        evaluated(f, {40.0}, a, at(b.r - step)).wrench.Fb;
    Vec3 predicted = Vec3::Zero();
    for (int i = 0; i < s.row_count; ++i)
      predicted -= s.rows[i].k * s.rows[i].g.Fb * s.rows[i].g.Fb.dot(2.0 * step);
    EXPECT_LT((change - predicted).norm(), 1e-9 * 40.0);
  }
}

TEST(Target, PullsPositionAndRate) {
  Force f;
  f.type = ForceType::joint_spring;
  f.spring = PiecewisePolynomial::linear(100.0, 0.0);
  f.damper = PiecewisePolynomial::linear(10.0, 0.0);
  f.targeted = true;
  f.target.input = 0;
  f.target_rate.input = 1;
  const MarkerState a = at({0, 0, 0}), b = at({0, 0, 0.5}, {0, 0, 2});
  const ForceState s = evaluated(f, {0.7, 3.0}, a, b);
  EXPECT_NEAR(s.wrench.Fb.z(), 100.0 * 0.2 + 10.0 * 1.0, 1e-12);
  EXPECT_EQ(s.length, 0.5);
  EXPECT_EQ(s.rate, 2.0);
  EXPECT_NEAR(s.energy, 0.5 * 100.0 * 0.2 * 0.2, 1e-12);
  EXPECT_EQ(s.rows[0].k, 100.0);
  EXPECT_EQ(s.rows[0].c, 10.0);
}

TEST(Target, OfTimeBringsItsOwnRate) {
  Force f;
  f.type = ForceType::joint_spring;
  f.damper = PiecewisePolynomial::linear(10.0, 0.0);
  f.targeted = f.derived_rate = true;
  f.target.function.pieces = PiecewisePolynomial::polynomial({0.0, 0.0, 4.0});  // rate 8 t
  EXPECT_NEAR(evaluated(f, {}, at({0, 0, 0}), at({0, 0, 0}), 0.5).wrench.Fb.z(), 40.0, 1e-12);
}

// ------------------------------------------------------------------------------------------------

ModelDescription block_with_load(const std::string& input) {
  ModelDescription d;
  BodyDescription b;
  b.name = "block";
  b.kind = RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()};
  d.bodies.push_back(b);
  AppliedLoadDescription load;
  load.at.body = "block";
  load.magnitude.input = input;
  d.forces.push_back({"push", load, {}});
  return d;
}

std::string errors(const ModelDescription& d) {
  return test::error_of([&] { build_model(d); });
}

TEST(BuildInputs, NamesBecomeIndices) {
  ModelDescription d = block_with_load("b");
  d.inputs.push_back({"a", "", 0.0, {}, {}, false, {}});
  d.inputs.push_back({"b", "N", 2.0, -1.0, 3.0, false, {}});
  const Model model = build_model(d);
  EXPECT_EQ(model.forces[0].input, 1);
  EXPECT_EQ(model.inputs[1].initial, 2.0);
  EXPECT_EQ(model.inputs[1].low, -1.0);
  EXPECT_EQ(model.inputs[1].high, 3.0);
  EXPECT_TRUE(std::isinf(model.inputs[0].low));
}

TEST(BuildInputs, ErrorsAreNamed) {
  ModelDescription d = block_with_load("c");
  d.inputs.push_back({"a", "", 0.0, {}, {}, false, {}});
  d.inputs.push_back({"a", "", 5.0, 0.0, 1.0, false, {}});
  d.inputs.push_back({"b", "", 0.0, 1.0, 1.0, false, {}});
  d.inputs.push_back({"d", "", 0.0, {}, {}, true, {}});
  EXPECT_EQ(errors(d),
            "inputs.a: duplicate\ninputs.a.initial: out_of_range\ninputs.b.max: "
            "contradiction\ninputs.d.clamp: out_of_range\nforces.push.magnitude.input: not_found");
}

}  // namespace
}  // namespace floatframe

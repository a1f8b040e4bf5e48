// Elements that follow inputs: a value from outside does the same as that value written as a
// function of time, to the last bit; signs; targets; the stiffness of an actuator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/model.hpp"
#include "support/element_motion.hpp"
#include "support/error_of.hpp"

namespace floatframe {
namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

SignalDescription number(double value) {
  SignalDescription s;
  s.pieces = PiecewisePolynomial::polynomial({value});
  return s;
}
SignalDescription input(const std::string& name) {
  SignalDescription s;
  s.input = name;
  return s;
}

MarkerState at(const Vec3& r, const Vec3& v = Vec3::Zero()) {
  const Vec3 zero = Vec3::Zero();
  return {r, Mat3::Identity(), v, zero, zero, zero};
}

/// An element in a motion, with the inputs "u0", "u1", ...
template <class Keys>
ElementExample element(Keys keys, std::vector<double> inputs, const MarkerState& a,
                       const MarkerState& b, double t = 0.3) {
  ElementExample x;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    x.model.inputs.emplace_back().name = "u" + std::to_string(k);
  x.inputs = std::move(inputs);
  x.t = t;
  x.keys(std::move(keys));
  x.markers = element_kind(x.element.type).energy == EnergyCategory::loads ? std::vector{b}
                                                                           : std::vector{a, b};
  return x;
}

SignalDescription& driven_by(AppliedLoad& f) { return f.magnitude; }
template <class Keys>
SignalDescription& driven_by(Keys& f) requires requires {
  f.actuator;
}
{ return f.actuator.emplace(); }

/// An element of a type, driven by a signal.
template <class Keys>
class Driven : public ::testing::Test {
 protected:
  static Efforts driven(const SignalDescription& signal, std::vector<double> inputs) {
    Keys keys;
    driven_by(keys) = signal;
    return test::efforts(element(keys, std::move(inputs), at({0.1, 0.2, -0.3}, {0.5, 0, 0.1}),
                                 at({0.4, -0.5, 0.9}, {0, 1, 2})));
  }
};
using Types =
    ::testing::Types<SpringDamper, GuidedSpring, JointSpring, AppliedForce, AppliedTorque>;
TYPED_TEST_SUITE(Driven, Types);

TYPED_TEST(Driven, ByAnInputAsByAConstant) {
  const Efforts a = this->driven(number(7.3), {}), b = this->driven(input("u1"), {99.0, 7.3});
  EXPECT_TRUE(same_bits(a.force, b.force));
  const VecX of_a = test::stacked(a), of_b = test::stacked(b);
  for (Eigen::Index k = 0; k < of_a.size(); ++k) EXPECT_TRUE(same_bits(of_a[k], of_b[k])) << k;
  EXPECT_NE(a.force, this->driven(input("u1"), {7.3, 99.0}).force);
}

TYPED_TEST(Driven, FunctionOfTimeAndInputAddUp) {
  SignalDescription both = input("u0");
  both.pieces = PiecewisePolynomial::polynomial({1.0, 2.0});
  EXPECT_NEAR(this->driven(both, {5.0}).force, this->driven(number(1.6 + 5.0), {}).force, 1e-12);
}

TEST(Actuator, PullsTheEndsOfASpringTogether) {
  SpringDamper f;
  f.actuator = input("u0");
  const Efforts s = test::efforts(element(f, {40.0}, at({0, 0, 0}), at({0, 0, 2})));
  EXPECT_EQ(s.force, 40.0);
  EXPECT_EQ(s.wrench[0].F, Vec3(0, 0, 40));
  EXPECT_EQ(s.wrench[1].F, Vec3(0, 0, -40));
}

TEST(Actuator, RaisesTheCoordinateOfAJoint) {
  JointSpring f;
  f.actuator = input("u0");
  ElementExample x = element(f, {40.0}, at({0, 0, 0}), at({0, 0, 1}));
  EXPECT_EQ(test::efforts(x).wrench[1].F, Vec3(0, 0, 40));
  x.element.rotational = true;
  EXPECT_EQ(test::efforts(x).wrench[1].T, Vec3(0, 0, 40));
}

TEST(Actuator, TurnsWithItsLine) {  // the geometric stiffness of its force is in the tangent
  SpringDamper f;
  f.actuator = input("u0");
  const ElementExample x = element(f, {40.0}, at({0, 0, 0}), at({0.3, -0.2, 0.7}));
  const MatX K = test::tangent_of_rows(test::efforts(x)).K;
  for (int k = 6; k < 9; ++k) {
    const VecX step = 1e-6 * VecX::Unit(12, k);
    const VecX change = test::stacked(test::efforts(test::moved(x, step))) -
                        test::stacked(test::efforts(test::moved(x, -step)));
    EXPECT_LT((change + 2.0 * K * step).norm(), 1e-9 * 40.0);
  }
}

TEST(Target, PullsPositionAndRate) {
  JointSpring f;
  f.spring = PiecewisePolynomial::linear(100.0, 0.0);
  f.damper = PiecewisePolynomial::linear(10.0, 0.0);
  f.target = input("u0");
  f.target_rate = input("u1");
  const Efforts s =
      test::efforts(element(f, {0.7, 3.0}, at({0, 0, 0}), at({0, 0, 0.5}, {0, 0, 2})));
  EXPECT_NEAR(s.wrench[1].F.z(), 100.0 * 0.2 + 10.0 * 1.0, 1e-12);
  EXPECT_EQ(s.length, 0.5);
  EXPECT_EQ(s.rate, 2.0);
  EXPECT_NEAR(s.energy, 0.5 * 100.0 * 0.2 * 0.2, 1e-12);
  EXPECT_EQ(s.rows[0].k, 100.0);
  EXPECT_EQ(s.rows[0].c, 10.0);
}

TEST(Target, OfTimeBringsItsOwnRate) {
  JointSpring f;
  f.damper = PiecewisePolynomial::linear(10.0, 0.0);
  f.target.emplace().pieces = PiecewisePolynomial::polynomial({0.0, 0.0, 4.0});  // rate 8 t
  const ElementExample x = element(f, {}, at({0, 0, 0}), at({0, 0, 0}), 0.5);
  EXPECT_NEAR(test::efforts(x).wrench[1].F.z(), 40.0, 1e-12);
}

// ------------------------------------------------------------------------------------------------

ModelDescription block_with_load(const std::string& input) {
  ModelDescription d;
  BodyDescription b;
  b.name = "block";
  b.kind = RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()};
  d.bodies.push_back(b);
  AppliedForce load;
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
  EXPECT_EQ(model.elements[0].signals[0].input, 1);
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

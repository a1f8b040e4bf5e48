// Exact tangents of elements in K and C: a spring across a swinging arm in closed form, to more
// digits than differences have; at an edge of a law, differences of everything.
#include "floatframe/tangents/element_tangents.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/formulation/relative.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

Model spring_across_an_arm(const std::string& law) {
  return build_model(description_of(
      "gravity: [0, 0, 0]\nbodies:\n  arm: {position: [0, 0, 0], rigid: {mass: 1, inertia: [1, 1, "
      "1]}}\n"
      "joints:\n  pin: {type: revolute, parent: ground, child: arm, at: [0, 0, 0], axis: y}\n"
      "forces:\n  s: {type: spring_damper, from: {body: ground, at: [0, 0, 2]}, "
      "to: {body: arm, at: [1, 0, 0]}, " +
      law + "}\n"));
}

ElementTangents at_start(RelativeFormulation& f, const Model& model) {
  State s;
  f.start(model, 0.0, s.q, s.v);
  return {f, s, VecX::Constant(f.velocities(), 1e-4)};
}

// l^2 = 5 + 4 sin(q) about y: dl/dq = 2 cos(q)/l = b, and the wrench is held at the moved point.
TEST(ElementTangents, OfASpringInClosedForm) {
  const Model model = spring_across_an_arm("spring: {polynomial: [3, 0, 40]}, damper: 7");
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  const ElementTangents t = at_start(f, model);
  const double l = std::sqrt(5.0), b = 2.0 / l, force = 3.0 + 40.0 * l * l, slope = 80.0 * l;
  // The moment of a force that keeps its axes changes by itself: f (d/dq of the arm).n, n = d/l.
  const double whole = slope * b * b - force * b * b / l;  // d(f dl/dq)/dq at q = 0
  const double held = -force / l;                          // n_x f, n = (1, 0, -2)/l
  EXPECT_NEAR(t.K(0, 0), whole - held, 1e-12 * std::abs(whole));
  EXPECT_NEAR(t.C(0, 0), 7.0 * b * b, 1e-13);
}

TEST(ElementTangents, AreLeftToDifferencesAtACorner) {
  for (const double corner : {std::sqrt(5.0), 2.5}) {
    const Model model =
        spring_across_an_arm("spring: {piecewise: [{below: " + std::to_string(corner) +
                             ", polynomial: [0]}, {about: " + std::to_string(corner) +
                             ", polynomial: [0, 9]}]}, damper: 7");
    RelativeFormulation f(model, InertiaMethod::preprocessing);
    EXPECT_EQ(at_start(f, model).C(0, 0) == 0.0, corner < 2.4);
  }
}

}  // namespace
}  // namespace floatframe::test

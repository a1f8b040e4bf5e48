// The contact frame, the limit of friction, sides, carriers and plates of tyres that roll, and
// states at rest.
#include "floatframe/model/rolling_tyre.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "support/element_motion.hpp"

namespace floatframe::test {
namespace {

LinearTyre plain_tyre() {
  LinearTyre f;
  f.radius = 0.3;
  f.stiffness = 2e5;
  f.slip_stiffness = 8e4;
  f.cornering_stiffness = 6e4;
  f.camber_stiffness = 5e3;
  f.relaxation_x = 0.3;
  f.relaxation_y = 0.5;
  f.trail = 0.03;
  f.rolling_resistance = 0.01;
  return f;
}

/// A wheel at the height h above the origin, which rolls along x at v.
ElementExample wheel(const LinearTyre& keys, double h, double v) {
  ElementExample x;
  x.model.roads.push_back({});
  x.keys(keys);
  x.element.data = std::make_shared<const int>(0);  // the linear law has computed nothing
  x.element.road = 0;
  MarkerState b;
  b.r = Vec3(0.0, 0.0, h);
  b.R = Mat3::Identity();
  b.v = Vec3(v, 0.0, 0.0);
  b.w = Vec3(0.0, v / h, 0.0);
  b.a_bias = b.alpha_bias = Vec3::Zero();
  x.markers = {b};
  if (keys.relaxation) x.states = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  return x;
}

double value(const Efforts& e, rolling::Value which) { return e.further[which]; }

TEST(RollingTyre, FrameOfASteeredAndCamberedWheelOnAPlane) {
  const double slope = 0.2, yaw = 0.3, camber = 0.15, depth = 0.01;
  ElementExample x = wheel(plain_tyre(), 0.3, 0.0);
  x.model.roads[0].pieces = PiecewisePolynomial::polynomial({0.1, slope});
  const Mat3 plane = rotation_exp(-std::atan(slope) * Vec3::UnitY());
  const Mat3 wheel_axes =
      plane * rotation_exp(yaw * Vec3::UnitZ()) * rotation_exp(camber * Vec3::UnitX());
  const Vec3 touch(0.7, 0.2, 0.1 + slope * 0.7);
  x.markers[0].R = wheel_axes;
  x.markers[0].r = touch + (0.3 - depth) * wheel_axes.col(2);
  const Efforts e = efforts(x);
  EXPECT_NEAR(value(e, rolling::camber), camber, 1e-14);
  EXPECT_NEAR(value(e, rolling::loaded_radius), 0.3 - depth, 1e-14);
  EXPECT_NEAR(value(e, rolling::deflection), depth, 1e-14);
  EXPECT_NEAR(value(e, rolling::contact_x), touch.x(), 1e-14);
  EXPECT_NEAR(value(e, rolling::contact_y), touch.y(), 1e-14);
  EXPECT_NEAR(value(e, rolling::contact_z), touch.z(), 1e-14);
  EXPECT_NEAR(e.force, 2e5 * depth, 1e-8);
  // The top leans to the right, and so does the camber thrust.
  EXPECT_NEAR(value(e, rolling::lateral_force), -5e3 * camber, 1e-9);
  const Vec3 F =
      e.force * plane.col(2) - 5e3 * camber * (plane * rotation_exp(yaw * Vec3::UnitZ())).col(1);
  EXPECT_LT((e.wrench[0].F - F).norm(), 1e-8);
  EXPECT_LT((e.wrench[0].T - (touch - x.markers[0].r).cross(F)).norm(), 1e-8);
}

TEST(RollingTyre, SignsOfISOW) {
  LinearTyre keys = plain_tyre();
  keys.relaxation = false;
  keys.friction = 5.0;
  ElementExample x = wheel(keys, 0.29, 20.0);
  x.markers[0].v.y() = 1.0;  // alpha > 0
  x.markers[0].w.y() *= 0.98;
  const Efforts e = efforts(x);
  EXPECT_NEAR(value(e, rolling::longitudinal_slip), -0.02, 1e-14);
  EXPECT_NEAR(value(e, rolling::slip_angle), std::atan(0.05), 1e-14);
  EXPECT_NEAR(value(e, rolling::longitudinal_force), 8e4 * -0.02, 1e-9);
  EXPECT_NEAR(value(e, rolling::lateral_force), 6e4 * -0.05 * 1.0, 1e-9);
  EXPECT_NEAR(value(e, rolling::aligning_moment), 0.03 * 3000.0, 1e-9);
  EXPECT_LT(value(e, rolling::rolling_moment), 0.0);
}

TEST(RollingTyre, FrictionLimitsTheForceInTheRoad) {
  LinearTyre keys = plain_tyre();
  keys.relaxation = false;
  keys.friction = 0.8;
  ElementExample x = wheel(keys, 0.29, 20.0);
  x.markers[0].v.y() = 3.0;
  x.markers[0].w.y() *= 0.8;
  const Efforts e = efforts(x);
  EXPECT_NEAR(std::hypot(value(e, rolling::longitudinal_force), value(e, rolling::lateral_force)),
              0.8 * e.force, 1e-9);
  EXPECT_EQ(value(e, rolling::friction_use), 1.0);
  EXPECT_NEAR(value(e, rolling::longitudinal_force) / value(e, rolling::lateral_force),
              8e4 * 0.2 / (6e4 * 0.15), 1e-12);
}

TEST(RollingTyre, ACarriedWheelRollsFreely) {
  LinearTyre keys = plain_tyre();
  keys.spinning = false;
  ElementExample x = wheel(keys, 0.29, 20.0);
  x.markers[0].w = Vec3(0.1, 3.0, 0.2);
  x.states[1] = 0.01;
  const Efforts e = efforts(x);
  EXPECT_NEAR(e.wrench[0].T.y(), 0.0, 1e-12);
  EXPECT_NEAR(value(e, rolling::longitudinal_force), -0.01 * e.force, 1e-3);
  EXPECT_EQ(e.state_rates[0], 0.0);
}

TEST(RollingTyre, APlateLiftsTheRoadUnderIt) {
  LinearTyre keys = plain_tyre();
  keys.lift = SignalDescription();
  keys.lift->pieces = PiecewisePolynomial::polynomial({0.004, 0.3});
  keys.damping = 500.0;
  const Efforts lifted = efforts(wheel(keys, 0.295, 0.0));
  EXPECT_NEAR(lifted.force, 2e5 * 0.009 + 500.0 * 0.3, 1e-8);
  EXPECT_NEAR(value(lifted, rolling::contact_z), 0.004, 1e-14);
}

// Nothing is divided by the speed: at rest states are springs, and their rates the motion.
TEST(RollingTyre, RestsAtNoSpeed) {
  ElementExample x = wheel(plain_tyre(), 0.29, 0.0);
  x.states[0] = 0.003;
  x.states[1] = -0.002;
  const Efforts e = efforts(x);
  EXPECT_NEAR(value(e, rolling::longitudinal_force), 8e4 / 0.3 * 0.003, 1e-9);
  EXPECT_NEAR(value(e, rolling::lateral_force), 6e4 / 0.5 * -0.002, 1e-9);
  EXPECT_EQ(e.state_rates[0], 0.0);
  EXPECT_EQ(e.state_rates[1], 0.0);
  EXPECT_TRUE(exact_tangent(Placed(x).ports()).C.allFinite());
}

// A locked wheel that slides does not wind up: the deflection goes to 1.01 of its limit.
TEST(RollingTyre, ASlideHoldsTheDeflection) {
  ElementExample x = wheel(plain_tyre(), 0.29, 10.0);
  x.markers[0].w.setZero();
  const double limit = 2000.0 * 0.3 / 8e4;
  x.states[0] = -0.5 * limit;
  EXPECT_LT(efforts(x).state_rates[0], -9.0);
  x.states[0] = -(1.0 + rolling::blend) * limit;
  EXPECT_NEAR(efforts(x).state_rates[0], 0.0, 1e-9);
  x.states[0] = -2.0 * limit;
  EXPECT_GT(efforts(x).state_rates[0], 0.0);
}

// At rest a deflection beyond that of the largest force comes back to it, if the force falls there.
TEST(RollingTyre, AtRestNoDeflectionStaysBeyondTheLargestForce) {
  for (const ElementType type : {ElementType::magic_formula_tyre, ElementType::tmeasy_tyre}) {
    ExampleNumbers numbers(9);
    ElementExample x =
        element_example(type, static_cast<std::size_t>(RollingRegime::rolling), numbers);
    x.markers[0].v.setZero();
    x.markers[0].w.setZero();
    const auto at = [&](double u) {
      x.states[0] = u;
      x.states[1] = 0.0;
      return efforts(x);
    };
    // Beyond the limit L the rate is -(u - L)/T.
    const double far = 0.2, u_rate = at(far).state_rates[0];
    const double limit = far + rolling::settle_time * u_rate;
    EXPECT_GT(limit, 1e-3);
    EXPECT_LT(limit, 0.5 * far);
    EXPECT_NEAR(at(1.5 * limit).state_rates[0], -0.5 * limit / rolling::settle_time, 1e-9);
    EXPECT_EQ(at(0.99 * limit).state_rates[0], 0.0);
    EXPECT_NEAR(at(-far).state_rates[0], -u_rate, 1e-9);
    const double most = value(at(limit), rolling::longitudinal_force);
    EXPECT_LT(value(at(2.0 * limit), rolling::longitudinal_force), most);
    EXPECT_LT(value(at(0.5 * limit), rolling::longitudinal_force), most);
  }
}

TEST(RollingTyre, BackwardsIsTheMirrorImage) {
  LinearTyre keys = plain_tyre();
  keys.relaxation = false;
  ElementExample x = wheel(keys, 0.29, 20.0), back = wheel(keys, 0.29, -20.0);
  x.markers[0].v.y() = 1.0;
  back.markers[0].v.y() = 1.0;
  x.markers[0].w.y() *= 0.9;
  back.markers[0].w.y() *= 0.9;
  const Efforts e = efforts(x), b = efforts(back);
  EXPECT_NEAR(value(b, rolling::longitudinal_force), -value(e, rolling::longitudinal_force), 1e-9);
  EXPECT_NEAR(value(b, rolling::lateral_force), value(e, rolling::lateral_force), 1e-9);
  EXPECT_NEAR(value(b, rolling::rolling_moment), -value(e, rolling::rolling_moment), 1e-9);
}

/// The wrench of a wheel that has sunk this far [m] below where it begins to touch; it spins fast
/// and slips. Its damper, which jumps, is left out.
template <class Keys>
WrenchOf<double> just_touching(ElementType type, RollingRegime regime, double depth) {
  ExampleNumbers numbers(7);
  ElementExample x = element_example(type, static_cast<std::size_t>(regime), numbers);
  Keys keys = std::get<Keys>(*x.element.keys);
  keys.damping = 0.0;
  x.keys(keys);
  MarkerState& wheel = x.markers[0];
  wheel.w += 80.0 * (wheel.R * keys.axis);
  x.states[0] = 0.01;
  x.states[1] = -0.02;
  const double middle = wheel.r.z();
  double low = middle - 0.05, high = middle + 0.3;
  for (int k = 0; k < 60; ++k) {
    wheel.r.z() = 0.5 * (low + high);
    (efforts(x).force > 0.0 ? low : high) = wheel.r.z();
  }
  wheel.r.z() = low - depth;
  return efforts(x).wrench[0];
}

template <class Keys>
void expect_gentle_touch(ElementType type) {
  for (const RollingRegime regime :
       {RollingRegime::rolling, RollingRegime::cambered, RollingRegime::other_side}) {
    const auto touch = just_touching<Keys>(type, regime, 1e-9),
               pressed = just_touching<Keys>(type, regime, 0.01);
    EXPECT_LT(touch.F.norm(), 1e-3) << static_cast<int>(regime);
    EXPECT_LT(touch.T.norm(), 1e-3) << static_cast<int>(regime);
    EXPECT_GT(pressed.F.norm(), 1.0) << static_cast<int>(regime);
  }
}

// A tyre that grows by its spin or its camber touches earlier, and no force begins with a jump.
TEST(RollingTyre, NoForceJumpsWhereItTouches) {
  expect_gentle_touch<LinearTyre>(ElementType::linear_tyre);
  expect_gentle_touch<MagicFormulaTyre>(ElementType::magic_formula_tyre);
  expect_gentle_touch<TmeasyTyre>(ElementType::tmeasy_tyre);
  expect_gentle_touch<CalspanTyre>(ElementType::calspan_tyre);
}

// Far in the air nothing touches, whatever the polynomials of a load do there.
TEST(RollingTyre, DoesNotTouchFarInTheAir) {
  for (const ElementType type : {ElementType::linear_tyre, ElementType::magic_formula_tyre,
                                 ElementType::tmeasy_tyre, ElementType::calspan_tyre}) {
    ExampleNumbers numbers(8);
    ElementExample x =
        element_example(type, static_cast<std::size_t>(RollingRegime::cambered), numbers);
    for (const double up : {0.3, 1.0, 10.0, 1e3}) {
      x.markers[0].r.z() += up;
      EXPECT_EQ(efforts(x).force, 0.0) << element_kind(type).about << " " << up;
    }
  }
}

}  // namespace
}  // namespace floatframe::test

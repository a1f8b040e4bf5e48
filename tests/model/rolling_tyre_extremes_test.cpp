// Every law of a rolling tyre on a carrier, without friction, load or speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "support/element_motion.hpp"

namespace floatframe::test {
namespace {

constexpr ElementType rolling_laws[] = {ElementType::linear_tyre, ElementType::magic_formula_tyre,
                                        ElementType::tmeasy_tyre, ElementType::calspan_tyre};

ElementExample example_of(ElementType type, RollingRegime regime, unsigned seed = 11) {
  ExampleNumbers numbers(seed);
  return element_example(type, static_cast<std::size_t>(regime), numbers);
}

/// The keys that all of them share.
RollingTyre& shared_keys(ElementKeys& keys) {
  return std::visit(
      [](auto& k) -> RollingTyre& {
        if constexpr (std::is_base_of_v<RollingTyre, std::decay_t<decltype(k)>>) return k;
        throw std::logic_error("no rolling tyre");
      },
      keys);
}
template <class Change>
void change_keys(ElementExample& x, const Change& change) {
  ElementKeys keys = *x.element.keys;
  change(shared_keys(keys));
  x.element.keys = std::make_shared<const ElementKeys>(keys);
}

void without_friction(ElementExample& x) {
  RoadSurface surface;
  surface.friction = 0.0;
  x.model.roads[0].surface = std::make_shared<const RoadSurface>(surface);
}

/// Their wrench at the wheel centre, by the results: axes of the road from the axis of the wheel.
WrenchOf<double> wrench_of_results(const ElementExample& x, const Efforts& e, const Vec3& axis) {
  const Vec3 n = Vec3::UnitZ(), e_x = axis.cross(n).normalized(), e_y = n.cross(e_x);
  const auto of = [&](rolling::Value which) { return e.further[which]; };
  const Vec3 point(of(rolling::contact_x), of(rolling::contact_y), of(rolling::contact_z));
  const Vec3 F =
      of(rolling::longitudinal_force) * e_x + of(rolling::lateral_force) * e_y + e.force * n;
  const Vec3 M = of(rolling::overturning_moment) * e_x + of(rolling::rolling_moment) * e_y +
                 of(rolling::aligning_moment) * n;
  return {F, (point - x.markers[0].r - x.origin).cross(F) + M};
}

// Results are the wrench that acts, and it has no torque about the axis, also with camber.
TEST(CarriedTyre, ResultsAreTheWrenchWithoutATorqueAboutTheAxis) {
  for (const ElementType type : rolling_laws) {
    ElementExample x = example_of(type, RollingRegime::carried);
    x.markers[0].R = rotation_exp(0.3 * Vec3::UnitZ()) * rotation_exp(0.2 * Vec3::UnitX());
    x.states = {0.002, 0.01, 0.0, 0.0, 0.0, 0.0, 0.0};
    const Vec3 axis = x.markers[0].R.col(1);
    const Efforts e = efforts(x);
    ASSERT_GT(e.force, 0.0);
    EXPECT_GT(std::abs(e.further[rolling::aligning_moment] * axis.z()), 1e-3);
    const WrenchOf<double> w = wrench_of_results(x, e, axis);
    EXPECT_NEAR(e.wrench[0].T.dot(axis), 0.0, 1e-12);
    EXPECT_LT((e.wrench[0].F - w.F).norm(), 1e-10 * w.F.norm());
    EXPECT_LT((e.wrench[0].T - w.T).norm(), 1e-10 * w.F.norm());
  }
}

// Load and radius of a carried wheel are those of one that rolls freely, Omega = V_cx/r_e.
TEST(CarriedTyre, HasTheLoadOfAWheelThatRollsFreely) {
  for (const ElementType type : rolling_laws) {
    ElementExample carried = example_of(type, RollingRegime::carried);
    change_keys(carried, [](RollingTyre& k) { k.damping = 0.0; });
    carried.markers[0].R = Mat3::Identity();
    carried.markers[0].v = Vec3(30.0, 0.0, 0.0);
    carried.markers[0].w.setZero();
    std::fill(carried.states.begin(), carried.states.end(), 0.0);
    const Efforts c = efforts(carried);
    ASSERT_GT(c.force, 0.0);
    ElementExample free = carried;
    change_keys(free, [](RollingTyre& k) { k.spinning = true; });
    free.markers[0].w.y() = 30.0 / c.further[rolling::effective_radius];
    const Efforts f = efforts(free);
    EXPECT_NEAR(c.force, f.force, 1e-9 * f.force);
    EXPECT_NEAR(c.further[rolling::effective_radius], f.further[rolling::effective_radius], 1e-12);
    EXPECT_NEAR(f.state_rates[0], 0.0, 1e-8);
    if (type != ElementType::magic_formula_tyre) continue;
    free.markers[0].w.setZero();
    EXPECT_GT(c.force, 1.02 * efforts(free).force);
  }
}

// Without friction of the road there is no force along it, and `friction_use` is 1 in every law.
TEST(RollingTyre, HasNoForceAlongARoadWithoutFriction) {
  for (const ElementType type : rolling_laws)
    for (const RollingRegime regime : {RollingRegime::slides, RollingRegime::direct}) {
      ElementExample x = example_of(type, regime);
      without_friction(x);
      const Efforts e = efforts(x);
      ASSERT_GT(e.force, 0.0);
      EXPECT_EQ(e.further[rolling::longitudinal_force], 0.0);
      EXPECT_EQ(e.further[rolling::lateral_force], 0.0);
      EXPECT_EQ(e.further[rolling::aligning_moment], 0.0);
      EXPECT_EQ(e.further[rolling::friction_use], 1.0);
    }
}

/// All numbers of an evaluation and of its exact tangents.
void expect_finite(const ElementExample& x, const std::string& what) {
  const Efforts e = efforts(x);
  EXPECT_TRUE(e.wrench[0].F.allFinite() && e.wrench[0].T.allFinite()) << what;
  EXPECT_TRUE(std::isfinite(e.force) && std::isfinite(e.energy)) << what;
  for (const double v : e.further) EXPECT_TRUE(std::isfinite(v)) << what;
  for (const double v : e.state_rates) EXPECT_TRUE(std::isfinite(v)) << what;
  for (const double v : e.state_slopes) EXPECT_TRUE(std::isfinite(v)) << what;
  const auto tangent = exact_tangent(Placed(x).ports());
  EXPECT_TRUE(tangent.K.allFinite() && tangent.C.allFinite()) << what;
}

// With no load, friction, speed or deflection, one by one and together.
TEST(RollingTyre, IsFiniteAtNoLoadFrictionAndSpeed) {
  for (const ElementType type : rolling_laws)
    for (const RollingRegime regime :
         {RollingRegime::cambered, RollingRegime::carried, RollingRegime::direct})
      for (int which = 0; which < 16; ++which) {
        ElementExample x = example_of(type, regime);
        change_keys(x, [](RollingTyre& k) { k.damping = 0.0; });
        MarkerState& wheel = x.markers[0];
        if (which & 1) {
          double low = wheel.r.z() - 0.05, high = wheel.r.z() + 0.3;
          for (int k = 0; k < 60; ++k) {
            wheel.r.z() = 0.5 * (low + high);
            (efforts(x).force > 0.0 ? low : high) = wheel.r.z();
          }
          wheel.r.z() = low;
        }
        if (which & 2) without_friction(x);
        if (which & 4) wheel.v = wheel.w = Vec3::Zero();
        if (which & 8) std::fill(x.states.begin(), x.states.end(), 0.0);
        expect_finite(x, std::string(element_kind(type).about) + " " +
                             std::to_string(static_cast<int>(regime)) + " " +
                             std::to_string(which));
      }
}

// There are no slopes of states of an element that has none.
TEST(RollingTyre, AtRestWithoutStatesItReadsNoSlopesOfStates) {
  const double of_others[] = {std::nan(""), std::nan("")};
  for (const ElementType type : rolling_laws) {
    const ElementExample x = example_of(type, RollingRegime::direct);
    if (x.element.states > 0) continue;
    Efforts out(x.markers.size(), 0, static_cast<std::size_t>(x.element.further()));
    const Placed placed(x);
    Ports ports = placed.ports();
    ports.rest_slopes = of_others;
    evaluate_element(ports, out);
    ASSERT_GT(out.row_count, 1);
    for (int k = 0; k < out.row_count; ++k)
      EXPECT_TRUE(std::isfinite(out.rows[k].k) && std::isfinite(out.rows[k].c)) << k;
  }
}

}  // namespace
}  // namespace floatframe::test

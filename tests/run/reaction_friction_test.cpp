// Friction from the reaction of its joint, of the same iterate: an incline, guides, shoulders,
// screw jacks, a four-bar against another solution, its order, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double gravity_of_loads = 9.81;

double last_of(const RunResult& r, std::size_t column) {
  return r.table.at(r.table.rows() - 1, column);
}

/// 2 kg on a slope with the coefficient 0.5; the slide points downhill.
std::string slope_of(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return R"(
bodies: {block: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints:
  slope: {type: prismatic, child: block, at: [0, 0, 0], axis: [)" +
         std::to_string(c) + ", 0, " + std::to_string(-s) + R"(],
    friction: {breakaway: 0.5, stiffness: 1e5, damping: 200, reaction: true}}
outputs: {x: {joint_position: slope}, f: {force: slope.friction}}
simulation: {step: 1.0e-3, duration: 2, spectral_radius: 0.8}
)";
}

// It slides from atan(0.5) on, with the acceleration g (sin a - 0.5 cos a).
TEST(ReactionFriction, HoldsABlockUpToItsAngle) {
  const double edge = std::atan(0.5);
  for (const Coordinates c : both_coordinates) {
    for (const double part : {0.5, 0.99}) {
      const Model model = model_of(slope_of(part * edge));
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_LT(std::abs(last_of(r, 1)), 2e-5) << part;
      EXPECT_LT(std::abs(last_of(r, 1) - r.table.at(r.table.rows() / 2, 1)), 1e-9) << part;
      EXPECT_NEAR(last_of(r, 2), 2.0 * gravity_of_loads * std::sin(part * edge), 1e-3) << part;
    }
    for (const double part : {1.01, 1.5}) {
      const double a = part * edge;
      const double rate = gravity_of_loads * (std::sin(a) - 0.5 * std::cos(a));
      const Model model = model_of(slope_of(a));
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_NEAR(last_of(r, 1), 2.0 * rate, 2e-3 * 2.0 * rate) << part;
      EXPECT_NEAR(last_of(r, 2), gravity_of_loads * std::cos(a), 1e-5) << part;
    }
  }
}

// A carriage whose weight is 0.3 m ahead of a guide of 0.2 m: its ends carry 1.5 - 0.5 and
// 1.5 + 0.5 weights to both sides, (|w/2 - 1.5 w| + |w/2 + 1.5 w|) = 3 w.
TEST(ReactionFriction, CarriesMomentsOverTheLengthOfAGuide) {
  const Model model = model_of(R"(
bodies: {carriage: {position: [0, 0, 0], rigid: {mass: 2, centre_of_mass: [0.3, 0, 0],
  inertia: [0.1, 0.1, 0.1]}}}
joints: {guide: {type: prismatic, child: carriage, at: [0, 0, 0], axis: x, velocity: 3,
  friction: {breakaway: 0.1, stiffness: 1e4, damping: 10, reaction: true, bearing_length: 0.2,
    preload: 4}}}
outputs: {v: {joint_velocity: guide}, f: {force: guide.friction}}
simulation: {step: 1.0e-3, duration: 0.5, spectral_radius: 0.8}
)");
  const double friction = 0.1 * (3.0 * 2.0 * gravity_of_loads + 4.0);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    EXPECT_NEAR(last_of(r, 2), friction, 1e-6) << name_of(c);
    EXPECT_NEAR(last_of(r, 1), 3.0 - 0.5 * friction / 2.0, 1e-6) << name_of(c);
  }
}

// A disc on its shoulder, with a preload on a radius of its own.
TEST(ReactionFriction, OfAShoulderAndAPreloadAdd) {
  const Model model = model_of(R"(
bodies: {disc: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints: {axle: {type: revolute, child: disc, at: [0, 0, 0], axis: z, velocity: 20,
  friction: {breakaway: 0.2, stiffness: 400, damping: 1, reaction: true, axial_radius: 0.05,
    bearing_radius: 0.02, preload: 20, radius: 0.1}}}
outputs: {w: {joint_velocity: axle}, f: {force: axle.friction}}
simulation: {step: 1.0e-3, duration: 1, spectral_radius: 0.8}
)");
  const double torque = 0.2 * (0.05 * 2.0 * gravity_of_loads + 0.1 * 20.0);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    EXPECT_NEAR(last_of(r, 2), torque, 1e-6) << name_of(c);
    // Natural coordinates turn by a rule of second order in the angle of a step, 0.02 rad.
    EXPECT_NEAR(last_of(r, 1), 20.0 - torque / 0.1, c == Coordinates::relative ? 1e-5 : 2e-3);
  }
}

/// A nut of 50 kg on an upright thread of 10 mm of lead and 20 mm of mean radius: its weight turns
/// it, unless the coefficient is above lead / (2 pi r) = 0.0796.
std::string jack(double coefficient, double inertia) {
  return R"(
bodies: {nut: {position: [0, 0, 0], rigid: {mass: 50, inertia: [0.1, 0.1, )" +
         std::to_string(inertia) + R"(]}}}
joints: {nut: {type: cylindrical, child: nut, at: [0, 0, 0], axis: z,
  friction: {angle: {breakaway: )" +
         std::to_string(coefficient) +
         R"(, stiffness: 1e5, damping: 2, reaction: true, axial_radius: 0.02}}}}
couplings: {thread: {type: screw, joint: nut, lead: 0.01}}
outputs: {x: {joint_position: nut, coordinate: 1}, q: {joint_position: nut, coordinate: 2}}
simulation: {step: 2.0e-4, duration: 0.2, spectral_radius: 0.8}
)";
}

// With p = lead / 2 pi and F = m (g + xddot), x = p q: J qddot = -p F + mu r F.
TEST(ReactionFriction, LocksAScrewJack) {
  const double p = 0.01 / (2.0 * std::numbers::pi), mu = 0.05, arm = 0.02, mass = 50.0;
  for (const Coordinates c : both_coordinates) {
    for (const double inertia : {0.02, 1e-5}) {
      const Model locked = model_of(jack(0.085, inertia));
      const RunResult held = completed_run(locked, with(locked.simulation, c));
      EXPECT_LT(std::abs(last_of(held, 2)), 1e-4) << name_of(c);
      EXPECT_LT(std::abs(last_of(held, 2) - held.table.at(held.table.rows() / 2, 2)), 1e-7);

      const Model loose = model_of(jack(mu, inertia));
      const RunResult r = completed_run(loose, with(loose.simulation, c));
      const double rate =
          -mass * gravity_of_loads * (p - mu * arm) / (inertia + mass * p * (p - mu * arm));
      EXPECT_NEAR(last_of(r, 2), 0.5 * rate * 0.04, 5e-3 * std::abs(0.5 * rate * 0.04));
      // Light nuts feel the friction at once: c = mu r m p / (J + m p^2).
      figure("contraction of the jack, " + name_of(c), r.summary.max_load_contraction);
    }
  }
}

/// Four pins of 30 mm with the coefficient 0.3, in the plane z = 0; `keys` are added to each.
std::string four_bar(double step, const std::string& keys) {
  const std::string friction =
      ", friction: {breakaway: 0.3, stiffness: 6, elastic: 0, reaction: "
      "true, bearing_radius: 0.03" +
      keys + "}}\n";
  return R"(
gravity: [0, -9.81, 0]
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0, 0.1, 0], inertia: [0.01, 0.01, 0.01]}}
  coupler: {rigid: {mass: 2, centre_of_mass: [0.3, 0.35, 0], inertia: [0.1, 0.1, 0.1]}}
  rocker: {rigid: {mass: 1.5, centre_of_mass: [0.6, 0.25, 0], inertia: [0.05, 0.05, 0.05]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: z, velocity: 5)" +
         friction +
         "  b: {type: revolute, parent: crank, child: coupler, at: [0, 0.2, 0], axis: z" +
         friction +
         "  c: {type: revolute, parent: coupler, child: rocker, at: [0.6, 0.5, 0], axis: z" +
         friction + "  d: {type: revolute, child: rocker, at: [0.6, 0, 0], axis: z" + friction +
         R"(outputs: {q: {joint_position: a}, f: {force: d.friction}}
simulation: {step: )" +
         std::to_string(step) + ", duration: 0.9}\n";
}

/// The angle of the crank and the torque of friction in the pin of the rocker. Planar Newton-Euler
/// equations of the three bars with the forces of the pins as unknowns, solved at each instant by a
/// fixed point for their magnitudes (1e-13), with the angle of the crank and the deflections of the
/// four bristles as the only variables, by DOP853 with a tolerance of 1e-12 (scipy). All pins slide
/// at first; the rocker turns back near 0.29 s, the coupler on it near 0.69 s, the crank near
/// 0.72 s.
struct FourBarInstant {
  double t, angle, torque;
};
constexpr FourBarInstant four_bar_reference[] = {
    {0.1, 0.509406983129, 0.16499459},  {0.2, 1.215312480645, 0.07933601},
    {0.3, 2.564880944629, 0.10696808},  {0.4, 3.741515898679, -0.12037494},
    {0.5, 4.287918350414, -0.22841479}, {0.6, 4.613950035214, -0.30063239},
    {0.7, 4.768177392734, -0.31260329}, {0.8, 4.693374737086, 0.02023672},
    {0.9, 4.458177633843, 0.25208109}};

std::size_t row_at(const RunResult& r, double t) {
  const double step = r.table.at(1, 0) - r.table.at(0, 0);
  return static_cast<std::size_t>(std::lround(t / step));
}

/// Largest error of the angle.
double error_of_four_bar(const RunResult& r) {
  double error = 0.0;
  for (const FourBarInstant& x : four_bar_reference)
    error = std::max(error, std::abs(r.table.at(row_at(r, x.t), 1) - x.angle));
  return error;
}

TEST(ReactionFriction, InAFourBarAgreesWithAnotherSolution) {
  const Model model = model_of(four_bar(2.5e-4, ""));
  double ends[2];
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c));
    const double error = error_of_four_bar(r);
    figure("error of the four-bar [rad], " + name_of(c), error);
    figure("contraction of the four-bar, " + name_of(c), r.summary.max_load_contraction);
    EXPECT_LT(error, 1e-4);
    EXPECT_LT(r.summary.max_load_contraction, 0.3);
    for (const FourBarInstant& x : four_bar_reference)
      EXPECT_NEAR(std::abs(r.table.at(row_at(r, x.t), 2)), std::abs(x.torque), 3e-4) << x.t;
    ends[c == Coordinates::relative] = last_of(r, 1);
  }
  EXPECT_NEAR(ends[0], ends[1], 1e-5);  // of second order: errors of the steps
}

TEST(ReactionFriction, IsOfSecondOrder) {
  for (const Coordinates c : both_coordinates)
    for (const double radius : {1.0, 0.8}) {
      double errors[3];
      for (int k = 0; k < 3; ++k) {
        const Model model = model_of(four_bar(2e-3 / (1 << k), ""));
        SimulationDescription s = with(model.simulation, c);
        s.spectral_radius = radius;
        errors[k] = error_of_four_bar(completed_run(model, s));
      }
      figure("ratios of errors, " + name_of(c), errors[0] / errors[1]);
      figure("ratios of errors, " + name_of(c), errors[1] / errors[2]);
      EXPECT_GT(errors[1] / errors[2], 3.2) << name_of(c) << radius;
      EXPECT_LT(errors[1] / errors[2], 5.0) << name_of(c) << radius;
    }
}

// The pins of planar loops have unique forces across their axes, and no unique moments.
TEST(ReactionFriction, RefusesWhatIsNotUnique) {
  for (const Coordinates c : both_coordinates) {
    const auto message = [&](const std::string& keys) {
      const Model model = model_of(four_bar(1e-3, keys));
      return message_of<RunError>([&] { run(model, with(model.simulation, c)); });
    };
    const std::string moments = message(", bearing_length: 0.05");
    EXPECT_TRUE(contains(moments, "joint 'a', whose moment across the axis is not unique"))
        << moments;
    EXPECT_TRUE(contains(moments, "'normal'")) << moments;
    const std::string shoulder = message(", axial_radius: 0.05");
    EXPECT_TRUE(contains(shoulder, "joint 'a', whose force along the axis is not unique"))
        << shoulder;
    EXPECT_THROW(statics(model_of(four_bar(1e-3, ", axial_radius: 0.05"))), RunError);
    EXPECT_THROW(check(model_of(four_bar(1e-3, ", axial_radius: 0.05"))), RunError);
  }
}

TEST(ReactionFriction, IsResumedToTheBitAndAllocatesNothing) {
  const Model model = model_of(four_bar(1e-3, ""));
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    for (int k = 0; k < 20; ++k) ASSERT_TRUE(s.step()) << s.failure();
    const SimulationState saved = s.save();
    if (allocations_counted()) {
      const AllocationScope scope;
      for (int k = 0; k < 40; ++k) ASSERT_TRUE(s.step());
      EXPECT_EQ(scope.count(), 0u) << name_of(c);
    } else {
      for (int k = 0; k < 40; ++k) ASSERT_TRUE(s.step());
    }
    const double q = s.output("q"), f = s.output("f");
    Simulation again(model, {.coordinates = c});
    again.restore(saved);
    for (int k = 0; k < 40; ++k) ASSERT_TRUE(again.step());
    EXPECT_EQ(again.output("q"), q) << name_of(c);
    EXPECT_EQ(again.output("f"), f) << name_of(c);
  }
}

}  // namespace
}  // namespace floatframe::test

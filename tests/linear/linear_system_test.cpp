// Linear systems against closed forms, at rest and turning, and in both formulations the same.
#include "floatframe/linear/linear_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "support/coordinates.hpp"
#include "support/linear_models.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::vector<LinearMode> modes_of(const Model& model, const SimulationOptions& options = {}) {
  return linear_modes(linear_system(model, options));
}

TEST(LinearSystem, DampedOscillator) {
  const Model model = model_of(oscillator);
  for (const Coordinates c : both_coordinates) {
    const LinearSystem s = linear_system(model, {.coordinates = c});
    ASSERT_EQ(s.degrees, 1);
    EXPECT_EQ(s.massless, 0);
    const auto modes = linear_modes(s);
    ASSERT_EQ(modes.size(), 1u);
    const double w = std::sqrt(40.0 / 3.0), zeta = 7.0 / (2.0 * std::sqrt(40.0 * 3.0));
    EXPECT_NEAR(modes[0].frequency(), w / (2.0 * std::numbers::pi), 1e-10);
    EXPECT_NEAR(modes[0].damping(), zeta, 1e-10);
    EXPECT_NEAR(modes[0].damped(), w * std::sqrt(1.0 - zeta * zeta) / (2.0 * std::numbers::pi),
                1e-10);
  }
}

// A heavy symmetric top that sleeps upright: in the world's axes lambda = i w with
// J w^2 - H w + m g l = 0, H the spin times the polar inertia, J about the tip.
TEST(LinearSystem, SleepingTop) {
  const double m = 0.5, l = 0.04, across = 8e-4, polar = 3e-4, spin = 250.0;
  const Model model = model_of(R"(
bodies: {top: {position: [0, 0, 0.04], rigid: {mass: 0.5, inertia: [8e-4, 8e-4, 3e-4]}}}
joints: {tip: {type: spherical, child: top, at: [0, 0, 0], velocity: [0, 0, 250]}}
simulation: {step: 0.001, duration: 1}
)");
  const double J = across + m * l * l, H = polar * spin, g = m * 9.81 * l;
  const double root = std::sqrt(H * H - 4.0 * J * g);
  const double fast = (H + root) / (2.0 * J), slow = (H - root) / (2.0 * J);
  const LinearSystem s = linear_system(model, {.coordinates = Coordinates::relative});
  ASSERT_EQ(s.degrees, 3);
  const auto modes = linear_modes(s);
  const auto near = [&](double w) {
    double best = 1e300;
    for (const LinearMode& mode : modes)
      best = std::min({best, std::abs(mode.lambda - std::complex<double>(0.0, w))});
    return best;
  };
  EXPECT_LT(near(slow), 1e-7 * spin);
  EXPECT_LT(near(fast), 1e-7 * spin);
}

// Two point masses on an arm that turns at a constant rate: the outer one slides along the arm on a
// spring, w^2 = k / m - W^2, with the Coriolis force taken by the drive.
TEST(LinearSystem, SpringOnATurningArm) {
  const Model model = arm_and_bead("[1, 1, 1]", "motion: {polynomial: [0, 12]}");
  const LinearSystem s = linear_system(model, {.coordinates = Coordinates::relative});
  ASSERT_EQ(s.degrees, 1);
  const auto modes = linear_modes(s);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(std::abs(modes[0].lambda), std::sqrt(90.0 / 0.2 - 144.0), 1e-7);
  EXPECT_NEAR(modes[0].lambda.real(), 0.0, 1e-7);
  EXPECT_THROW(linear_system(model, {.coordinates = Coordinates::absolute}), RunError);
}

// A governor: a bob on a driven hub, steady at cos(angle) = g / (L W^2), swings at W sin(angle). No
// force has a corner, and no note says so.
TEST(LinearSystem, GovernorHasNoCorners) {
  const Model model = model_of(R"(
bodies:
  hub: {rigid: {mass: 2, centre_of_mass: [0, 0, 1], inertia: [0.01, 0.01, 0.02]}}
  bob: {rigid: {mass: 0.7, centre_of_mass: [0, 0, 0.6]}}
joints:
  spin: {type: revolute, child: hub, at: [0, 0, 1], axis: z, motion: {polynomial: [0, 9]}}
  p: {type: revolute, parent: hub, child: bob, at: [0, 0, 1], axis: y,
      position: "${-acos(9.81/(0.4*81))}"}
simulation: {step: 0.001, duration: 1}
)");
  const LinearSystem system = linear_system(model);
  EXPECT_TRUE(system.notes.empty()) << system.notes.front();
  const double c = 9.81 / (0.4 * 81.0);
  EXPECT_NEAR(2.0 * std::numbers::pi * linear_modes(system).back().frequency(),
              9.0 * std::sqrt(1.0 - c * c), 1e-6);
}

// The same without the drive: the arm's angle follows its momentum. With L the momentum and the
// bead at rho in steady turning W, small radial motions have w^2 = k/m - W^2 + 4 W^2 m rho^2 / I.
TEST(LinearSystem, FreelyTurningArm) {
  const Model model = arm_and_bead("[1, 1, 0.1]", "velocity: 12");
  const auto modes = modes_of(model, {.coordinates = Coordinates::relative});
  const double I = 0.1 + 0.2 * 0.25, W2 = 144.0;
  const double w = std::sqrt(90.0 / 0.2 - W2 + 4.0 * W2 * 0.2 * 0.25 / I);
  ASSERT_EQ(modes.size(), 3u);  // two of zero: angle and its rate
  EXPECT_NEAR(std::abs(modes[2].lambda), w, 1e-6 * w);
  EXPECT_LT(std::abs(modes[1].lambda), 1e-3 * w);
}

TEST(LinearSystem, BothFormulationsHaveTheSameEigenvalues) {
  const Model model = model_of(flexible_loop);
  const auto relative = modes_of(model, {.coordinates = Coordinates::relative});
  const auto absolute = modes_of(model, {.coordinates = Coordinates::absolute});
  ASSERT_EQ(relative.size(), absolute.size());
  const double largest = std::abs(relative.back().lambda);
  double worst = 0.0;
  for (std::size_t k = 0; k < relative.size(); ++k)
    worst = std::max(worst, std::abs(relative[k].lambda - absolute[k].lambda));
  std::printf("[ figure ] eigenvalues_of_both_formulations %.1e of the largest\n", worst / largest);
  EXPECT_LT(worst, 1e-8 * largest);
}

// A slider without mass between two springs and dampers: of first order where damped, static where
// not.
TEST(LinearSystem, MasslessDirections) {
  const auto text = [](const char* damper) {
    return std::string(R"(
gravity: [0, 0, 0]
bodies:
  seat: {position: [0, 0, 0], rigid: {mass: 0}}
  box: {position: [1, 0, 0], rigid: {mass: 2}}
joints:
  a: {type: prismatic, child: seat, at: [0, 0, 0], axis: x}
  b: {type: prismatic, parent: seat, child: box, at: [1, 0, 0], axis: x}
forces:
  one: {type: joint_spring, joint: a, spring: 30)") +
           damper + R"(}
  two: {type: joint_spring, joint: b, spring: 60}
simulation: {step: 0.001, duration: 1}
)";
  };
  const Model undamped = model_of(text(""));
  const LinearSystem s = linear_system(undamped);
  EXPECT_EQ(s.massless, 1);
  const auto modes = linear_modes(s);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(std::abs(modes[0].lambda), std::sqrt(20.0 / 2.0), 1e-8);
  // With the damper: 2 x'' = 60 (u - x), 5 u' = 60 (x - u) - 30 u.
  const Model damped = model_of(text(", damper: 5"));
  const LinearSystem d = linear_system(damped);
  ASSERT_EQ(d.A.rows(), 3);
  MatX A(3, 3);
  A << 0, 1, 0, -30, 0, 30, 12, 0, -18;
  const GeneralEigen expected = general_eigen(A), found = general_eigen(d.A);
  for (int k = 0; k < 3; ++k) {
    double best = 1e300;
    for (int i = 0; i < 3; ++i)
      best = std::min(best, std::abs(found.values[i] - expected.values[k]));
    EXPECT_LT(best, 1e-7);
  }
}

}  // namespace
}  // namespace floatframe::test

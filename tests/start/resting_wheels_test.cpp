// Equilibria of vehicles that stand on tyres with states: a few iterations, to round-off. A wheel
// on a carrier that only slides, in closed form; the Iltis. Its linear system at rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/iltis.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double mass = 320.0, earth_gravity = 9.81, k_x = 5e4 / 0.5, k_y = 6e4 / 0.4,
                 camber_stiffness = 2000.0, trail = 0.03, rest_damping = 900.0, spin_inertia = 2.0;

struct WheelCase {
  double camber = 0.0;               ///< the top of the wheel to the right [rad]
  double along = 0.0, across = 0.0;  ///< parts of the gravity in the road
  double spring = 0.0;  ///< of the wheel against its carrier [N m/rad]; 0: it turns freely
  double height = 0.3;  ///< of the hub at the start [m]
};

/// 300 kg that slide in all directions, on a wheel of 20 kg, 2 kg m2 about any axis.
std::string wheel_on_sledge(const WheelCase& x, const std::string& tyre) {
  return fmt::format(
      R"(
gravity: [{:.17g}, {:.17g}, -9.81]
points: {{hub: [0, 0, {}]}}
bodies:
  along: {{rigid: {{mass: 0, centre_of_mass: hub}}}}
  across: {{rigid: {{mass: 0, centre_of_mass: hub}}}}
  sledge: {{rigid: {{mass: 300, centre_of_mass: hub, inertia: [10, 10, 10]}}}}
  wheel: {{rigid: {{mass: 20, centre_of_mass: hub, inertia: [2, 2, 2]}}}}
joints:
  x: {{type: prismatic, child: along, at: hub, axis: x}}
  y: {{type: prismatic, parent: along, child: across, at: hub, axis: y}}
  z: {{type: prismatic, parent: across, child: sledge, at: hub, axis: z}}
  spin: {{type: revolute, parent: sledge, child: wheel, at: hub, axis: [0, {:.17g}, {:.17g}]}}
forces:
  tyre: {{body: wheel, at: hub, axis: [0, {:.17g}, {:.17g}], road: flat, {}}}
{}roads: {{flat: {{profile: [[-1, 0], [1, 0]]}}}}
outputs:
  Fx: {{force: tyre, output: longitudinal_force}}
  Fy: {{force: tyre, output: lateral_force}}
  x: {{joint_position: x}}
  y: {{joint_position: y}}
  turn: {{joint_position: spin}}
  a: {{acceleration: sledge}}
simulation: {{start: equilibrium, step: 1.0e-3, duration: 1.0e-3}}
)",
      x.along, x.across, x.height, std::cos(x.camber), std::sin(x.camber), std::cos(x.camber),
      std::sin(x.camber), tyre,
      x.spring > 0.0
          ? fmt::format("  brake: {{type: joint_spring, joint: spin, spring: {}}}\n", x.spring)
          : std::string());
}

const std::string linear = fmt::format(
    "type: linear_tyre, radius: 0.31, stiffness: 2.0e+5, slip_stiffness: 5.0e+4, "
    "cornering_stiffness: 6.0e+4, camber_stiffness: {}, trail: {}, friction: 1, relaxation_x: 0.5, "
    "relaxation_y: 0.4, rest_damping: {}",
    camber_stiffness, trail, rest_damping);
const std::string magic_formula =
    "type: magic_formula_tyre, file: " FLOATFRAME_EXAMPLES "/iltis/tyre.tir";

const std::string tmeasy =
    "type: tmeasy_tyre, radius: 0.376, nominal_load: 1900, stiffness: [1.0e+5, 1.1e+5], "
    "longitudinal: [[34911, 2145.5, 0.139, 1522.8, 0.667], [73974, 4140.6, 0.139, 2922.8, 0.667]], "
    "lateral: [[30367, 1901.7, 0.149, 1583.8, 0.965], [48834, 3472.0, 0.185, 2938.8, 1.071]], "
    "trail: [[0.178, 0.163, 0.965], [0.190, 0.204, 1.071]], "
    "longitudinal_stiffness: 1.2e+5, lateral_stiffness: 8.0e+4";

void expect_quick(const StaticsResult& s, const std::string& what) {
  EXPECT_LE(s.iterations, 15) << what;
  EXPECT_LT(s.residual, 1e-6) << what;
}

/// The start of a run: the outputs at t = 0, in their order from 1 on.
std::vector<double> outputs_at_start(const Model& model, Coordinates c) {
  const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 1e-3));
  std::vector<double> out;
  for (std::size_t i = 0; i < r.table.columns.size(); ++i) out.push_back(r.table.at(0, i));
  return out;
}

// The side force by slip is C_g camber, and what its moment has about the axis, trail C_g camber
// sin(camber) = T, rolls a free wheel on with a = r T/(m r^2 + J): no place is an equilibrium. All
// else is balanced, and a note tells the force m a.
TEST(RestingWheels, FreeWheelsWithCamberRollOn) {
  for (const double camber : {0.02, -0.06}) {
    const Model model = model_of(wheel_on_sledge({.camber = camber}, linear));
    const StaticsResult s = statics(model);
    expect_quick(s, "free");
    const double r = 0.31 - mass * earth_gravity / 2e5,
                 T = trail * camber_stiffness * camber * std::sin(camber),
                 a = r * T / (mass * r * r + spin_inertia);
    ASSERT_EQ(s.notes.size(), 1U);
    EXPECT_TRUE(contains(s.notes, fmt::format("leaves out {:.3g} N", mass * a)));
    for (const Coordinates c : both_coordinates) {
      const std::vector<double> start = outputs_at_start(model, c);
      EXPECT_NEAR(std::abs(start[6]), a, 1e-6 * a);
      EXPECT_NEAR(start[7], 0.0, 1e-8);
      EXPECT_NEAR(start[8], 0.0, 1e-8);
    }
  }
}

TEST(RestingWheels, OfEveryLawTakeFewIterations) {
  for (const std::string& tyre : {linear, magic_formula, tmeasy})
    for (const double camber : {0.0, 0.03})
      for (const double spring : {0.0, 4e4}) {
        const bool free = spring == 0.0 && camber != 0.0;
        const StaticsResult s = statics(
            model_of(wheel_on_sledge({.camber = camber, .spring = spring, .height = 0.35}, tyre)));
        expect_quick(s, tyre);
        EXPECT_TRUE(free || s.notes.empty()) << joined(s.notes);
      }
}

// On a flat road F_x = 0 = F_y: the side force by slip is C_g camber, and its trail turns the wheel
// against the spring.
TEST(RestingWheels, HeldWheelsFeelTheAligningMoment) {
  const double camber = 0.06, spring = 50.0;
  const StaticsResult s =
      statics(model_of(wheel_on_sledge({.camber = camber, .spring = spring}, linear)));
  expect_quick(s, "held");
  EXPECT_TRUE(s.notes.empty());
  EXPECT_NEAR(std::abs(force_of(s, "brake").force),
              trail * camber_stiffness * camber * std::sin(camber), 1e-8);
}

// A slope along and across it: F = -m g, the tyre gives way by F/k, and the wheel turns against
// the spring by F r_l over its stiffness.
TEST(RestingWheels, HoldASlopeByTheirDeflections) {
  const WheelCase slope{.along = -1.4, .across = 0.9, .spring = 4e4};
  const Model model = model_of(wheel_on_sledge(slope, linear));
  expect_quick(statics(model), "slope");
  const double F_x = -mass * slope.along, F_y = -mass * slope.across,
               r_l = 0.31 - mass * earth_gravity / 2e5;
  for (const Coordinates c : both_coordinates) {
    const std::vector<double> start = outputs_at_start(model, c);
    const double turn = -F_x * r_l / slope.spring;
    EXPECT_NEAR(start[1], F_x, 1e-6);
    EXPECT_NEAR(start[2], F_y, 1e-6);
    EXPECT_NEAR(start[5], turn, 1e-9);
    EXPECT_NEAR(start[3], -F_x / k_x + r_l * turn, 1e-9);
    EXPECT_NEAR(start[4], -F_y / k_y, 1e-9);
  }
  // Nothing holds it: no equilibrium.
  EXPECT_EQ(error_of([&] { statics(model_of(wheel_on_sledge({.along = -1.4}, linear))); }),
            "no_equilibrium");
}

// A free wheel rocks against its tyre, s^2 + b s rest_damping + b k_x = 0, b = 1/m + r_l^2/J; and
// across, s^2 + s rest_damping/m + k_y/m = 0. Along, nothing holds it.
TEST(RestingWheels, RockOnTheirTyres) {
  const Model model = model_of(wheel_on_sledge({}, linear));
  const LinearSystem system = linear_system(model);
  EXPECT_TRUE(system.notes.empty());
  const double r_l = 0.31 - mass * earth_gravity / 2e5, b = 1.0 / mass + r_l * r_l / spin_inertia;
  const auto expect = [&](double damping, double stiffness) {
    const std::complex<double> s =
        -0.5 * damping + std::sqrt(std::complex<double>(0.25 * damping * damping - stiffness));
    double miss = INFINITY;
    for (const LinearMode& m : linear_modes(system))
      miss = std::min(miss, std::abs(m.lambda - s) / std::abs(s));
    EXPECT_LT(miss, 1e-7) << s;
  };
  expect(b * rest_damping, b * k_x);
  expect(rest_damping / mass, k_y / mass);
}

StaticsResult standing_iltis(const std::string& law) {
  return statics(build_model(
      read_model(FLOATFRAME_EXAMPLES "/iltis/handling.yaml", {{"tyre_law", law}, {"speed", "0"}})));
}

TEST(RestingWheels, OfTheIltisTakeFewIterations) {
  for (const char* law : {"mf", "calspan"}) {
    const StaticsResult s = standing_iltis(law);
    figure(std::string(law) + "_iterations", s.iterations);
    figure(std::string(law) + "_residual", s.residual);
    expect_quick(s, law);
  }
}

// The round-off of forces that nothing but it changes is no corner.
TEST(RestingWheels, OfTheIltisHaveOneSlope) {
  for (const char* law : {"mf", "calspan"})
    for (const char* speed : {"0", "20"}) {
      const LinearSystem system = linear_system(build_model(read_model(
          FLOATFRAME_EXAMPLES "/iltis/handling.yaml", {{"tyre_law", law}, {"speed", speed}})));
      for (const std::string& note : system.notes)
        EXPECT_FALSE(contains(note, "no one slope")) << note;
    }
}

}  // namespace
}  // namespace floatframe::test

// Friction by bristles: no creep below breakaway, sliding, sticking, its linear system.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/linear/linear_system.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// 2 kg on a slide; the friction begins to slide at 20 N.
std::string sledge(const std::string& friction, const std::string& load, const std::string& start) {
  return R"(
bodies: {sledge: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}}
joints: {slide: {type: prismatic, child: sledge, at: [0, 0, 0], axis: x)" +
         start + R"(}}
forces:
  f: {type: bristle_friction, joint: slide, breakaway: 20, stiffness: 1e6, damping: 1e3)" +
         friction + R"(}
  p: {type: force, body: sledge, direction: x, magnitude: )" +
         load + R"(}
outputs: {x: {joint_position: slide}, v: {joint_velocity: slide}, f: {force: f}}
simulation: {step: 1.0e-3, duration: 10, spectral_radius: 0.8}
)";
}

double creep(const Model& model, Coordinates c) {
  const RunResult r = completed_run(model, with(model.simulation, c));
  const auto at = [&](std::size_t row) { return r.table.data[row * 4 + 1]; };
  // After the first second, at equal phases of the load.
  return std::abs(at(r.table.rows() - 1) - at(1000));
}

TEST(BristleFriction, DoesNotCreepBelowBreakaway) {
  const Model constant = model_of(sledge("", "12", "")),
              shaken = model_of(
                  sledge("", "{polynomial: [12], sine: {amplitude: 6, frequency: 10}}", ""));
  for (const Coordinates c : both_coordinates) {
    EXPECT_LT(creep(constant, c), 1e-9);
    EXPECT_LT(creep(shaken, c), 1e-9);
  }
  // The LuGre model does: that is why it is not the default.
  const Model lugre = model_of(
      sledge(", elastic: 0", "{polynomial: [12], sine: {amplitude: 6, frequency: 10}}", ""));
  EXPECT_GT(creep(lugre, Coordinates::relative), 1e-5);
}

// Without a fall from breakaway 20 N stop the sledge after v^2 m / (2 F), up to bristles.
TEST(BristleFriction, StopsASledge) {
  const Model model = model_of(sledge("", "0", ", velocity: 3"));
  double ways[2];
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 1.0));
    const auto row = r.table.data.end() - 4;
    ways[c == Coordinates::relative] = row[1];
    EXPECT_NEAR(row[1], 0.45, 2e-4);
    EXPECT_NEAR(row[2], 0.0, 1e-3);
    EXPECT_LT(r.summary.energy.largest_remainder, 1e-2 * r.summary.energy.exchanged);
  }
  EXPECT_NEAR(ways[0], ways[1], 1e-9);
}

TEST(BristleFriction, FallsToItsKineticValue) {
  const Model model =
      model_of(sledge(", kinetic: 15, stribeck: 0.01, viscous: 2", "0", ", velocity: 3"));
  const RunResult r =
      completed_run(model, with(model.simulation, Coordinates::relative, 1e-3, 0.1));
  const auto row = r.table.data.end() - 4;
  EXPECT_NEAR(row[3], 15.0 + 2.0 * row[2], 1e-2);
}

// A clamp that opens: the friction is that of the normal force.
TEST(BristleFriction, FollowsTheNormalForce) {
  const Model model = model_of(sledge(
      ", normal: {table: [[0, 1], [0.2, 1], [0.3, 0.25], [1, 0.25]]}", "0", ", velocity: 9"));
  const RunResult r =
      completed_run(model, with(model.simulation, Coordinates::relative, 1e-3, 0.5));
  const auto row = r.table.data.end() - 4;
  EXPECT_NEAR(row[3], 5.0, 1e-3);
}

// Sticking it is a spring with a damper: the poles of m s^2 + 1000 s + 1e6, and one at rest for the
// place where it sticks.
TEST(BristleFriction, SticksAsASpring) {
  const Model model = model_of(sledge("", "0", ""));
  for (const Coordinates c : both_coordinates) {
    const LinearSystem s = linear_system(model, {.coordinates = c});
    ASSERT_EQ(s.A.rows(), 3);
    const auto modes = linear_modes(s);
    ASSERT_EQ(modes.size(), 2u);
    EXPECT_NEAR(std::abs(modes[0].lambda), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(modes[1].lambda - std::complex<double>(-250.0, std::sqrt(5e5 - 62500.0))),
                0.0, 1e-6);
  }
}

}  // namespace
}  // namespace floatframe::test

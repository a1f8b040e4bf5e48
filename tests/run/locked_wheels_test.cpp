// A body on four locked wheels that slides, stops on a slope and stands, or comes onto ice: what
// tyres hold against each other neither swings nor creeps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/completed_run.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double hill = 0.15, fall = 9.81;

struct LockedWheels {
  std::string tyre, road = "{friction: 1}";
  double slope = 0.0;   ///< downhill along x
  double drift = 0.0;   ///< velocity across at the start [m/s]
  double step = 0.005;  ///< [s]
  double duration = 1.0;
};

std::string locked_wheels(const LockedWheels& m) {
  std::string forces;
  for (const char* front : {"1.2", "-1.4"})
    for (const char* side : {"left", "right"})
      forces += fmt::format(
          "  {}{}: {{body: car, at: [{}, {}0.7, 0.295], road: r, damping: 3000, side: {}, {}}}\n",
          *front == '-' ? "r" : "f", side, front, *side == 'l' ? "" : "-", side, m.tyre);
  const double normal = fall / std::hypot(1.0, m.slope);
  return fmt::format(
      R"(
gravity: [{:.17g}, 0, {:.17g}]
bodies: {{car: {{rigid: {{mass: 1360, centre_of_mass: [0, 0, 0.5], inertia: [800, 1500, 1500]}}}}}}
joints: {{car: {{type: free, child: car}}}}
forces:
{}roads: {{r: {}}}
outputs:
  p: {{position: car}}
  v: {{velocity: car}}
simulation: {{step: {}, duration: {}, velocity: [5, {}, 0]}}
)",
      m.slope * normal, -normal, forces, m.road, m.step, m.duration, m.drift);
}

const std::string magic_formula =
    "type: magic_formula_tyre, file: " FLOATFRAME_TEST_DATA "/tyres/mf/a_205_60R15_mf61.tir";
const std::string linear =
    "type: linear_tyre, radius: 0.31, stiffness: 2.0e+5, slip_stiffness: 8.0e+4, "
    "cornering_stiffness: 6.0e+4, relaxation_x: 0.2, relaxation_y: 0.5";

/// Largest minus smallest value of a column from a time on.
double range_from(const RunResult& r, std::size_t column, double time) {
  double low = 1e300, high = -1e300;
  for (std::size_t row = 0; row < r.table.rows(); ++row) {
    if (r.table.at(row, 0) < time) continue;
    low = std::min(low, r.table.at(row, column));
    high = std::max(high, r.table.at(row, column));
  }
  return high - low;
}

// Were the sense of rolling to change with a slope at rest, a yaw of a few Hz would grow: the
// lateral force of longitudinal slip changes its sign with it.
TEST(LockedWheels, StandWhereTheyStoppedOnASlope) {
  for (const Coordinates c : both_coordinates)
    for (const double step : {0.005, 0.01}) {
      const std::string text = locked_wheels(
          {.tyre = magic_formula, .slope = hill, .drift = 0.05, .step = step, .duration = 10.0});
      Model model = model_of(text);
      model.simulation.coordinates = c;
      const RunResult r = completed_run(model);
      EXPECT_LT(range_from(r, 1, 8.0), 1e-7) << step;
      EXPECT_LT(range_from(r, 2, 8.0), 1e-5) << step;
      EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 2.12, 0.02);
    }
}

// Its front wheels are on ice without friction, then its rear ones as well, and nothing brakes it.
TEST(LockedWheels, SlideOnWithoutFriction) {
  for (const char* friction : {"0", "1.0e-12"}) {
    const std::string ice = fmt::format(
        "{{friction: 1, patches: [{{x: [0, 100], y: [-50, 50], friction: {}}}]}}", friction);
    for (const std::string& tyre : {linear, linear + ", relaxation: false", magic_formula}) {
      const RunResult r =
          completed_run(model_of(locked_wheels({.tyre = tyre, .road = ice, .duration = 1.2})));
      const std::size_t last = r.table.rows() - 1;
      EXPECT_GT(r.table.at(last, 1), 1.4) << tyre;
      EXPECT_LT(r.table.at(last, 4), 4.5) << tyre;
      EXPECT_LT(range_from(r, 4, 1.15), 1e-6) << tyre;
    }
  }
}

}  // namespace
}  // namespace floatframe::test

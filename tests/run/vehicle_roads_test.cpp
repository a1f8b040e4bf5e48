// Vehicles on roads with width: steps that do not allocate, tracks under the wheels of both sides,
// patches of ice under a locked wheel, plates that lift.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "floatframe/description/random_tracks.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/roads/crg_file.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/trajectory_models.hpp"

namespace floatframe::test {
namespace {

/// A measured road: heading, slope and nine heights across, flat to x = 2.5 m, then 5 mm high.
CrgRoad bumpy_crg(CrgInterpolation interpolation) {
  std::string text =
      "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 0.25\nREFERENCE_LINE_START_X = -5\n"
      "LONG_SECTION_V_RIGHT = -2\nLONG_SECTION_V_LEFT = 2\n$\n$KD_Definition\n#:LRFI\n"
      "D:reference line phi,rad\nD:reference line slope,m/m\n";
  for (int k = 1; k <= 9; ++k) text += "D:long section " + std::to_string(k) + ",m\n";
  text += "$\n$$$$\n";
  for (int row = 0; row < 400; ++row) {
    std::string line;
    for (int k = 0; k < 11; ++k) {
      const double x = k == 0   ? 1e-4 * row
                       : k == 1 ? 0.0
                                : 0.005 * std::sin(0.7 * row + 2.1 * k) *
                                      std::clamp((row - 30.0) / 10.0, 0.0, 1.0);
      char number[16];
      std::snprintf(number, sizeof number, "%10.6f", x);
      line += number;
      if (k == 7) line += '\n';
    }
    text += line + '\n';
  }
  CrgRoad road = read_crg(text, "bumps.crg");
  road.interpolation = interpolation;
  return road;
}

ModelDescription driven_iltis(const std::string& road) {
  return read_model(FLOATFRAME_EXAMPLES "/iltis/handling.yaml",
                    {{"road", road}, {"angle", "0.3 * sin(2 * t)"}, {"drive", "50"}});
}

void expect_no_allocation(const Model& model, Coordinates coordinates) {
  const SimulationDescription options = with(model.simulation, coordinates);
  Stepper steps(model, options, {.duration = 2.0});
  std::vector<double> row(model.outputs.size() + 1);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(steps.advance());
  double least = 1.0, most = -1.0;
  bool good = true;
  const AllocationScope scope;
  for (int k = 0; good && k < 600; ++k) {
    good = steps.advance();
    steps.sample(row.data());
    least = std::min(least, row[6]);
    most = std::max(most, row[6]);
  }
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_TRUE(good);
  EXPECT_GT(most - least, 1e-4);  // roll: it feels the road
}

TEST(VehicleRoads, StepsWithMagicFormulaTyresDoNotAllocate) {
  for (const Coordinates c : both_coordinates) {
    for (const char* road : {"plane", "rough"})
      expect_no_allocation(build_model(driven_iltis(road)), c);
    for (const CrgInterpolation kind : {CrgInterpolation::linear, CrgInterpolation::cubic}) {
      ModelDescription d = driven_iltis("plane");
      RoadSurface surface;
      surface.crg = std::make_shared<const CrgRoad>(bumpy_crg(kind));
      for (RoadDescription& road : d.roads)
        if (road.name == "plane") road.surface = std::make_shared<const RoadSurface>(surface);
      expect_no_allocation(build_model(d), c);
    }
  }
}

/// A tyre that rolls on each track at a constant speed: where it touches is the track.
const std::string wheels_on_tracks = R"(
gravity: [0, 0, -9.81]
bodies:
  cart: {position: [20, 0, 0.3], rigid: {mass: 0}}
  left: {position: [20, 0.7, 0.3], rigid: {mass: 30, inertia: [1, 1, 1]}}
  right: {position: [20, -0.7, 0.3], rigid: {mass: 30, inertia: [1, 1, 1]}}
joints:
  drive: {type: prismatic, child: cart, at: [20, 0, 0.3], axis: x, motion: {polynomial: [0, 10]}}
  left: {type: prismatic, parent: cart, child: left, at: [20, 0.7, 0.3], axis: z}
  right: {type: prismatic, parent: cart, child: right, at: [20, -0.7, 0.3], axis: z}
roads: {r: {tracks: {class: B, length: 100, width: 1.4, seed: 4}}}
forces:
  left: {type: linear_tyre, body: left, spinning: false, road: r, radius: 0.3, stiffness: 2e5,
    damping: 500, slip_stiffness: 1e4, cornering_stiffness: 1e4,
    relaxation_x: 0.3, relaxation_y: 0.3}
  right: {type: linear_tyre, body: right, spinning: false, road: r, radius: 0.3, stiffness: 2e5,
    damping: 500, slip_stiffness: 1e4, cornering_stiffness: 1e4,
    relaxation_x: 0.3, relaxation_y: 0.3}
outputs:
  lx: {force: left, output: contact_x}
  lz: {force: left, output: contact_z}
  rx: {force: right, output: contact_x}
  rz: {force: right, output: contact_z}
simulation: {start: equilibrium, step: 0.002, duration: 1}
)";

TEST(VehicleRoads, EachSideRollsOnItsTrack) {
  TrackSpectrum t;
  t.road.roughness = 64e-6;
  t.road.length = 100.0;
  t.road.seed = 4;
  t.width = 1.4;
  const TwoTracks tracks = random_tracks(t);
  const ResultTable table = completed_run(model_of(wheels_on_tracks)).table;
  double apart = 0.0;
  for (std::size_t i = 0; i < table.rows(); i += 25) {
    const double left = entry(table, i, "lz"), right = entry(table, i, "rz");
    EXPECT_NEAR(left, tracks.left(entry(table, i, "lx")).f, 1e-8);
    EXPECT_NEAR(right, tracks.right(entry(table, i, "rx")).f, 1e-8);
    apart = std::max(apart, std::abs(left - right));
  }
  EXPECT_GT(apart, 2e-3);
}

/// A locked wheel of 100 kg slides from 12 m/s on, over ice from 4 m to 8 m; the cart has 300 kg.
const std::string locked_wheel_on_ice = R"(
gravity: [0, 0, -9.81]
bodies:
  cart: {position: [0, 0, 0.3], rigid: {mass: 300}}
  wheel: {position: [0, 0, 0.3], rigid: {mass: 100, inertia: [1, 1, 1]}}
joints:
  slide: {type: prismatic, child: cart, at: [0, 0, 0.3], axis: x, velocity: 12}
  post: {type: prismatic, parent: cart, child: wheel, at: [0, 0, 0.3], axis: z}
roads: {r: {friction: 0.8, patches: [{x: [4, 8], y: [-1, 1], friction: 0.25}]}}
forces:
  tyre: {type: linear_tyre, body: wheel, road: r, radius: 0.3, stiffness: 2e5, damping: 2000,
    slip_stiffness: 8e4, cornering_stiffness: 8e4, relaxation_x: 0.1, relaxation_y: 0.1}
outputs:
  x: {joint_position: slide}
  v: {joint_velocity: slide}
simulation: {start: equilibrium, step: 0.001, duration: 1.4}
)";

/// v^2 falls by 2 mu N / M per metre, N / M = 9.81 / 4, with 0.8 and with 0.25 in place of it.
TEST(VehicleRoads, ALockedWheelSlidesOverIce) {
  for (const Coordinates c : both_coordinates) {
    const Model model = model_of(locked_wheel_on_ice);
    const ResultTable t = completed_run(model, with(model.simulation, c)).table;
    // Between places that the deflection of the tyre, 1 to 2 cm, does not reach.
    const auto slope = [&](double from, double to) {
      std::size_t i = 0, k = 0;
      while (entry(t, i, "x") < from) ++i;
      while (entry(t, k, "x") < to) ++k;
      const double v = entry(t, i, "v"), w = entry(t, k, "v");
      return (v * v - w * w) / (2.0 * (entry(t, k, "x") - entry(t, i, "x")));
    };
    EXPECT_NEAR(slope(2.0, 3.8), 0.8 * 9.81 / 4.0, 1e-6);
    EXPECT_NEAR(slope(6.0, 7.8), 0.25 * 9.81 / 4.0, 1e-6);
    EXPECT_NEAR(slope(10.0, 12.0), 0.8 * 9.81 / 4.0, 1e-6);
  }
}

}  // namespace
}  // namespace floatframe::test

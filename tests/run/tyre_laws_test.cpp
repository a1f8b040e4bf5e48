// Wheels that are pushed along at a constant slip against the laws of their tyres.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/stepping/stepping.hpp"
#include "floatframe/tyres/calspan.hpp"
#include "floatframe/tyres/tmeasy.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double height = 0.36, speed = 20.0;
const std::string van_tyre = R"(
    type: tmeasy_tyre, radius: 0.376, nominal_load: 1900, stiffness: [1.0e+5, 1.1e+5],
    longitudinal: [[34911, 2145.5, 0.139, 1522.8, 0.667], [73974, 4140.6, 0.139, 2922.8, 0.667]],
    lateral: [[30367, 1901.7, 0.149, 1583.8, 0.965], [48834, 3472.0, 0.185, 2938.8, 1.071]],
    trail: [[0.178, 0.163, 0.965], [0.190, 0.204, 1.071]],
    longitudinal_stiffness: 1.2e+5, lateral_stiffness: 8.0e+4)";
const std::string iltis_tyre = R"(
    type: calspan_tyre, radius: 0.364325, stiffness: 4.6e+5, cornering: [2625, 14.47, 12930],
    camber: [2.29, 18175], friction: [-4.64e-5, 1.216, 2.18e-11], skid_number: 1.0274,
    aligning: [-1.71e-5, 1.71e-5])";

/// At the speed along x, steered by `steer` to the left, the top of the wheel to the right by
/// `camber`; its spin is Omega.
std::string pushed_wheel(double steer, double camber, double Omega, const std::string& tyre) {
  const std::string axis =
      fmt::format("[{:.17g}, {:.17g}, {:.17g}]", -std::sin(steer) * std::cos(camber),
                  std::cos(steer) * std::cos(camber), std::sin(camber));
  return fmt::format(R"(
bodies:
  sledge: {{rigid: {{mass: 10, centre_of_mass: [0, 0, 0.36], inertia: [1, 1, 1]}}}}
  wheel: {{rigid: {{mass: 1, centre_of_mass: [0, 0, 0.36], inertia: [1, 1, 1]}}}}
joints:
  slide: {{type: prismatic, child: sledge, at: [0, 0, 0.36], axis: x,
    motion: {{polynomial: [0, {}]}}}}
  axle: {{type: revolute, parent: sledge, child: wheel, at: [0, 0, 0.36], axis: {},
    motion: {{polynomial: [0, {:.17g}]}}}}
forces:
  tyre: {{body: wheel, at: [0, 0, 0.36], road: flat, axis: {},{}}}
roads: {{flat: {{profile: [[-1, 0], [1, 0]]}}}}
outputs:
  load: {{force: tyre}}
  Fx: {{force: tyre, output: longitudinal_force}}
  Fy: {{force: tyre, output: lateral_force}}
  Mz: {{force: tyre, output: aligning_moment}}
simulation: {{step: 1.0e-3, duration: 0.05}}
)",
                     speed, axis, Omega, axis, tyre);
}

/// At the end of a run: load, Fx, Fy, Mz.
std::array<double, 4> steady_forces(const std::string& model) {
  const RunResult r = completed_run(model_of(model));
  const std::size_t last = r.table.rows() - 1;
  return {r.table.at(last, 1), r.table.at(last, 2), r.table.at(last, 3), r.table.at(last, 4)};
}

TEST(CalspanTyre, HasTheForcesOfItsLawAtTheSlipOfTheWheelCentre) {
  const Calspan iltis = {2625.0,   14.47, 12930.0,  2.29,   18175.0,  1.0,
                         -4.64e-5, 1.216, 2.18e-11, 1.0274, -1.71e-5, 1.71e-5};
  for (const double steer : {-0.3, -0.02, 0.0, 0.05})
    for (const double camber : {-0.03, 0.0, 0.06}) {
      // The floor of the speed below the slip is a tenth of damping_speed.
      const auto [load, Fx, Fy, Mz] =
          steady_forces(pushed_wheel(steer, camber, 55.0, iltis_tyre + ", damping_speed: 1.0e-4"));
      const double Fz = 4.6e5 * (0.364325 - height);
      const auto law = calspan_forces(iltis, Fz, 1.0, -steer, camber);
      EXPECT_NEAR(load, Fz, 1e-8 * Fz);
      EXPECT_EQ(Fx, 0.0);
      EXPECT_NEAR(Fy, law.Fy, 1e-7 * Fz);
      EXPECT_NEAR(Mz, law.Mz, 1e-8 * Fz);
    }
}

TEST(TmeasyTyre, HasTheForcesOfItsLawAtItsSlips) {
  Tmeasy law;
  law.nominal_load = 1900.0;
  law.max_load = 3.5 * 1900.0;
  law.x = {{34911.0, 73974.0}, {2145.5, 4140.6}, {1522.8, 2922.8}, {0.139, 0.139}, {0.667, 0.667}};
  law.y = {{30367.0, 48834.0}, {1901.7, 3472.0}, {1583.8, 2938.8}, {0.149, 0.185}, {0.965, 1.071}};
  law.trail = {{0.178, 0.19}, {0.163, 0.204}, {0.965, 1.071}};
  law.radius = 0.376;
  law.stiffness = 1e5;
  // Vertical stiffnesses 1e5 and 1.1e5 N/m at 1900 and 3800 N.
  const double a1 = 1e5 * std::sqrt(2.0 - 1.21), a2 = 0.21e10 / 7600.0;
  const double d = 0.376 - height, Fz = d * (a1 + a2 * d), r_e = 0.376 - 0.33 * d;
  for (const double steer : {0.0, 0.03, -0.4})
    for (const double kappa : {-0.5, -0.05, 0.0, 0.1, 0.8}) {
      const double along = speed * std::cos(steer);
      const auto [load, Fx, Fy, Mz] =
          steady_forces(pushed_wheel(steer, 0.0, (1.0 + kappa) * along / r_e, van_tyre));
      const double tread = 1.0 + kappa * along / std::hypot(along, 0.1);
      const auto of = tmeasy_forces(law, Fz, 1.0, kappa / tread, std::tan(steer) / tread);
      EXPECT_NEAR(load, Fz, 1e-8 * Fz);
      EXPECT_NEAR(Fx, of.Fx, 1e-7 * Fz) << "steer " << steer << " kappa " << kappa;
      EXPECT_NEAR(Fy, of.Fy, 1e-7 * Fz) << "steer " << steer << " kappa " << kappa;
      EXPECT_NEAR(Mz, of.Mz, 1e-7 * Fz) << "steer " << steer << " kappa " << kappa;
    }
}

/// 400 kg on one wheel, askew, that lands after 0.1 s and is braked.
std::string landing_wheel(const std::string& tyre) {
  return fmt::format(R"(
bodies:
  car: {{rigid: {{mass: 380, centre_of_mass: [0, 0, 0.42], inertia: [20, 20, 20]}}}}
  wheel: {{rigid: {{mass: 20, centre_of_mass: [0, 0, 0.42], inertia: [1, 1.2, 1]}}}}
joints:
  plane: {{type: planar, child: car, at: [0, 0, 0.42], axis: y, axis_2: x, velocity: [20, 0, 0]}}
  axle: {{type: revolute, parent: car, child: wheel, at: [0, 0, 0.42], axis: [-0.05, 1, 0.02],
    velocity: 55}}
forces:
  tyre: {{body: wheel, road: flat, axis: [-0.05, 1, 0.02], damping: 1000, {}}}
  brake: {{type: bristle_friction, joint: axle, breakaway: 900, stiffness: 2.0e+4, damping: 20}}
roads: {{flat: {{profile: [[-1, 0], [1, 0]]}}}}
outputs: {{load: {{force: tyre}}}}
simulation: {{step: 0.001}}
)",
                     tyre);
}

TEST(RollingTyre, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const std::string file = FLOATFRAME_TEST_DATA "/tyres/mf/b_mf61.tir";
  for (const std::string& tyre : {"type: magic_formula_tyre, file: " + file, van_tyre, iltis_tyre})
    for (const Coordinates c : both_coordinates) {
      Simulation s(model_of(landing_wheel(tyre)), {.coordinates = c});
      for (int k = 0; k < 20; ++k) ASSERT_TRUE(s.step());
      EXPECT_EQ(s.output("load"), 0.0);
      const AllocationScope scope;
      for (int k = 0; k < 100; ++k) s.step();
      EXPECT_EQ(scope.count(), 0u) << tyre;
      EXPECT_GT(s.output("load"), 0.0);
    }
}

TEST(RollingTyre, BeyondItsRoadEndsTheRunWithASentence) {
  Simulation s(model_of(R"(
bodies:
  w: {rigid: {mass: 400, inertia: [10, 10, 10]}, position: [0, 0, 0.3]}
joints:
  s: {type: planar, child: w, at: [0, 0, 0.3], axis: y, axis_2: x, velocity: [5, 0, 0]}
forces:
  t: {type: linear_tyre, body: w, spinning: false, road: g, radius: 0.31, stiffness: 4.0e+5,
    damping: 1000, slip_stiffness: 6.0e+4, cornering_stiffness: 5.0e+4, relaxation_x: 0.3,
    relaxation_y: 0.5, friction: 1}
roads:
  g: {grid: {x: [-2, 0, 3], y: [-1, 1], z: [[0, 0], [0, 0], [0, 0]], outside: refuse}}
simulation: {step: 0.001}
)"));
  while (s.time() < 1.0 && s.step()) {
  }
  EXPECT_NEAR(s.time(), 0.6, 1e-3);
  EXPECT_TRUE(contains(s.failure(), "the road 'g' does not lead"));
}

}  // namespace
}  // namespace floatframe::test

// Loads of the air: coasting down by drag alone, in a wind, and the directions of the forces.
//   m vdot = -b C (v - w)|v - w|, b = density area/2: with k = b C/m
//   v - w = (v0 - w)/(1 + k (v0 - w) t)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string car_in_air(const std::string& load) {
  return fmt::format(R"(
bodies: {{car: {{rigid: {{mass: 1000, centre_of_mass: [0, 0, 0.5], inertia: [500, 2000, 2000]}}}}}}
joints: {{slide: {{type: prismatic, child: car, at: [0, 0, 0.5], axis: x, velocity: 40}}}}
forces: {{air: {{type: aerodynamic_load, body: car, at: [0, 0, 0.5], area: 2, {}}}}}
outputs:
  v: {{joint_velocity: slide}}
  drag: {{force: air}}
  side: {{force: air, output: side_force}}
  lift: {{force: air, output: lift}}
simulation: {{step: 0.01, duration: 20}}
)",
                     load);
}

double coast_down_deviation(const Model& model, double wind, Coordinates c, double step) {
  const RunResult r = completed_run(model, with(model.simulation, c, step, 20.0));
  const double k = 0.5 * 1.25 * 2.0 * 0.4 / 1000.0, fast = 40.0 - wind;
  double worst = 0.0;
  for (std::size_t i = 0; i < r.table.rows(); ++i) {
    const double v = wind + fast / (1.0 + k * fast * r.table.at(i, 0));
    worst = std::max(worst, std::abs(r.table.at(i, 1) - v));
  }
  return worst;
}

TEST(AerodynamicLoad, CoastsDownAsTheClosedForm) {
  for (const double wind : {0.0, -15.0, 10.0}) {
    const Model model = model_of(
        car_in_air(fmt::format("drag: 0.4, density: 1.25, wind: {{polynomial: [{}]}}", wind)));
    for (const Coordinates c : both_coordinates) {
      const double coarse = coast_down_deviation(model, wind, c, 0.2),
                   fine = coast_down_deviation(model, wind, c, 0.1);
      EXPECT_NEAR(coarse / fine, 4.0, 0.2) << wind;
      EXPECT_LT(coast_down_deviation(model, wind, c, 0.01), 1e-5) << wind;
    }
  }
}

TEST(AerodynamicLoad, ForcesAreAlongTheAxesOfTheBody) {
  const double angle = 0.3, b = 1.2;
  const RunResult r = completed_run(
      model_of(car_in_air(fmt::format("drag: 0.4, side: 1.5, lift: -2, axis_2: [{:.17g}, {:.17g}, "
                                      "0], wind: {{polynomial: [9]}}, wind_direction: [0, 3, 0]",
                                      std::cos(angle), std::sin(angle)))));
  const double u_x = -40.0, u_y = 9.0, speed = std::hypot(u_x, u_y);
  const double u1 = u_x * std::cos(angle) + u_y * std::sin(angle),
               u2 = u_y * std::cos(angle) - u_x * std::sin(angle);
  EXPECT_NEAR(r.table.at(0, 2), -b * 0.4 * speed * u1, 1e-9);
  EXPECT_NEAR(r.table.at(0, 3), b * 1.5 * speed * u2, 1e-9);
  EXPECT_NEAR(r.table.at(0, 4), -b * 2.0 * speed * speed, 1e-9);
}

}  // namespace
}  // namespace floatframe::test

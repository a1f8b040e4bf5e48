// A quarter vehicle that brakes, stops and parks on a slope, against an independent integration;
// a vehicle on four tyres that is parked; the same on tyres of the Magic Formula.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/named_rows.hpp"

namespace floatframe::test {
namespace {

constexpr double car_mass = 400.0, earth_gravity = 9.81, rest_stiffness = 80000.0 / 0.3;

struct BrakeCase {
  const char* name;
  double speed, torque, grade, friction, drive;
};

/// 400 kg on a wheel of 1.2 kg m2 and 0.3 m; uphill is along x, by the direction of gravity. The
/// brake sticks by bristles. Softer ones give way before the tyre does: ten times as soft, the way
/// of a vehicle that slides from rest is 0.2 mm longer.
std::string quarter_vehicle(const BrakeCase& x) {
  const double angle = std::atan(x.grade), load = car_mass * earth_gravity * std::cos(angle);
  return fmt::format(
      R"(
gravity: [{:.17g}, 0, {:.17g}]
bodies:
  car: {{rigid: {{mass: 380, centre_of_mass: [0, 0, 0.3], inertia: [10, 10, 10]}}}}
  wheel: {{rigid: {{mass: 20, centre_of_mass: [0, 0, 0.3], inertia: [1, 1.2, 1]}}}}
joints:
  road: {{type: prismatic, child: car, at: [0, 0, 0.3], axis: x, velocity: {}}}
  axle: {{type: revolute, parent: car, child: wheel, at: [0, 0, 0.3], axis: y, velocity: {:.17g}}}
forces:
  tyre: {{type: linear_tyre, body: wheel, road: flat, radius: {:.17g}, stiffness: 2.0e+5,
    slip_stiffness: 8.0e+4, cornering_stiffness: 8.0e+4, relaxation_x: 0.3, relaxation_y: 0.3,
    friction: {}, rest_damping: 770}}
{}roads: {{flat: {{profile: [[-1, 0], [1, 0]]}}}}
outputs:
  x: {{joint_position: road}}
  v: {{joint_velocity: road}}
  Fx: {{force: tyre, output: longitudinal_force}}
simulation: {{step: 1.0e-4, duration: 1, output_interval: 0.1, spectral_radius: 0.8}}
)",
      -earth_gravity * std::sin(angle), -earth_gravity * std::cos(angle), x.speed, x.speed / 0.3,
      0.3 + load / 2e5, x.friction,
      x.torque > 0.0
          ? fmt::format("  brake: {{type: bristle_friction, joint: axle, breakaway: {}, stiffness: "
                        "2.0e+8, damping: 2.0e+4}}\n",
                        x.torque)
          : fmt::format("  motor: {{type: joint_spring, joint: axle, actuator: {}}}\n", x.drive));
}

/// Up to this instant [s]; infinity: to the end.
double first_stop(const std::string& name) {
  std::ifstream in(std::string(FLOATFRAME_TEST_DATA) + "/tyres/quarter_car_events.csv");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ",first_zero_speed,"))
      return std::stod(line.substr(name.size() + 18));
  return INFINITY;
}

class QuarterVehicle : public ::testing::TestWithParam<BrakeCase> {};

TEST_P(QuarterVehicle, IsTheReferenceUntilItStops) {
  const auto reference = named_rows("tyres/quarter_car.csv", GetParam().name);
  const Model model = model_of(quarter_vehicle(GetParam()));
  const double stop = first_stop(GetParam().name);
  const double end = std::min(stop + 0.3, reference.back()("t_s"));
  const RunResult r =
      completed_run(model, with(model.simulation, Coordinates::relative, 1e-4, end));
  double way = 0.0, speed = 0.0;
  for (std::size_t k = 0; k < r.table.rows() && k < reference.size(); ++k) {
    if (reference[k]("t_s") >= stop) break;
    way = std::max(way, std::abs(r.table.at(k, 1) - reference[k]("x_m")));
    speed = std::max(speed, std::abs(r.table.at(k, 2) - reference[k]("v_m_s")));
  }
  figure(std::string(GetParam().name) + "_way", way);
  EXPECT_LT(way, 1e-4);
  EXPECT_LT(speed, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Cases, QuarterVehicle,
                         ::testing::Values(BrakeCase{"brake_no_lock", 15, 600, 0, 1, 0},
                                           BrakeCase{"brake_lock", 15, 2000, 0, 1, 0},
                                           BrakeCase{"brake_lock_mu03", 15, 2000, 0, 0.3, 0},
                                           BrakeCase{"brake_uphill_15pc", 10, 600, 0.15, 1, 0},
                                           BrakeCase{"brake_downhill_15pc", 10, 600, -0.15, 1, 0},
                                           BrakeCase{"park_15pc", 0, 2000, 0.15, 1, 0},
                                           BrakeCase{"park_30pc", 0, 2000, 0.3, 1, 0},
                                           BrakeCase{"park_30pc_brake_too_weak", 0, 250, 0.3, 1, 0},
                                           BrakeCase{"park_30pc_mu02_slides", 0, 2000, 0.3, 0.2, 0},
                                           BrakeCase{"drive_from_rest", 0, 0, 0, 1, 300}),
                         [](const auto& c) { return std::string(c.param.name); });

// It rocks back by F/C, and stands.
TEST(QuarterVehicleStop, RocksBackAndStands) {
  const Model model = model_of(quarter_vehicle({"brake_lock", 15, 2000, 0, 1, 0}));
  SimulationDescription simulation = with(model.simulation, Coordinates::relative, 1e-3, 20.0);
  simulation.output_interval = 1e-3;  // it rocks at 4 Hz
  const RunResult r = completed_run(model, simulation);
  double furthest = 0.0;
  for (std::size_t k = 0; k < r.table.rows(); ++k) furthest = std::max(furthest, r.table.at(k, 1));
  const double back = furthest - r.table.at(r.table.rows() - 1, 1),
               expected = car_mass * earth_gravity / rest_stiffness;
  figure("quarter_vehicle_back", back / expected);
  EXPECT_NEAR(back, expected, 0.03 * expected);
  EXPECT_LT(std::abs(r.table.at(r.table.rows() - 1, 2)), 1e-6);
}

TEST(QuarterVehicleStop, RestsOnItsTyreAndDoesNotCreep) {
  for (const Coordinates c : both_coordinates)
    for (const double step : {1e-3, 1e-2}) {
      const Model model = model_of(quarter_vehicle({"park_15pc", 0, 2000, 0.15, 1, 0}));
      const RunResult r = completed_run(model, with(model.simulation, c, step, 30.0));
      const std::size_t last = r.table.rows() - 1;
      double drift = 0.0;
      for (std::size_t k = 0; k <= last; ++k)
        if (r.table.at(k, 0) >= 20.0)
          drift = std::max(drift, std::abs(r.table.at(k, 1) - r.table.at(last, 1)));
      figure("quarter_vehicle_drift_" + name_of(c), drift);
      EXPECT_LT(drift, 1e-6) << name_of(c) << " " << step;
      const double weight = car_mass * earth_gravity * std::sin(std::atan(0.15));
      EXPECT_NEAR(r.table.at(last, 3) / rest_stiffness, weight / rest_stiffness, 1e-5);
    }
}

/// 1200 kg on four tyres of locked wheels, on a slope of 15 % across which it stands askew.
const char* const parked = R"(
bodies:
  car:
    rigid: {mass: 1200, centre_of_mass: [0, 0, 0.5], inertia: [400, 1600, 1700]}
joints: {free: {type: free, child: car}}
forces:
  fl: {type: linear_tyre, body: car, at: [1.2, 0.7, 0.3], <<}
  fr: {type: linear_tyre, body: car, at: [1.2, -0.7, 0.3], side: right, <<}
  rl: {type: linear_tyre, body: car, at: [-1.3, 0.7, 0.3], <<}
  rr: {type: linear_tyre, body: car, at: [-1.3, -0.7, 0.3], side: right, <<}
roads: {hill: {profile: PROFILE}}
outputs:
  p: {position: car}
  fl: {force: fl}
  fr: {force: fr}
  rl: {force: rl}
  rr: {force: rr}
simulation: {start: equilibrium, step: 1.0e-3, duration: 30, output_interval: 1}
)";

std::string parked_vehicle(const std::string& profile) {
  std::string text = parked;
  text.replace(text.find("PROFILE"), 7, profile);
  for (std::size_t at = text.find("<<"); at != std::string::npos; at = text.find("<<"))
    text.replace(at, 2,
                 "road: hill, radius: 0.31, stiffness: 2.0e+5, damping: 1000, slip_stiffness: "
                 "8.0e+4, cornering_stiffness: 6.0e+4, relaxation_x: 0.3, relaxation_y: 0.5");
  return text;
}

TEST(ParkedVehicle, StaysInItsEquilibrium) {
  const Model model = model_of(parked_vehicle("[[-10, -1.5], [10, 1.5]]"));
  for (const Coordinates c : both_coordinates)
    for (const double step : {1e-3, 1e-2}) {
      const RunResult r = completed_run(model, with(model.simulation, c, step, 30.0));
      const std::size_t last = r.table.rows() - 1;
      double drift = 0.0, load = 0.0;
      for (std::size_t k = 1; k <= 3; ++k)
        drift = std::max(drift, std::abs(r.table.at(last, k) - r.table.at(0, k)));
      for (std::size_t k = 4; k <= 7; ++k) load += r.table.at(last, k);
      figure("parked_vehicle_drift_" + name_of(c), drift);
      EXPECT_LT(drift, 1e-6) << name_of(c) << " " << step;
      EXPECT_NEAR(load, 1200.0 * earth_gravity * std::cos(std::atan(0.15)), 1e-3);
    }
}

/// In the place of the tyre that a model has, with the same place on the vehicle.
std::string on_magic_tyres(std::string text, const std::string& keys) {
  const std::string plain = "linear_tyre", other = "magic_formula_tyre";
  for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at)) {
    text.replace(at, plain.size(), other);
    at = text.find("radius:", at);
    text.replace(at, text.find('}', at) - at, keys);
  }
  return text;
}
const std::string passenger_tyre =
    std::string("file: ") + FLOATFRAME_TEST_DATA + "/tyres/mf/a_205_60R15_mf61.tir";

/// The largest distance from its end of what a column shows after `begin`.
double drift_from(const RunResult& r, double begin, std::size_t column) {
  double drift = 0.0;
  const std::size_t last = r.table.rows() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    if (r.table.at(k, 0) >= begin)
      drift = std::max(drift, std::abs(r.table.at(k, column) - r.table.at(last, column)));
  return drift;
}

// It begins beside its rest, and rocks.
TEST(QuarterVehicleStop, RestsOnAMagicFormulaTyre) {
  const Model model =
      model_of(on_magic_tyres(quarter_vehicle({"park_15pc", 0, 2000, 0.15, 1, 0}), passenger_tyre));
  for (const Coordinates c : both_coordinates)
    for (const double step : {1e-3, 1e-2}) {
      const RunResult r = completed_run(model, with(model.simulation, c, step, 30.0));
      EXPECT_LT(drift_from(r, 20.0, 1), 1e-6) << name_of(c) << " " << step;
      EXPECT_NEAR(r.table.at(r.table.rows() - 1, 3),
                  car_mass * earth_gravity * std::sin(std::atan(0.15)), 1e-3);
    }
}

// Across a slope by the direction of gravity; in its equilibrium from the start.
TEST(ParkedVehicle, StaysOnMagicFormulaTyres) {
  const double slope = std::atan(0.15), askew = 0.5, g = earth_gravity;
  const Model model = model_of(
      fmt::format("gravity: [{:.17g}, {:.17g}, {:.17g}]", -g * std::sin(slope) * std::cos(askew),
                  -g * std::sin(slope) * std::sin(askew), -g * std::cos(slope)) +
      on_magic_tyres(parked_vehicle("[[-10, 0], [10, 0]]"), passenger_tyre + ", damping: 1000"));
  for (const Coordinates c : both_coordinates)
    for (const double step : {1e-3, 1e-2}) {
      const RunResult r = completed_run(model, with(model.simulation, c, step, 30.0));
      double load = 0.0;
      for (std::size_t k = 1; k <= 3; ++k)
        EXPECT_LT(drift_from(r, 0.0, k), 1e-6) << name_of(c) << " " << step;
      for (std::size_t k = 4; k <= 7; ++k) load += r.table.at(r.table.rows() - 1, k);
      EXPECT_NEAR(load, 1200.0 * g * std::cos(slope), 1e-3);
    }
}

}  // namespace
}  // namespace floatframe::test

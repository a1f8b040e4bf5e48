// Figures of ISO 4138, ISO 7401 and ISO 3888-2 against tables that were computed independently.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/vehicle/circle_figures.hpp"
#include "floatframe/vehicle/lane_gates.hpp"
#include "floatframe/vehicle/step_figures.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

std::vector<CirclePoint> circle_points(const std::string& model, std::vector<TableRow>& rows) {
  std::vector<CirclePoint> out;
  for (const TableRow& row : vehicle_table("iso4138_circle.csv")) {
    if (row.at("model") != model) continue;
    rows.push_back(row);
    const double v = number(row, "v_m_s");
    out.push_back({.speed = v,
                   .yaw_rate = v / number(row, "R_m"),
                   .lateral_acceleration = number(row, "ay_m_s2"),
                   .steering = number(row, "delta_deg") * deg,
                   .sideslip = number(row, "beta_deg") * deg});
  }
  return out;
}

TEST(CircleFigures, OfTheTablesOfIso4138) {
  for (const char* model : {"linear", "mf_a_sym_small_steer"}) {
    std::vector<TableRow> rows;
    const auto points = circle_points(model, rows);
    ASSERT_EQ(points.size(), 14u);
    const auto figures = circle_figures(points, {.front = 1.2, .rear = 1.4});
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_NEAR(figures[k].front_slip / deg, number(rows[k], "alpha_f_deg"), 1e-8);
      EXPECT_NEAR(figures[k].rear_slip / deg, number(rows[k], "alpha_r_deg"), 1e-8);
      EXPECT_NEAR(points[k].radius(), 100.0, 1e-9);
    }
  }
}

TEST(CircleFigures, GradientsOfTheLinearVehicleAreConstant) {
  std::vector<TableRow> rows;
  const auto points = circle_points("linear", rows);
  const TableRow vehicle = vehicle_table("singletrack_parameters.csv")[0];
  const SingleTrack car = single_track("understeer");
  const double sideslip = -car.m * car.a / (car.Cr * (car.a + car.b));
  for (const CircleFigures& f : circle_figures(points, {.front = 1.2, .rear = 1.4})) {
    EXPECT_NEAR(f.understeer_gradient, number(vehicle, "K_rad_s2_m"), 1e-10);
    EXPECT_NEAR(f.steering_gradient, number(vehicle, "K_rad_s2_m"), 1e-10);
    EXPECT_NEAR(f.sideslip_gradient, sideslip, 1e-10);
    ASSERT_TRUE(f.characteristic);
    EXPECT_NEAR(*f.characteristic, number(vehicle, "v_characteristic_m_s"), 1e-6);
    EXPECT_FALSE(f.critical);
  }
}

// At another radius than the nominal one only the steering gradient changes.
TEST(CircleFigures, UndersteerDoesNotDependOnTheRadiusDriven) {
  const SingleTrack car = single_track("oversteer");
  const TableRow vehicle = vehicle_table("singletrack_parameters.csv")[2];
  std::vector<CirclePoint> points;
  for (const double v : {8.0, 12.0, 15.0, 20.0}) {
    const double delta = 0.02 + 0.0004 * v;
    const Eigen::Vector2d x = car.steady(v, delta);
    points.push_back({.speed = v,
                      .yaw_rate = x[1],
                      .lateral_acceleration = v * x[1],
                      .steering = delta,
                      .sideslip = x[0]});
  }
  for (const CircleFigures& f : circle_figures(points, {.front = 1.4, .rear = 1.2})) {
    EXPECT_NEAR(f.understeer_gradient, number(vehicle, "K_rad_s2_m"), 1e-12);
    ASSERT_TRUE(f.critical);
    EXPECT_NEAR(*f.critical, number(vehicle, "v_critical_m_s"), 1e-7);
  }
}

TEST(CircleFigures, SlopesOfAParabolaAreExact) {
  const std::vector<double> x{0.0, 0.3, 1.0, 1.2, 4.0};
  std::vector<double> y;
  for (const double a : x) y.push_back(2.0 - a + 0.25 * a * a);
  const auto s = slopes(x, y);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(s[k], -1.0 + 0.5 * x[k], 1e-14);
  EXPECT_EQ(slopes({1.0, 3.0}, {2.0, 8.0}), (std::vector<double>{3.0, 3.0}));
}

struct SteppedCar {
  std::vector<double> t, steering, yaw_rate, ay, sideslip;
};

/// The exact response at each 0.5 ms up to `end`: delta rises linearly within `ramp`.
SteppedCar step_steer(const SingleTrack& car, double v, double delta, double ramp, double end) {
  const double dt = 5e-4;
  // (beta, r, delta, delta')
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
  A.topLeftCorner<2, 2>() = car.matrix(v);
  A.block<2, 1>(0, 2) = car.input(v);
  A(2, 3) = 1.0;
  const Eigen::MatrixXd step = exponential(A * dt);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  if (ramp > 0.0)
    x[3] = delta / ramp;
  else
    x[2] = delta;
  SteppedCar out;
  for (int k = 0; k * dt < end + 0.5 * dt; ++k) {
    if (k > 0) x = step * x;
    if (ramp > 0.0 && k == std::lround(ramp / dt)) x[3] = 0.0;
    out.t.push_back(k * dt);
    out.steering.push_back(x[2]);
    out.sideslip.push_back(x[0]);
    out.yaw_rate.push_back(x[1]);
    out.ay.push_back(v * ((A * x)[0] + x[1]));
  }
  return out;
}

TEST(StepFigures, OfTheTablesOfIso7401) {
  const auto rows = vehicle_table("singletrack_step_characteristics.csv");
  ASSERT_EQ(rows.size(), 4u);
  for (const TableRow& row : rows) {
    const SingleTrack car = single_track(row.at("vehicle"));
    const double v = number(row, "v_m_s"), delta = number(row, "delta_deg") * deg;
    const double ramp = number(row, "ramp_s");
    const SteppedCar y = step_steer(car, v, delta, ramp, 4.0 - 5e-4);
    const double t_50 = *time_of_fraction(y.t, y.steering, 0.0, delta, 0.5);
    EXPECT_NEAR(t_50, number(row, "t50_delta_s"), 1e-9);
    const Eigen::Vector2d end = car.steady(v, delta);
    const StepResponse r = step_response(y.t, y.yaw_rate, 0.0, end[1], t_50);
    const StepResponse a = step_response(y.t, y.ay, 0.0, v * end[1], t_50);
    EXPECT_NEAR(r.steady / deg, number(row, "yawrate_ss_deg_s"), 2e-8);
    EXPECT_NEAR(a.steady, number(row, "ay_ss_m_s2"), 1e-8);
    EXPECT_NEAR(r.peak / deg, number(row, "yawrate_peak_deg_s"), 2e-8);
    EXPECT_NEAR(r.overshoot, number(row, "overshoot"), 1e-8);
    EXPECT_NEAR(r.peak_time, number(row, "t_yawrate_peak_from_t50_s"), 1e-3);
    EXPECT_NEAR(*r.response_time, number(row, "t_yawrate_90_from_t50_s"), 1e-3);
    EXPECT_NEAR(*a.response_time, number(row, "t_ay_90_from_t50_s"), 1e-3);
    EXPECT_NEAR(tb_value(r, end[0]), number(row, "TB_s_deg"), 1e-3);
  }
}

TEST(StepFigures, HistoriesAreThoseOfTheTable) {
  std::map<std::string, SteppedCar> cars;
  for (const TableRow& row : vehicle_table("singletrack_step.csv")) {
    const double v = number(row, "v_m_s"), delta = number(row, "delta_deg") * deg;
    const std::string key = row.at("vehicle") + row.at("v_m_s") + row.at("ramp_s");
    if (!cars.contains(key))
      cars[key] = step_steer(single_track(row.at("vehicle")), v, delta, number(row, "ramp_s"), 3.1);
    const SteppedCar& y = cars[key];
    const std::size_t k = std::lround(number(row, "t_s") / 5e-4);
    EXPECT_NEAR(y.yaw_rate[k] / deg, number(row, "yawrate_deg_s"), 2e-8);
    EXPECT_NEAR(y.ay[k], number(row, "ay_m_s2"), 1e-8);
    EXPECT_NEAR(y.sideslip[k] / deg, number(row, "beta_deg"), 1e-8);
  }
}

// A response to the right has the same figures as its mirror image, and one that never gets there
// has no response time.
TEST(StepFigures, ResponsesToEitherSide) {
  const std::vector<double> t{0.0, 0.1, 0.2, 0.3, 0.4}, y{1.0, 1.0, 3.0, 5.0, 4.0};
  std::vector<double> mirrored;
  for (const double x : y) mirrored.push_back(2.0 - x);
  const StepResponse left = step_response(t, y, 1.0, 4.0, 0.1);
  const StepResponse right = step_response(t, mirrored, 1.0, -2.0, 0.1);
  EXPECT_NEAR(left.overshoot, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(right.overshoot, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(left.peak_time, 0.2, 1e-15);
  EXPECT_NEAR(*left.response_time, 0.1 + 0.1 * 0.7 / 2.0, 1e-15);
  EXPECT_NEAR(*right.response_time, *left.response_time, 1e-15);
  EXPECT_FALSE(step_response(t, y, 1.0, 9.0, 0.1).response_time);
  EXPECT_NEAR(mean_at_end(t, y, 0.2), 0.5 * (4.0 + 4.5), 1e-14);
}

TEST(LaneGates, OfTheTableOfIso3888) {
  int compared = 0;
  for (const TableRow& row : vehicle_table("iso3888_gates.csv")) {
    if (row.at("standard") != "ISO 3888-2") continue;
    const auto gates = lane_gates(number(row, "vehicle_width_m"));
    for (const LaneGate& gate : gates) {
      if (gate.section != std::stoi(row.at("gate"))) continue;
      ++compared;
      EXPECT_NEAR(gate.begin, number(row, "x_start_m"), 1e-12);
      EXPECT_NEAR(gate.end, number(row, "x_end_m"), 1e-12);
      EXPECT_NEAR(gate.right, number(row, "y_right_m"), 1e-12);
      EXPECT_NEAR(gate.left, number(row, "y_left_m"), 1e-12);
    }
  }
  EXPECT_EQ(compared, 9);
}

TEST(LaneGates, ClearanceOfStraightAndTurnedVehicles) {
  const LaneGate gate{1, 0.0, 12.0, -1.115, 1.115};
  const VehicleOutline car{.width = 1.8, .front = 2.0, .rear = 2.5};
  EXPECT_NEAR(clearance(gate, car, 6.0, 0.0, 0.0), 0.215, 1e-14);
  EXPECT_NEAR(clearance(gate, car, 6.0, 0.1, 0.0), 0.115, 1e-14);
  EXPECT_NEAR(clearance(gate, car, 6.0, -0.3, 0.0), -0.085, 1e-14);
  EXPECT_TRUE(std::isinf(clearance(gate, car, -2.1, 0.0, 0.0)));
  EXPECT_TRUE(std::isinf(clearance(gate, car, 14.6, 0.0, 0.0)));
  // Turned by 0.05 rad to the left, the front left corner is nearest, or the rear right one.
  const double c = std::cos(0.05), s = std::sin(0.05);
  const double front = 1.115 - (2.0 * s + 0.9 * c), rear = 1.115 - (2.5 * s + 0.9 * c);
  EXPECT_NEAR(clearance(gate, car, 6.0, 0.0, 0.05), std::min(front, rear) / c, 1e-12);
}

}  // namespace
}  // namespace floatframe::test

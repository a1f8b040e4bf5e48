// Manoeuvres of the single-track model of tests/data/vehicle/single_track.yaml, whose steps are
// those of a rigid body, against the linear equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "floatframe/model/model_hash.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/vehicle/lane_change.hpp"
#include "floatframe/vehicle/lane_path.hpp"
#include "floatframe/vehicle/manoeuvre_report.hpp"
#include "floatframe/vehicle/manoeuvres.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

constexpr VehicleNeeds driven{.steering = true, .drive = true};

ModelDescription single_track_model(const std::vector<ParameterOverride>& values = {}) {
  return load_description(std::string(FLOATFRAME_TEST_DATA) + "/vehicle/single_track.yaml", values);
}

VehicleSetup single_track_setup(double speed, const std::vector<ParameterOverride>& values = {}) {
  return vehicle_setup(single_track_model(values), "step-steer", driven, speed);
}

TEST(VehicleSetup, FindsAxlesAndRadius) {
  const VehicleSetup setup = single_track_setup(20.0);
  EXPECT_NEAR(setup.axles.front, 1.2, 1e-14);
  EXPECT_NEAR(setup.axles.rear, 1.4, 1e-14);
  EXPECT_NEAR(setup.wheel_radius, 0.3, 1e-14);
  EXPECT_EQ(setup.description.simulation.velocity, Vec3(20.0, 0.0, 0.0));
}

/// Yaw rates at each millisecond by the linear equations with the quintic steering (RK4).
std::vector<Eigen::Vector2d> linear_step_steer(const SingleTrack& car, double v,
                                               const StepSteerOptions& o) {
  const double dt = 1e-3;
  const auto rate = [&](double t, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(car.matrix(v) * x +
                           car.input(v) * (o.angle * smooth_step(t - o.begin, o.ramp)));
  };
  std::vector<Eigen::Vector2d> out{Eigen::Vector2d::Zero()};
  for (int k = 0; k * dt < o.duration - 0.5 * dt; ++k) {
    const double t = k * dt;
    const Eigen::Vector2d x = out.back();
    const Eigen::Vector2d a = rate(t, x), b = rate(t + 0.5 * dt, x + 0.5 * dt * a),
                          c = rate(t + 0.5 * dt, x + 0.5 * dt * b), d = rate(t + dt, x + dt * c);
    out.push_back(x + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d));
  }
  return out;
}

// A driver who follows another path than the one straight ahead leaves the heading.
TEST(TrimmedStart, EndsWhereTheVehicleRunsAway) {
  VehicleRun run(vehicle_setup(single_track_model(), "step-steer", driven, 20.0));
  PathFollower follower(DrivenPath::straight({0.0, 1e3}, 0.5), run.axles().wheelbase());
  SpeedController controller(run.mass(), run.lowest_force(), run.highest_force());
  const std::string text = sentences_of([&] { drive_trimmed(run, follower, controller, 20.0); });
  EXPECT_TRUE(contains(text, "cannot be driven straight on at 20 m/s")) << text;
  EXPECT_LT(run.now().time, 10.0);
}

TEST(StepSteer, IsThatOfTheLinearEquations) {
  const double v = 80.0 / 3.6;
  const SingleTrack car = single_track("understeer");
  VehicleRun run(single_track_setup(v, {{"hold", "1e5"}}));
  EXPECT_NEAR(run.mass(), 1500.0, 1e-9);
  EXPECT_NEAR(run.highest_force(), 3000.0 / 0.3, 1e-9);
  const StepSteerOptions options{.speed = v, .duration = 5.0};
  const StepSteerResult r = step_steer(run, options);
  const auto linear = linear_step_steer(car, v, options);
  std::size_t peak = 0;
  for (std::size_t k = 0; k < linear.size(); ++k)
    if (linear[k][1] > linear[peak][1]) peak = k;
  const Eigen::Vector2d end = car.steady(v, options.angle);
  EXPECT_NEAR(r.t_50, 1.075, 1e-4);
  EXPECT_NEAR(r.yaw_rate.steady, end[1], 1e-4 * end[1]);
  EXPECT_NEAR(r.sideslip.steady, end[0], 2e-4 * std::abs(end[0]));
  EXPECT_NEAR(r.lateral_acceleration.steady, v * end[1], 2e-4 * v * end[1]);
  EXPECT_NEAR(r.yaw_rate.peak, linear[peak][1], 1e-4 * linear[peak][1]);
  EXPECT_NEAR(r.yaw_rate.peak_time, 1e-3 * double(peak) - 1.075, 3e-3);
  EXPECT_NEAR(r.tb, r.yaw_rate.peak_time * r.sideslip.steady * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_LT(r.first_second_yaw_rate, 1e-4 * std::numbers::pi / 180.0);
  EXPECT_LT(r.first_second_drift, 1e-4);
  EXPECT_LT(r.unsteadiness, 1e-3);
  // The record begins at zero with the rows of the model.
  EXPECT_EQ(run.table.at(0, 0), 0.0);
  EXPECT_NEAR(run.table.at(run.table.rows() - 1, 0), 5.0, 1e-9);
  EXPECT_NEAR(run.table.at(run.table.rows() - 1, run.table.column("inputs.steer")),
              16.0 * options.angle, 1e-6);
  const ManoeuvreReport report = manoeuvre_report("car", r);
  EXPECT_TRUE(contains(report.text, "ISO 7401"));
  EXPECT_TRUE(contains(report.json, "\"TB_s_deg\""));
}

// Without the force that holds the speed, the controllers reach every point; the understeer
// gradient is that of the linear model but for squares of small angles.
TEST(SteadyCircle, HasTheGradientsOfTheLinearEquations) {
  const SingleTrack car = single_track("understeer");
  const double K = number(vehicle_table("singletrack_parameters.csv")[0], "K_rad_s2_m");
  for (const bool right : {false, true}) {
    VehicleRun run(single_track_setup(std::sqrt(50.0)));
    const SteadyCircleResult r =
        steady_circle(run, {.speed = std::sqrt(300.0), .right = right, .spacing = 1.0});
    EXPECT_EQ(r.ended, "");
    ASSERT_EQ(r.points.size(), 3u);
    for (std::size_t k = 0; k < r.points.size(); ++k) {
      EXPECT_NEAR(r.points[k].lateral_acceleration, double(k + 1), 0.05 * double(k + 1));
      EXPECT_NEAR(r.points[k].radius(), 100.0, 3.0);
      EXPECT_NEAR(r.figures[k].understeer_gradient, K, 0.02 * K);
      EXPECT_NEAR(r.figures[k].sideslip_gradient, -car.m * car.a / (car.Cr * 2.6),
                  0.05 * car.m * car.a / (car.Cr * 2.6));
    }
  }
}

/// Of a path of points 1 m apart: the largest curvature, and the smallest clearance of a vehicle
/// whose heading is y' - l y''.
struct PathFigures {
  double curvature = 0.0, clearance = 1e9, squares = 0.0;
};
PathFigures figures_of(const std::vector<PathPoint>& points, const VehicleOutline& vehicle,
                       double sideslip) {
  PathFigures out;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double bend = points[k - 1].y - 2.0 * points[k].y + points[k + 1].y;
    const double slope = 0.5 * (points[k + 1].y - points[k - 1].y);
    out.curvature = std::max(out.curvature, std::abs(bend));
    out.squares += bend * bend;
    for (const LaneGate& gate : lane_gates(vehicle.width))
      out.clearance = std::min(out.clearance, clearance(gate, vehicle, points[k].x, points[k].y,
                                                        std::atan(slope - sideslip * bend)));
  }
  return out;
}

// What the conditions keep is a margin for small angles: cos(8 deg) takes a hundredth of a length.
TEST(LaneChange, PathKeepsTheMarginOfTheWholeVehicle) {
  for (const double width : {1.5, 1.8, 2.0})
    for (const double sideslip : {0.0, 1.2}) {
      const VehicleOutline vehicle{.width = width, .front = 1.9, .rear = 2.2};
      const std::vector<PathPoint> path = lane_change_path(vehicle, sideslip, 0.1);
      EXPECT_EQ(path.front().x, -20.0);
      EXPECT_EQ(path.front().y, 0.0);
      EXPECT_GT(path.back().x, 61.0 + 2.2);
      const PathFigures f = figures_of(path, vehicle, sideslip);
      EXPECT_GT(f.clearance, 0.07) << width;
      EXPECT_LT(f.curvature, 0.045) << width;
    }
}

TEST(LaneChange, PathBendsLeastWhereItTouches) {
  const VehicleOutline point{.width = 1.5, .front = 0.0, .rear = 0.0};
  const std::vector<PathPoint> path = lane_change_path(point, 0.0, 0.1);
  // Between the gates nothing holds the path: the moment w y'' = y''^3 of a beam with the stiffness
  // w = y''^2 is linear in x.
  std::vector<double> moment;
  for (std::size_t k = 1; k + 1 < path.size(); ++k)
    if (path[k].x > 13.0 && path[k].x < 24.5)
      moment.push_back(std::pow(path[k - 1].y - 2.0 * path[k].y + path[k + 1].y, 3));
  const double largest = std::max(std::abs(moment.front()), std::abs(moment.back()));
  for (std::size_t k = 1; k + 1 < moment.size(); ++k)
    EXPECT_NEAR(moment[k - 1] - 2.0 * moment[k] + moment[k + 1], 0.0, 0.1 * largest);
}

TEST(LaneChange, IsDrivenSlowly) {
  VehicleNeeds needs = driven;
  needs.width = true;
  VehicleRun run(vehicle_setup(single_track_model({{"hold", "1e5"}, {"v", "8"}}),
                               "double-lane-change", needs, 8.0));
  const LaneChangeResult r = lane_change(run, 8.0);
  EXPECT_NEAR(r.entry_speed, 8.0, 0.05);
  EXPECT_NEAR(r.exit_speed, 8.0, 0.05);
  EXPECT_GT(std::ranges::min(r.clearance), 0.0);
  EXPECT_TRUE(r.passed);
  EXPECT_TRUE(contains(manoeuvre_report("car", r).text, "ISO 3888-2"));
}

TEST(VehicleSection, DoesNotChangeTheMotion) {
  ModelDescription d = single_track_model();
  ASSERT_TRUE(d.vehicle);
  EXPECT_EQ(d.vehicle->axles[1].right.tyre, "rr");
  EXPECT_EQ(d.vehicle->steering->ratio, 16.0);
  EXPECT_EQ(d.vehicle->drive->ratio, 1.0);
  EXPECT_EQ(*d.vehicle->driver, Vec3(0.0, 0.0, 0.3));
  const Model with = build_model(d);
  ASSERT_TRUE(with.vehicle);
  EXPECT_EQ(with.vehicle->width, 1.7);
  d.vehicle.reset();
  EXPECT_EQ(model_hash(with), model_hash(build_model(d)));
}

TEST(VehicleSection, OfProgramsIsChecked) {
  const auto codes = [](const std::function<void(VehicleDescription&)>& change) {
    ModelDescription d = single_track_model();
    d.vehicle->origin = {};
    for (VehicleAxle& a : d.vehicle->axles) a.origin = {};
    d.vehicle->steering->origin = {};
    change(*d.vehicle);
    return error_of([&] { build_model(d); });
  };
  EXPECT_EQ(codes([](VehicleDescription& v) { v.chassis = "cart"; }), "vehicle.chassis: not_found");
  EXPECT_EQ(codes([](VehicleDescription& v) { v.axles[1].left.tyre = "fl"; }),
            "vehicle.axles.rear.left.tyre: duplicate");
  EXPECT_EQ(codes([](VehicleDescription& v) { v.axles.clear(); }), "vehicle.axles: missing");
  EXPECT_EQ(codes([](VehicleDescription& v) { v.steering->ratio = 0.0; }),
            "vehicle.steering.ratio: out_of_range");
  EXPECT_EQ(codes([](VehicleDescription& v) { v.width = -1.0; }), "vehicle.width: out_of_range");
}

TEST(VehicleSetup, NamesWhatAManoeuvreLacks) {
  const auto error = [](const std::function<void(ModelDescription&)>& change) {
    ModelDescription d = single_track_model();
    change(d);
    return sentences_of([&] { vehicle_setup(std::move(d), "step-steer", driven, 20.0); });
  };
  EXPECT_TRUE(contains(error([](auto& d) { d.vehicle.reset(); }), "no section 'vehicle'"));
  EXPECT_TRUE(contains(error([](auto& d) { d.vehicle->steering.reset(); }),
                       "found no 'steering', expected it for step-steer"));
  EXPECT_TRUE(contains(error([](auto& d) { d.vehicle->drive.reset(); }),
                       "found no 'drive', expected it for step-steer"));
  EXPECT_TRUE(contains(error([](auto& d) { d.vehicle->axles.pop_back(); }), "found one axle"));
  EXPECT_TRUE(contains(error([](auto& d) { std::swap(d.vehicle->axles[0], d.vehicle->axles[1]); }),
                       "behind the last one"));
}

}  // namespace
}  // namespace floatframe::test

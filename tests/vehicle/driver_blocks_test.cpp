// The elements path_follower and speed_controller against the driver of the manoeuvres, which calls
// the same laws once a step, and against a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model/model.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "floatframe/vehicle/vehicle_run.hpp"
#include "support/linear_models.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

const std::string vehicle_data = std::string(FLOATFRAME_TEST_DATA) + "/vehicle/";

std::vector<PathPoint> points_of(const ModelDescription& d) {
  const MatX& rows = std::get<PathFollowing>(d.controllers.front().kind).points;
  std::vector<PathPoint> out;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) out.push_back({rows(i, 0), rows(i, 1)});
  return out;
}

// The driver holds its angle for a step, with what it saw at the beginning: a delay of 1.5 ms of a
// motion whose lateral speed is at most 2 m/s.
TEST(PathFollowerElement, DrivesAsTheDriverOfManoeuvres) {
  const ModelDescription d =
      load_description(vehicle_data + "single_track_driven.yaml", {{"v", "15"}});
  Simulation simulation(build_model(d));
  VehicleRun run(vehicle_setup(load_description(vehicle_data + "single_track.yaml", {{"v", "15"}}),
                               "test", {.steering = true, .drive = true}, 15.0));
  const double dt = run.step_size();
  PathFollower driver(DrivenPath(points_of(d)), run.axles().wheelbase());
  double apart = 0.0, offset = 0.0;
  while (run.now().time < 6.0) {
    ASSERT_TRUE(simulation.step());
    run.step(driver.steer(run.now().view, dt), 0.0);
    apart = std::max(apart, std::abs(simulation.output("chassis.y") - run.now().view.y));
    offset = std::max(offset, std::abs(simulation.output("offset")));
  }
  std::printf("[ figure ] apart %.2e m, offset %.4f m\n", apart, offset);
  EXPECT_LT(apart, 3e-3);
  EXPECT_LT(offset, 0.15);
  EXPECT_NEAR(simulation.output("chassis.y"), -0.5, 0.02);
}

// delta = (L + K v^2)/R of the linear model; 10 m/s and K v^2 small.
TEST(PathFollowerElement, HoldsTheAngleOfACircle) {
  const double v = 10.0, radius = 50.0;
  ModelDescription d = load_description(vehicle_data + "single_track_driven.yaml", {{"v", "10"}});
  auto& follower = std::get<PathFollowing>(d.controllers.front().kind);
  follower.points = MatX();
  follower.circle = MatX{{0.0, radius, radius}};
  Simulation simulation(build_model(d));
  while (simulation.time() < 20.0) ASSERT_TRUE(simulation.step());
  // From its start at (0, 0), the lowest point of the circle, several times along it.
  const double x = simulation.output("chassis.x"), y = simulation.output("chassis.y") - radius;
  EXPECT_NEAR(std::hypot(x, y), radius, 0.02);
  const SingleTrack car = single_track("understeer");
  const double L = car.a + car.b, r = v / radius, K = car.m / L * (car.b / car.Cf - car.a / car.Cr);
  EXPECT_NEAR(simulation.output("angle"), (L + K * v * v) * r / v, 2e-2 * L / radius);
}

constexpr const char* cruising_box = R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 1200}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, velocity: 20}}
forces:
  motor: {type: joint_spring, joint: slide, actuator: {controller: cruise}}
  drag: {type: joint_spring, joint: slide, actuator: -300}
controllers:
  cruise:
    type: speed_controller
    measured: {rate: motor}
    target: 20
    mass: 1200
    lower: -2400
    upper: LIMIT
outputs: {v: {joint_velocity: slide}, F: {controller: cruise}}
simulation: {step: 0.01, duration: 5}
)";

std::string cruise_limited(const std::string& limit) {
  std::string text = cruising_box;
  return text.replace(text.find("LIMIT"), 5, limit);
}

// e = F_0/m t exp(-t), as in SpeedController.MeetsTheClosedForm
TEST(SpeedControllerElement, MeetsTheClosedForm) {
  Simulation simulation(model_of(cruise_limited("1e9")), {});
  double largest = 0.0;
  while (simulation.time() < 4.0) {
    ASSERT_TRUE(simulation.step());
    const double t = simulation.time();
    largest = std::max(largest,
                       std::abs(20.0 - simulation.output("v") - 300.0 / 1200.0 * t * std::exp(-t)));
  }
  EXPECT_LT(largest, 5e-6);
}

// The drag is greater than the limit: the force reaches it and stays there.
TEST(SpeedControllerElement, DoesNotWindUp) {
  Simulation simulation(model_of(cruise_limited("200")), {});
  for (int k = 0; k < 400; ++k) {
    ASSERT_TRUE(simulation.step());
    ASSERT_LE(simulation.output("F"), 200.0 * (1.0 + 1e-12));
  }
  EXPECT_NEAR(simulation.output("F"), 200.0, 1e-9);
}

}  // namespace
}  // namespace floatframe::test

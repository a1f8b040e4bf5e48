// The path follower on the linear single-track models of tests/data/vehicle, and the speed
// controller on a mass.
#include "floatframe/vehicle/driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

const std::vector<std::string> driven_cars{"understeer", "neutral", "oversteer"};

/// Of (y, psi, beta, r, z) beside the straight path y = 0, z the integral of v kappa_d - r.
Eigen::MatrixXd closed_loop(const SingleTrack& car, double v, const PreviewGains& g) {
  const double d = std::max(v * g.preview_time, g.least_distance), L = car.a + car.b;
  Eigen::RowVectorXd curvature(5), missing(5);
  curvature << -2.0 / (d * d), -2.0 / d, 0.0, 0.0, 0.0;
  missing = v * curvature;
  missing[3] -= 1.0;
  Eigen::RowVectorXd delta = L * curvature + g.yaw_rate * missing;
  delta[4] += g.yaw_rate_integral;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(5, 5);
  A(0, 1) = A(0, 2) = v;
  A(1, 3) = 1.0;
  A.block<2, 2>(2, 2) = car.matrix(v);
  A.middleRows(2, 2) += car.input(v) * delta;
  A.row(4) = missing;
  return A;
}

// The only state at rest is zero, so that all five modes decay.
TEST(PathFollower, IsStableFrom5To40MetresPerSecond) {
  double slowest = -1e9, damping = 1.0;
  for (const std::string& name : driven_cars)
    for (int k = 10; k <= 80; ++k) {
      const GeneralEigen modes =
          general_eigen(closed_loop(single_track(name), 0.5 * k, PreviewGains{}));
      ASSERT_TRUE(modes.found);
      for (const std::complex<double> s : modes.values) {
        slowest = std::max(slowest, s.real());
        if (std::abs(s.imag()) > 1e-6) damping = std::min(damping, -s.real() / std::abs(s));
      }
    }
  std::printf("[ figure ] slowest mode %.4f 1/s, least damping ratio %.4f\n", slowest, damping);
  EXPECT_LT(slowest, -0.5);
  EXPECT_GT(damping, 0.37);
}

struct DrivenCar {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(5);  ///< x, y, psi, beta, r
  double t = 0.0;

  /// With the angle held for one step.
  void step(const SingleTrack& car, double v, double delta, double dt) {
    const auto rate = [&](const Eigen::VectorXd& s) {
      Eigen::VectorXd out(5);
      const double course = s[2] + s[3];
      out << v * std::cos(course), v * std::sin(course), s[4],
          car.matrix(v) * s.tail<2>() + car.input(v) * delta;
      return out;
    };
    const Eigen::VectorXd a = rate(x), b = rate(x + 0.5 * dt * a), c = rate(x + 0.5 * dt * b),
                          d = rate(x + dt * c);
    x += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    t += dt;
  }
  DriverView view(double v) const { return {x[0], x[1], x[2], v, x[4]}; }
};

TEST(PathFollower, ReturnsToAStraightPath) {
  for (const std::string& name : driven_cars)
    for (const double v : {5.0, 15.0, 40.0}) {
      const SingleTrack car = single_track(name);
      PathFollower driver(straight_path({0.0, 1.0}, 0.0), car.a + car.b);
      DrivenCar driven;
      while (driven.t < 30.0) driven.step(car, v, driver.steer(driven.view(v), 1e-2), 1e-2);
      EXPECT_NEAR(driven.x[1], 1.0, 1e-4) << name << " at " << v;
      EXPECT_NEAR(driven.x[4], 0.0, 1e-4);
    }
}

// The curvature that is driven is that of the circle through the steady position: e = d beta away
// from the path, to first order.
TEST(PathFollower, DrivesCirclesToEitherSide) {
  const SingleTrack car = single_track("understeer");
  for (const double radius : {100.0, -100.0}) {
    PathFollower driver(circle_path({}, 0.0, radius), car.a + car.b);
    DrivenCar driven;
    const double v = 20.0;
    while (driven.t < 60.0) driven.step(car, v, driver.steer(driven.view(v), 5e-3), 5e-3);
    const double yaw_rate = driven.x[4], driven_radius = v / yaw_rate;
    EXPECT_NEAR(driven_radius / radius, 1.0, 0.02);
    const double distance = std::hypot(driven.x[0], driven.x[1] - radius);
    EXPECT_NEAR(distance, std::abs(driven_radius), 1e-2);
  }
}

TEST(PathFollower, OffsetIsPositiveToTheRightOfThePath) {
  PathFollower driver(straight_path({1.0, 2.0}, std::numbers::pi / 2), 2.5);
  EXPECT_NEAR(driver.offset(1.5, 40.0), 0.5, 1e-14);
  EXPECT_NEAR(driver.offset(0.5, -3.0), -0.5, 1e-14);
  PathFollower circle(circle_path({0.0, 0.0}, 0.0, 50.0), 2.5);
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.02 * k;  // more than three turns
    EXPECT_NEAR(circle.offset(49.0 * std::sin(angle), 50.0 - 49.0 * std::cos(angle)), -1.0, 1e-4);
  }
}

// m v' = F - F_0 with the error e = v_d - v and F_0 switched on at t = 0:
//   e'' + 2 e' + e = 0, e(0) = 0, e'(0) = F_0/m: e = F_0/m t exp(-t)
TEST(SpeedController, MeetsTheClosedForm) {
  const double m = 1200.0, resistance = 300.0, dt = 1e-4;
  SpeedController controller(m, -1e9, 1e9);
  double v = 20.0, t = 0.0, largest = 0.0;
  while (t < 12.0) {
    v += dt * (controller.force(20.0, v, dt) - resistance) / m;
    t += dt;
    largest = std::max(largest, std::abs(20.0 - v - resistance / m * t * std::exp(-t)));
  }
  EXPECT_LT(largest, 2e-5);
  EXPECT_NEAR(v, 20.0, 1e-4);
}

// From standstill with a tenth of a second's force: without wind-up there is nearly no overshoot.
TEST(SpeedController, DoesNotWindUpAtItsLimits) {
  const double m = 1200.0, dt = 1e-3;
  SpeedController controller(m, 0.0, 2400.0);
  double v = 0.0, highest = 0.0;
  for (int k = 0; k < 40000; ++k) {
    const double force = controller.force(20.0, v, dt);
    ASSERT_GE(force, 0.0);
    ASSERT_LE(force, 2400.0);
    v += dt * (force - 100.0) / m;
    highest = std::max(highest, v);
  }
  EXPECT_NEAR(v, 20.0, 1e-4);
  EXPECT_LT(highest, 20.3);
}

}  // namespace
}  // namespace floatframe::test

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

/// Of (y, psi, beta, r, z) and the lateral forces of both axles, which follow within the relaxation
/// length, beside the straight path y = 0: by differences of the law itself.
Eigen::MatrixXd closed_loop(const SingleTrack& car, double v, double relaxation) {
  const DrivenPath path = DrivenPath::straight({}, 0.0);
  const auto rate = [&](const Eigen::VectorXd& x) {
    const double course = x[1] + x[2];
    const PathView<double> view{0.0, x[0], v * std::cos(course), v * std::sin(course), x[3]};
    const PathAnswer<double> answer =
        path_answer(path, PathGains{}, car.a + car.b, 0.0, view, x[4]);
    const double front = car.Cf * (answer.angle - x[2] - car.a * x[3] / v),
                 rear = car.Cr * (car.b * x[3] / v - x[2]);
    const bool relaxes = relaxation > 0.0;
    const double F = relaxes ? x[5] : front, R = relaxes ? x[6] : rear;
    Eigen::VectorXd out(7);
    out << v * std::sin(course), x[3], (F + R) / (car.m * v) - x[3],
        (car.a * F - car.b * R) / car.I, answer.flow,
        relaxes ? v / relaxation * (front - F) : -v * x[5],
        relaxes ? v / relaxation * (rear - R) : -v * x[6];
    return out;
  };
  Eigen::MatrixXd A(7, 7);
  const double h = 1e-4;
  for (int k = 0; k < 7; ++k) {
    const double step = k < 5 ? h : 1.0;  // forces are linear
    const Eigen::VectorXd d = step * Eigen::VectorXd::Unit(7, k);
    A.col(k) = (rate(d) - rate(-d)) / (2.0 * step);
  }
  return A;
}

struct LeastDamped {
  double slowest = -1e9, damping = 1.0;
};
LeastDamped least_damped(double relaxation) {
  LeastDamped out;
  for (const std::string& name : driven_cars)
    for (int k = 10; k <= 80; ++k) {
      const GeneralEigen modes =
          general_eigen(closed_loop(single_track(name), 0.5 * k, relaxation));
      EXPECT_TRUE(modes.found);
      for (const std::complex<double> s : modes.values) {
        out.slowest = std::max(out.slowest, s.real());
        if (std::abs(s.imag()) > 1e-6) out.damping = std::min(out.damping, -s.real() / std::abs(s));
      }
    }
  std::printf("[ figure ] slowest mode %.4f 1/s, least damping ratio %.4f\n", out.slowest,
              out.damping);
  return out;
}

// The only state at rest is zero, so that all modes decay.
TEST(PathFollower, IsStableFrom5To40MetresPerSecond) {
  const LeastDamped stiff = least_damped(0.0), soft = least_damped(0.5);
  EXPECT_LT(stiff.slowest, -0.5);
  EXPECT_GT(stiff.damping, 0.37);
  EXPECT_LT(soft.slowest, -0.5);
  EXPECT_GT(soft.damping, 0.2);
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
  DriverView view(double v) const {
    return {x[0], x[1], x[2], v * std::cos(x[3]), x[4], v * std::sin(x[3])};
  }
};

TEST(PathFollower, ReturnsToAStraightPath) {
  for (const std::string& name : driven_cars)
    for (const double v : {5.0, 15.0, 40.0}) {
      const SingleTrack car = single_track(name);
      PathFollower driver(DrivenPath::straight({0.0, 1.0}, 0.0), car.a + car.b);
      DrivenCar driven;
      while (driven.t < 30.0) driven.step(car, v, driver.steer(driven.view(v), 1e-2), 1e-2);
      EXPECT_NEAR(driven.x[1], 1.0, 1e-4) << name << " at " << v;
      EXPECT_NEAR(driven.x[4], 0.0, 1e-4);
    }
}

// At rest beside the circle the integral holds the yaw rate at v kappa, and so the offset at zero.
TEST(PathFollower, DrivesCirclesToEitherSide) {
  const SingleTrack car = single_track("understeer");
  for (const double radius : {100.0, -100.0}) {
    PathFollower driver(DrivenPath::circle({}, 0.0, radius), car.a + car.b);
    DrivenCar driven;
    const double v = 20.0;
    while (driven.t < 60.0) driven.step(car, v, driver.steer(driven.view(v), 5e-3), 5e-3);
    EXPECT_NEAR(v / driven.x[4] / radius, 1.0, 2e-4);
    EXPECT_NEAR(std::hypot(driven.x[0], driven.x[1] - radius), 100.0, 2e-2);
  }
}

// A double bend y = 2 sin^2(pi s / 60 m) at 15 m/s: the path is driven, not the chord.
TEST(PathFollower, CutsNoCorners) {
  for (const std::string& name : driven_cars) {
    const SingleTrack car = single_track(name);
    std::vector<PathPoint> points;
    for (int k = -10; k <= 100; ++k) {
      const double x = 1.0 * k, wave = std::sin(std::numbers::pi * std::clamp(x, 0.0, 60.0) / 60.0);
      points.push_back({x, 2.0 * wave * wave});
    }
    const DrivenPath path(points);
    PathFollower driver(path, car.a + car.b), judge(path, 1.0);
    DrivenCar driven;
    driven.x[0] = -10.0;
    double largest = 0.0;
    while (driven.x[0] < 80.0) {
      driven.step(car, 15.0, driver.steer(driven.view(15.0), 5e-3), 5e-3);
      largest = std::max(largest, std::abs(judge.offset(driven.x[0], driven.x[1])));
    }
    std::printf("[ figure ] offset %.4f m\n", largest);
    EXPECT_LT(largest, 0.1) << name;
  }
}

TEST(PathFollower, OffsetIsPositiveToTheRightOfThePath) {
  PathFollower driver(DrivenPath::straight({1.0, 2.0}, std::numbers::pi / 2), 2.5);
  EXPECT_NEAR(driver.offset(1.5, 40.0), 0.5, 1e-14);
  EXPECT_NEAR(driver.offset(0.5, -3.0), -0.5, 1e-14);
  PathFollower circle(DrivenPath::circle({0.0, 0.0}, 0.0, 50.0), 2.5);
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

#include "floatframe/vehicle/driver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace floatframe {

PathFollower::PathFollower(DrivenPath path, double wheelbase, const PathGains& gains)
    : path_(std::move(path)), wheelbase_(wheelbase), gains_(gains) {}

void PathFollower::follow(DrivenPath path) {
  path_ = std::move(path);
  at_ = 0.0;
}

double PathFollower::offset(double x, double y) noexcept {
  at_ = path_.foot(at_, x, y);
  const DrivenPath::Value c = path_.at(at_);
  return (c.dx * (c.y - y) - c.dy * (c.x - x)) / std::hypot(c.dx, c.dy);
}

double PathFollower::steer(const DriverView& view, double dt) noexcept {
  const double c = std::cos(view.yaw), s = std::sin(view.yaw);
  const PathView<double> seen{.x = view.x,
                              .y = view.y,
                              .vx = c * view.speed - s * view.lateral,
                              .vy = s * view.speed + c * view.lateral,
                              .yaw_rate = view.yaw_rate};
  const PathAnswer<double> answer = path_answer(path_, gains_, wheelbase_, at_, seen, integral_);
  at_ = answer.s;
  const double limited = std::clamp(answer.angle, -gains_.largest_angle, gains_.largest_angle);
  if (!winds_up(answer.angle, limited, answer.flow)) integral_ += answer.flow * dt;
  return limited;
}

SpeedController::SpeedController(double mass, double low, double high, const SpeedGains& gains)
    : mass_(mass), low_(low), high_(high), gains_(gains) {}

double SpeedController::force(double target, double speed, double dt) noexcept {
  const SpeedAnswer<double> answer = speed_answer(gains_, mass_, target - speed, integral_);
  const double limited = std::clamp(answer.force, low_, high_);
  if (!winds_up(answer.force, limited, answer.flow)) integral_ += answer.flow * dt;
  return limited;
}

}  // namespace floatframe

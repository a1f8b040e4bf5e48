#include "floatframe/vehicle/driver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace floatframe {

DrivenPath circle_path(const PathPoint& begin, double heading, double radius, double spacing) {
  const double turn = 2.0 * std::numbers::pi;
  const int n = std::max(16, int(turn * std::abs(radius) / spacing));
  // The centre is `radius` to the left of the beginning.
  const double cx = begin.x - radius * std::sin(heading), cy = begin.y + radius * std::cos(heading);
  DrivenPath out{.points = {}, .closed = true};
  for (int k = 0; k < n; ++k) {
    const double angle = heading + (radius > 0.0 ? turn : -turn) * k / n;
    out.points.push_back({cx + radius * std::sin(angle), cy - radius * std::cos(angle)});
  }
  return out;
}

DrivenPath straight_path(const PathPoint& from, double heading) {
  return {.points = {from, {from.x + std::cos(heading), from.y + std::sin(heading)}}};
}

PathFollower::PathFollower(DrivenPath path, double wheelbase, const PreviewGains& gains)
    : wheelbase_(wheelbase), gains_(gains) {
  follow(std::move(path));
}

void PathFollower::follow(DrivenPath path) {
  const std::size_t n = path.points.size();
  assert(n >= 2);
  closed_ = path.closed;
  at_ = 0;
  sides_.clear();
  for (std::size_t k = 0; k + (closed_ ? 0 : 1) < n; ++k) {
    const PathPoint &a = path.points[k], &b = path.points[(k + 1) % n];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    sides_.push_back({a.x, a.y, (b.x - a.x) / length, (b.y - a.y) / length, length});
  }
}

/// The square of the distance from a side; an open path goes on straight at its ends.
double PathFollower::distance2(std::size_t k, double x, double y) const noexcept {
  const Side& s = sides_[k];
  const double dx = x - s.x, dy = y - s.y, along = s.cx * dx + s.cy * dy;
  const bool first = !closed_ && k == 0, last = !closed_ && k + 1 == sides_.size();
  const double low = first ? std::min(along, 0.0) : 0.0;
  const double high = last ? std::max(along, s.length) : s.length;
  const double behind = along - std::clamp(along, low, high), beside = s.cx * dy - s.cy * dx;
  return behind * behind + beside * beside;
}

double PathFollower::offset(double x, double y) noexcept {
  // Forwards as long as the next side is not farther: each side is passed once in a turn.
  for (std::size_t looked = 1; looked < sides_.size(); ++looked) {
    const std::size_t next = at_ + 1 < sides_.size() ? at_ + 1 : 0;
    if (next == 0 && !closed_) break;
    if (distance2(next, x, y) > distance2(at_, x, y)) break;
    at_ = next;
  }
  const Side& s = sides_[at_];
  return s.cy * (x - s.x) - s.cx * (y - s.y);
}

double PathFollower::steer(const DriverView& view, double dt) noexcept {
  const double d = std::max(view.speed * gains_.preview_time, gains_.least_distance);
  const double e = offset(view.x + d * std::cos(view.yaw), view.y + d * std::sin(view.yaw));
  const double curvature = 2.0 * e / (d * d);
  const double missing = view.speed * curvature - view.yaw_rate;
  const double largest = gains_.largest_angle;
  const double angle = wheelbase_ * curvature + gains_.yaw_rate * missing + integral_;
  const double limited = std::clamp(angle, -largest, largest);
  if (angle == limited || (angle > limited) != (missing > 0.0))
    integral_ += gains_.yaw_rate_integral * missing * dt;
  return limited;
}

SpeedController::SpeedController(double mass, double low, double high, const SpeedGains& gains)
    : mass_(mass), low_(low), high_(high), gains_(gains) {}

double SpeedController::force(double target, double speed, double dt) noexcept {
  const double error = target - speed;
  const double force = mass_ * (gains_.proportional * error + integral_);
  const double limited = std::clamp(force, low_, high_);
  if (force == limited || (force > limited) != (error > 0.0))
    integral_ += gains_.integral * error * dt;
  return limited;
}

}  // namespace floatframe

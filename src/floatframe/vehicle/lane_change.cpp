#include "floatframe/vehicle/lane_change.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floatframe/loops/run_error.hpp"

namespace floatframe {

// With the second derivatives M_k and h_k = x_{k+1} - x_k, continuity of the slope at inner knots:
//   h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 (s_k - s_{k-1}),  s_k = dy_k/h_k
// and at the first knot 2 h_0 M_0 + h_0 M_1 = 6 s_0; M_n = 0. Solved from the first row downwards.
std::vector<double> spline_curvatures(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() == y.size() && x.size() >= 2);
  const std::size_t n = x.size();
  std::vector<double> upper(n, 0.0), M(n, 0.0);
  double slope_before = 0.0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double h = x[k + 1] - x[k], slope = (y[k + 1] - y[k]) / h;
    const double below = k > 0 ? x[k] - x[k - 1] : 0.0;
    const double pivot = 2.0 * (below + h) - (k > 0 ? below * upper[k - 1] : 0.0);
    upper[k] = h / pivot;
    M[k] = (6.0 * (slope - slope_before) - (k > 0 ? below * M[k - 1] : 0.0)) / pivot;
    slope_before = slope;
  }
  for (std::size_t k = n - 1; k-- > 0;) M[k] -= upper[k] * M[k + 1];
  return M;
}

namespace {

struct LaneKnots {
  std::vector<double> x, y;
};

LaneKnots lane_knots(double width) {
  const auto [first, second, third] = lane_gates(width);
  const auto margin = [&](const LaneGate& g) {
    return 0.5 * width + std::min(0.1, 0.25 * (g.left - g.right - width));
  };
  const double over = second.right + margin(second);
  return {{first.begin, first.end, second.begin, second.end, third.begin, third.end},
          {0.0, first.left - margin(first), over, over, third.left - margin(third),
           0.5 * (third.left + third.right)}};
}

}  // namespace

std::vector<PathPoint> lane_change_path(double width, double spacing) {
  const LaneKnots knots = lane_knots(width);
  const std::vector<double> M = spline_curvatures(knots.x, knots.y);
  const double end = knots.x.back();
  const int n = std::max(2, int(std::ceil(end / spacing)));
  std::vector<PathPoint> out;
  for (int i = 0; i <= n; ++i) {
    const double x = end * i / n;
    std::size_t k = 0;
    while (k + 2 < knots.x.size() && x > knots.x[k + 1]) ++k;
    const double h = knots.x[k + 1] - knots.x[k], a = (knots.x[k + 1] - x) / h, b = 1.0 - a;
    out.push_back({x, a * knots.y[k] + b * knots.y[k + 1] +
                          ((a * a * a - a) * M[k] + (b * b * b - b) * M[k + 1]) * h * h / 6.0});
  }
  return out;
}

namespace {

constexpr double lead = 20.0;     // from the trimmed start to the entry [m]
constexpr double released = 2.0;  // of the drive, after the entry [m]
constexpr double longest = 30.0;  // [s]

/// The axes of the track: x along the heading at the start, the entry `lead` ahead.
struct TrackFrame {
  double x, y, c, s, yaw;
  explicit TrackFrame(const DriverView& v)
      : x(v.x + lead * std::cos(v.yaw)),
        y(v.y + lead * std::sin(v.yaw)),
        c(std::cos(v.yaw)),
        s(std::sin(v.yaw)),
        yaw(v.yaw) {}
  PathPoint world(const PathPoint& p) const {
    return {x + c * p.x - s * p.y, y + s * p.x + c * p.y};
  }
  PathPoint local(double px, double py) const {
    return {c * (px - x) + s * (py - y), c * (py - y) - s * (px - x)};
  }
};

void note_largest(LaneChangeResult& out, const VehicleInstant& now) {
  const auto larger = [](double& most, double value) { most = std::max(most, std::abs(value)); };
  larger(out.largest_lateral_acceleration, now.lateral_acceleration);
  larger(out.largest_yaw_rate, now.view.yaw_rate);
  larger(out.largest_steering, now.steering);
  larger(out.largest_sideslip, now.sideslip);
}

}  // namespace

LaneChangeResult lane_change(VehicleRun& run, double speed) {
  const VehicleDescription& vehicle = run.vehicle();
  const DriverView first = run.now().view;
  PathFollower follower(straight_path({first.x, first.y}, first.yaw), run.axles().wheelbase());
  SpeedController controller(run.mass(), run.lowest_force(), run.highest_force());
  drive_trimmed(run, follower, controller, speed);
  const TrackFrame track(run.now().view);
  DrivenPath path{.points = {track.world({-lead, 0.0})}};
  for (const PathPoint& p : lane_change_path(vehicle.width)) path.points.push_back(track.world(p));
  follower.follow(std::move(path));

  LaneChangeResult out;
  out.gates = lane_gates(vehicle.width);
  out.clearance.fill(std::numeric_limits<double>::infinity());
  const VehicleOutline outline{
      .width = vehicle.width, .front = vehicle.front, .rear = vehicle.rear};
  const double dt = run.step_size(), end = out.gates.back().end;
  double x = -lead;
  while (x - outline.rear < end) {
    if (run.now().time > longest)
      throw RunError(ErrorCode::step_failed, "the vehicle does not reach the end of the track");
    const DriverView& view = run.now().view;
    const double angle = follower.steer(view, dt);
    run.step(angle, x < released ? controller.force(speed, view.speed, dt) : 0.0);
    const VehicleInstant& now = run.now();
    const PathPoint at = track.local(now.view.x, now.view.y);
    if (x < 0.0 && at.x >= 0.0) out.entry_speed = now.path_speed;
    if (x < end && at.x >= end) out.exit_speed = now.path_speed;
    x = at.x;
    note_largest(out, now);
    for (std::size_t k = 0; k < out.gates.size(); ++k)
      out.clearance[k] = std::min(
          out.clearance[k], clearance(out.gates[k], outline, at.x, at.y, now.view.yaw - track.yaw));
  }
  out.passed = std::ranges::min(out.clearance) > 0.0;
  return out;
}

}  // namespace floatframe

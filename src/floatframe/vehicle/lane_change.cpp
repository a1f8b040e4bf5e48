#include "floatframe/vehicle/lane_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/vehicle/lane_path.hpp"

namespace floatframe {

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

/// l of beta = l kappa: that of the rear axle at low speeds, none from 15 m/s on, where the rear
/// slip angle makes up for it (docs/vehicle.md).
double sideslip_length(double rear, double speed) {
  constexpr double along_the_path = 15.0;  // [m/s]
  const double part = speed / along_the_path;
  return std::max(0.0, rear * (1.0 - part * part));
}

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
  PathFollower follower(DrivenPath::straight({first.x, first.y}, first.yaw),
                        run.axles().wheelbase());
  SpeedController controller(run.mass(), run.lowest_force(), run.highest_force());
  drive_trimmed(run, follower, controller, speed);
  const TrackFrame track(run.now().view);
  const VehicleOutline outline{
      .width = vehicle.width, .front = vehicle.front, .rear = vehicle.rear};
  std::vector<PathPoint> points =
      lane_change_path(outline, sideslip_length(run.axles().rear, speed));
  for (PathPoint& p : points) p = track.world(p);
  follower.follow(DrivenPath(points));

  LaneChangeResult out;
  out.gates = lane_gates(vehicle.width);
  out.clearance.fill(std::numeric_limits<double>::infinity());
  const double dt = run.step_size(), end = out.gates.back().end;
  double x = -lead;
  while (x - outline.rear < end) {
    if (run.now().time > longest)
      throw RunError(ErrorCode::step_failed, "the vehicle does not reach the end of the track");
    const DriverView& view = run.now().view;
    const double angle = follower.steer(view, dt);
    tell_progress("lane change", (x + lead) / (end + outline.rear + lead));
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

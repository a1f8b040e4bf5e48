#include "floatframe/vehicle/straight_stop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/vehicle/manoeuvres.hpp"

namespace floatframe {
namespace {

constexpr double standing = 0.01;  // [m/s]

/// The distance at which the speed falls through a value, between two steps: v^2 is linear in s
/// where the deceleration is constant.
struct PassedSpeed {
  double value;
  double distance = -1.0;  ///< negative: not yet

  void look(double v_before, double s_before, double v, double s) {
    if (distance >= 0.0 || v > value) return;
    const double fall = v_before * v_before - v * v;
    const double part = fall > 0.0 ? (v_before * v_before - value * value) / fall : 1.0;
    distance = s_before + part * (s - s_before);
  }
};

}  // namespace

StraightStopResult straight_stop(VehicleRun& run, const StraightStopOptions& o) {
  const DriverView first = run.now().view;
  PathFollower follower(DrivenPath::straight({first.x, first.y}, first.yaw),
                        run.axles().wheelbase());
  SpeedController controller(run.mass(), run.lowest_force(), run.highest_force());
  const TrimmedInputs trim = drive_trimmed(run, follower, controller, o.speed);
  const DriverView begin = run.now().view;
  const double c = std::cos(begin.yaw), s = std::sin(begin.yaw);
  const double braking = std::min(o.torque / run.wheel_radius(), run.highest_braking());
  StraightStopResult out{.speed = begin.speed, .torque = braking * run.wheel_radius()};
  PassedSpeed fast{0.8 * out.speed}, slow{0.1 * out.speed};
  double v = out.speed;
  while (v > standing) {
    tell_progress("stop", 1.0 - v / out.speed);
    if (run.now().time > o.longest)
      throw RunError(ErrorCode::step_failed,
                     fmt::format("the vehicle does not stop: after {:g} s it drives {:.4g} m/s "
                                 "with a brake torque of {:.5g} N m",
                                 o.longest, v, out.torque));
    // The drive is released: its force is zero, or its lower limit if that is above.
    const double t = run.now().time + run.step_size();
    run.step(trim.steering, std::max(0.0, run.lowest_drive()), braking * smooth_step(t, o.rise));
    const DriverView& now = run.now().view;
    const double along = c * (now.x - begin.x) + s * (now.y - begin.y);
    for (PassedSpeed* p : {&fast, &slow}) p->look(v, out.distance, now.speed, along);
    v = now.speed;
    out.distance = along;
    out.offset = std::max(out.offset, std::abs(c * (now.y - begin.y) - s * (now.x - begin.x)));
    out.turned = std::max(out.turned, std::abs(now.yaw - begin.yaw));
  }
  out.duration = run.now().time;
  out.deceleration =
      (fast.value * fast.value - slow.value * slow.value) / (2.0 * (slow.distance - fast.distance));
  return out;
}

}  // namespace floatframe

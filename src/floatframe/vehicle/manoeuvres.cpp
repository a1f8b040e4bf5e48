#include "floatframe/vehicle/manoeuvres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "floatframe/core/work_progress.hpp"

namespace floatframe {

double smooth_step(double t, double duration) noexcept {
  if (t <= 0.0) return 0.0;
  if (t >= duration) return 1.0;
  const double s = t / duration;
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

namespace {

PathFollower straight_on(const VehicleRun& run) {
  const DriverView& v = run.now().view;
  return PathFollower(DrivenPath::straight({v.x, v.y}, v.yaw), run.axles().wheelbase());
}

SpeedController speed_controller(const VehicleRun& run) {
  return SpeedController(run.mass(), run.lowest_force(), run.highest_force());
}

struct SteppedHistory {
  std::vector<double> t, steering, yaw_rate, ay, sideslip, roll;
  void add(const VehicleInstant& now) {
    t.push_back(now.time);
    steering.push_back(now.steering);
    yaw_rate.push_back(now.view.yaw_rate);
    ay.push_back(now.lateral_acceleration);
    sideslip.push_back(now.sideslip);
    roll.push_back(now.roll);
  }
};

}  // namespace

namespace {

/// From the trimmed start on, with the angle of the options.
StepSteerResult steered(VehicleRun& run, const TrimmedInputs& trim, const StepSteerOptions& o) {
  StepSteerResult out;
  out.speed = run.now().view.speed;
  SteppedHistory h;
  h.add(run.now());
  while (run.now().time < o.duration - 0.5 * run.step_size()) {
    tell_progress("step steer", run.now().time / o.duration);
    // The angle of the step is that at its end: the input is constant during it.
    const double t = run.now().time + run.step_size();
    run.step(trim.steering + o.angle * smooth_step(t - o.begin, o.ramp), trim.force);
    h.add(run.now());
    if (t > o.begin) continue;
    out.first_second_yaw_rate =
        std::max(out.first_second_yaw_rate, std::abs(run.now().view.yaw_rate));
    out.first_second_drift =
        std::max(out.first_second_drift, std::abs(run.now().view.speed - out.speed));
  }
  h.steering.front() = trim.steering;
  out.end_speed = run.now().view.speed;
  out.steering = o.angle;
  const double end = trim.steering + o.angle;
  out.t_50 = time_of_fraction(h.t, h.steering, trim.steering, end, 0.5).value_or(o.begin);
  const auto response = [&](const std::vector<double>& y) {
    return step_response(h.t, y, y.front(), mean_at_end(h.t, y, o.window), out.t_50);
  };
  out.yaw_rate = response(h.yaw_rate);
  out.lateral_acceleration = response(h.ay);
  out.sideslip = response(h.sideslip);
  out.roll = response(h.roll);
  out.tb = tb_value(out.yaw_rate, out.sideslip.steady);
  const auto from = std::ranges::lower_bound(h.t, o.duration - o.window) - h.t.begin();
  const auto [low, high] = std::minmax_element(h.yaw_rate.begin() + from, h.yaw_rate.end());
  out.unsteadiness = (*high - *low) / std::max(std::abs(out.yaw_rate.steady), 1e-12);
  return out;
}

/// The angle of the next run: the secant through the last two, within limits of a road wheel.
double next_angle(double asked, const StepSteerResult& last, const StepSteerResult& before) {
  constexpr double most = 40.0 * std::numbers::pi / 180.0;
  const double gain = (last.lateral_acceleration.steady - before.lateral_acceleration.steady) /
                      (last.steering - before.steering);
  const double sign = asked < 0.0 ? -1.0 : 1.0;
  if (!(gain > 0.0)) return sign * std::min(most, 1.5 * std::abs(last.steering));
  const double angle = last.steering + (asked - last.lateral_acceleration.steady) / gain;
  return sign * std::clamp(sign * angle, 0.1 * std::abs(last.steering), most);
}

}  // namespace

StepSteerResult step_steer(VehicleRun& run, const StepSteerOptions& o) {
  constexpr int most_runs = 3;
  PathFollower follower = straight_on(run);
  SpeedController controller = speed_controller(run);
  const TrimmedInputs trim = drive_trimmed(run, follower, controller, o.speed);
  if (!o.lateral_acceleration) return steered(run, trim, o);
  const double asked = *o.lateral_acceleration;
  const SimulationState start = run.save();
  StepSteerOptions at = o;
  at.angle = asked * run.axles().wheelbase() / (o.speed * o.speed);
  StepSteerResult before, out;
  for (int k = 1;; ++k) {
    out = steered(run, trim, at);
    out.asked = asked;
    out.runs = k;
    const double miss = out.lateral_acceleration.steady - asked;
    if (k == most_runs || std::abs(miss) < step_steer_miss * std::abs(asked)) return out;
    at.angle = next_angle(asked, out, before);
    before = out;
    run.restore(start);
    run.begin_record();
  }
}

namespace {

constexpr double circle_window = 1.0, circle_wait = 30.0;  // [s]
constexpr double circle_steady = 1e-4;  // of the yaw rate and the speed within the window

/// Sums over the steps of the window.
struct CircleMean {
  CirclePoint sum;
  double low_rate = 1e9, high_rate = -1e9, low_speed = 1e9, high_speed = -1e9;
  double time = 0.0;
  long count = 0;

  void add(const VehicleInstant& now, double sign, double dt) {
    const double rate = sign * now.view.yaw_rate;
    sum.speed += now.path_speed;
    sum.yaw_rate += rate;
    sum.lateral_acceleration += sign * now.lateral_acceleration;
    sum.steering += sign * now.steering;
    sum.sideslip += sign * now.sideslip;
    sum.roll += sign * now.roll;
    low_rate = std::min(low_rate, rate);
    high_rate = std::max(high_rate, rate);
    low_speed = std::min(low_speed, now.path_speed);
    high_speed = std::max(high_speed, now.path_speed);
    time += dt;
    ++count;
  }
  bool steady() const {
    return high_rate - low_rate < circle_steady * std::abs(high_rate) &&
           high_speed - low_speed < circle_steady * high_speed;
  }
  CirclePoint mean() const {
    const double n = double(count);
    return {.speed = sum.speed / n,
            .yaw_rate = sum.yaw_rate / n,
            .lateral_acceleration = sum.lateral_acceleration / n,
            .steering = sum.steering / n,
            .sideslip = sum.sideslip / n,
            .roll = sum.roll / n};
  }
};

/// Drives until a whole window is steady at `target`; nullopt if that does not come.
std::optional<CirclePoint> steady_point(VehicleRun& run, PathFollower& follower,
                                        SpeedController& controller, double from, double target,
                                        const SteadyCircleOptions& o) {
  const double dt = run.step_size(), sign = o.right ? -1.0 : 1.0;
  const double rise = std::abs(target - from) / o.acceleration;
  CircleMean window;
  for (double t = 0.0; t < rise + circle_wait; t += dt) {
    const double wanted = t < rise ? from + (target - from) * t / rise : target;
    const DriverView& view = run.now().view;
    const double force = controller.force(wanted, view.speed, dt);
    run.step(follower.steer(view, dt), force);
    if (t < rise) continue;
    window.add(run.now(), sign, dt);
    if (window.time < circle_window) continue;
    const CirclePoint mean = window.mean();
    if (window.steady() && std::abs(mean.speed - target) < 0.01 * target) return mean;
    window = {};
  }
  return std::nullopt;
}

}  // namespace

double first_speed(const SteadyCircleOptions& o) {
  return std::min(o.speed, std::sqrt(o.spacing * o.radius));
}

SteadyCircleResult steady_circle(VehicleRun& run, const SteadyCircleOptions& o) {
  PathFollower follower = straight_on(run);
  SpeedController controller = speed_controller(run);
  const double last = o.speed * o.speed / o.radius;
  const auto speed_at = [&](double ay) { return std::sqrt(std::min(ay, last) * o.radius); };
  double speed = first_speed(o);
  drive_trimmed(run, follower, controller, speed);
  const DriverView& v = run.now().view;
  follower.follow(DrivenPath::circle({v.x, v.y}, v.yaw, o.right ? -o.radius : o.radius));
  SteadyCircleResult out;
  for (int k = 1; (k - 1) * o.spacing < last * (1.0 - 1e-9); ++k) {
    tell_progress("steady circle", (k - 1) * o.spacing / last);
    const double target = speed_at(k * o.spacing);
    const auto point = steady_point(run, follower, controller, speed, target, o);
    if (!point) {
      out.ended = fmt::format("no steady state at {:.4g} m/s, {:.3g} m/s2: the points end before",
                              target, target * target / o.radius);
      break;
    }
    out.points.push_back(*point);
    speed = target;
  }
  out.figures = circle_figures(out.points, run.axles());
  return out;
}

}  // namespace floatframe

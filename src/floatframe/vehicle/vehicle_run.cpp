#include "floatframe/vehicle/vehicle_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/vehicle/input_probe.hpp"

namespace floatframe {
namespace {

const Input& input_of(const Model& model, const std::string& name) {
  return *std::ranges::find(model.inputs, name, &Input::name);
}

/// The torque is F R, the input `ratio` times the torque.
std::pair<double, double> force_limits(const Model& model, const VehicleInput& input,
                                       double radius) {
  const Input& limits = input_of(model, input.input);
  const double factor = 1.0 / (input.ratio * radius);
  return std::minmax({limits.low * factor, limits.high * factor});
}

}  // namespace

VehicleRun::VehicleRun(const VehicleSetup& setup)
    : simulation_(build_model(setup.description)),
      vehicle_(*setup.description.vehicle),
      axles_(setup.axles),
      wheel_radius_(setup.wheel_radius),
      every_(steps_per_row(simulation_.options())) {
  for (const Body& body : model().bodies) mass_ += body.data->invariants.m;
  const std::vector<std::string> names = simulation_.output_names();
  for (std::size_t k = 0; k < index_.size(); ++k)
    index_[k] = std::ranges::find(names, measured_names[k]) - names.begin();
  if (vehicle_.drive)
    std::tie(lowest_drive_, highest_) = force_limits(model(), *vehicle_.drive, wheel_radius_);
  if (vehicle_.brake)
    highest_braking_ = std::max(0.0, force_limits(model(), *vehicle_.brake, wheel_radius_).second);
  table.columns.push_back({"time", "s"});
  for (const Output& o : model().outputs) table.columns.push_back({o.name, o.unit});
  for (const Input& i : model().inputs) table.columns.push_back({"inputs." + i.name, i.unit});
  read();
}

void VehicleRun::set(const VehicleInput& input, double value) {
  const Input& limits = input_of(model(), input.input);
  simulation_.set_input(input.input, std::clamp(value * input.ratio, limits.low, limits.high));
}

void VehicleRun::step(double steering, double force, double braking) {
  const double drive = std::max(force, lowest_drive_);
  if (vehicle_.steering) set(*vehicle_.steering, steering);
  if (vehicle_.drive) set(*vehicle_.drive, drive * wheel_radius_);
  if (vehicle_.brake) set(*vehicle_.brake, (drive - force + braking) * wheel_radius_);
  if (const StepReport report = simulation_.step(); !report)
    throw RunError(ErrorCode::step_failed, simulation_.failure(), simulation_.thrown());
  ++steps_;
  read();
  now_.steering = steering;
  if (recording_) record();
}

void VehicleRun::restore(const SimulationState& state) {
  simulation_.restore(state);
  now_.steering = 0.0;
  read();
}

void VehicleRun::read() {
  now_.time = simulation_.time() - begin_;
  DriverView& v = now_.view;
  v.x = measured(Measured::x);
  v.y = measured(Measured::y);
  v.yaw = measured(Measured::yaw);
  v.yaw_rate = measured(Measured::yaw_rate);
  const double c = std::cos(v.yaw), s = std::sin(v.yaw);
  const double vx = measured(Measured::vx), vy = measured(Measured::vy);
  v.speed = c * vx + s * vy;
  now_.path_speed = std::hypot(vx, vy);
  v.lateral = c * vy - s * vx;
  now_.sideslip = std::atan2(v.lateral, v.speed);
  now_.lateral_acceleration = c * measured(Measured::ay) - s * measured(Measured::ax);
  now_.roll = measured(Measured::roll);
}

void VehicleRun::begin_record() {
  begin_ = simulation_.time();
  now_.time = 0.0;
  recording_ = true;
  steps_ = 0;
  table.data.clear();
  record();
}

void VehicleRun::record() {
  if (steps_ % every_ != 0) return;
  table.data.push_back(now_.time);
  for (const double y : simulation_.outputs()) table.data.push_back(y);
  for (const double u : simulation_.inputs()) table.data.push_back(u);
}

namespace {

/// A force that has stayed at its limit while nothing changed will not do more.
[[noreturn]] void throw_at_limit(const VehicleRun& run, double force, double speed) {
  throw RunError(
      ErrorCode::not_steady,
      fmt::format("the vehicle stays at {:.6g} m/s, expected {:.6g} m/s: the force of its drive{} "
                  "is at its limit of {:.5g} N",
                  run.now().view.speed, speed, run.vehicle().brake ? " and brakes" : "", force));
}

/// Neither more time nor the controllers bring back a vehicle that has turned round, stands or runs
/// away.
void require_on_its_way(const VehicleRun& run, double yaw, double speed) {
  const DriverView& v = run.now().view;
  const double turned = std::abs(v.yaw - yaw);
  if (turned < 0.5 && v.speed > 0.05 * speed && v.speed < 4.0 * speed) return;
  throw RunError(
      ErrorCode::not_steady,
      fmt::format("the vehicle cannot be driven straight on at {:g} m/s: after {:.3g} s it drives "
                  "{:.4g} m/s, {:.3g} deg off its heading, with a yaw rate of {:.3g} deg/s",
                  speed, run.now().time, v.speed, turned * 180.0 / std::numbers::pi,
                  v.yaw_rate * 180.0 / std::numbers::pi));
}

}  // namespace

TrimmedInputs drive_trimmed(VehicleRun& run, PathFollower& follower, SpeedController& controller,
                            double speed) {
  constexpr double steady_rate = 5e-5 * std::numbers::pi / 180.0, steady_speed = 5e-5;
  constexpr double longest = 120.0, window = 1.0, near = 1e-3;
  require_inputs_that_act(run);
  const double dt = run.step_size();
  double since = 0.0, low = 0.0, high = 0.0, rate = 0.0, limited = 0.0;
  const double heading = run.now().view.yaw;
  TrimmedInputs out;
  for (double t = 0.0; t < longest; t += dt) {
    out = {.steering = follower.steer(run.now().view, dt),
           .force = controller.force(speed, run.now().view.speed, dt)};
    run.step(out.steering, out.force);
    require_on_its_way(run, heading, speed);
    const DriverView& v = run.now().view;
    rate = std::abs(v.yaw_rate);
    low = std::min(low, v.speed);
    high = std::max(high, v.speed);
    if (rate > steady_rate || high - low > steady_speed)
      since = 0.0, low = high = v.speed;
    else
      since += dt;
    const bool free = out.force > run.lowest_force() && out.force < run.highest_force();
    limited = free ? 0.0 : limited + dt;
    if (since < window) continue;
    if (std::abs(v.speed - speed) < near) {
      run.begin_record();
      return out;
    }
    if (limited >= window) throw_at_limit(run, out.force, speed);
  }
  throw RunError(
      ErrorCode::not_steady,
      fmt::format("the vehicle does not settle at {:g} m/s: after {:g} s it drives {:.6g} "
                  "m/s with a yaw rate of {:.2g} deg/s",
                  speed, longest, run.now().view.speed, rate * 180.0 / std::numbers::pi));
}

}  // namespace floatframe

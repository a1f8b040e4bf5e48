#include "floatframe/vehicle/input_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace floatframe {
namespace {

constexpr double probe_angle = 0.01, probe_acceleration = 0.5;  // [rad], [m/s2]
constexpr double probe_windows[] = {0.1, 2.0};                  // [s]
constexpr double probe_share = 1e-2;                            // of what is expected

struct ProbeInputs {
  double steering = 0.0, force = 0.0, braking = 0.0;  ///< [rad], [N], [N]
};

struct Probed {
  double yaw_rate = 0.0, speed = 0.0;
};

Probed probed(VehicleRun& run, const SimulationState& start, const ProbeInputs& inputs,
              double duration) {
  run.restore(start);
  const long steps = std::lround(std::ceil(duration / run.step_size()));
  for (long k = 0; k < steps; ++k) run.step(inputs.steering, inputs.force, inputs.braking);
  return {run.now().view.yaw_rate, run.now().view.speed};
}

/// An input and what of it is expected to change.
struct ProbedRole {
  std::string key;
  const VehicleInput* input;
  ProbeInputs inputs;
  double Probed::*answer;
  double expected;  ///< after a second, in the sense of the role
  double part;      ///< of it that counts as an answer
};

/// The types of the tyres, each once: "calspan_tyre".
std::string tyre_types(const VehicleRun& run) {
  std::set<std::string> words;
  for (const VehicleAxle& a : run.vehicle().axles)
    for (const VehicleWheel* w : {&a.left, &a.right})
      for (const Element& e : run.model().elements)
        if (e.name == w->tyre) words.insert(element_type_name(e.type));
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

[[noreturn]] void throw_dead(const VehicleRun& run, const ProbedRole& role, double change) {
  const std::string key = "vehicle." + role.key;
  std::string text = fmt::format("{}: found an input '{}' that ", key, role.input->input);
  if (role.key == "steering")
    text += fmt::format(
        "turns no wheel: for {:g} rad at the road wheels the yaw rate changes by {:.2g} deg/s in "
        "{:g} s, expected one that steers",
        probe_angle, change * 180.0 / std::numbers::pi, probe_windows[1]);
  else
    text += fmt::format(
        "moves nothing: for {:.4g} N the speed changes by {:.2g} m/s in {:g} s, expected a torque "
        "on wheels whose tyres have a longitudinal force (these are of the type {}), or a force "
        "on the chassis with the ratio {:.4g}",
        std::max(std::abs(role.inputs.force), role.inputs.braking), change, probe_windows[1],
        tyre_types(run), 1.0 / run.wheel_radius());
  throw InputError({{role.input->origin.mark, ErrorCode::wrong_value, text, 1, key}});
}

[[noreturn]] void throw_reversed(const ProbedRole& role) {
  const std::string key = "vehicle." + role.key;
  const std::string does = role.key == "steering" ? "steers to the right"
                           : role.key == "drive"  ? "drives backwards"
                                                  : "drives forwards";
  throw InputError({{role.input->origin.mark, ErrorCode::wrong_value,
                     fmt::format("{}: found an input '{}' that {}, expected the other sign of its "
                                 "ratio, which is {:g}",
                                 key, role.input->input, does, role.input->ratio),
                     1, key}});
}

void require_answer(VehicleRun& run, const SimulationState& start, const ProbedRole& role) {
  double change = 0.0;
  for (const double window : probe_windows) {
    const double still = probed(run, start, {}, window).*role.answer;
    change = probed(run, start, role.inputs, window).*role.answer - still;
    const double least = role.part * std::abs(role.expected) * window;
    if (std::abs(change) <= least) continue;
    if (change * role.expected < 0.0) throw_reversed(role);
    return;
  }
  throw_dead(run, role, change);
}

}  // namespace

void require_inputs_that_act(VehicleRun& run) {
  const SimulationState start = run.save();
  const VehicleDescription& v = run.vehicle();
  const double most = probe_acceleration * run.mass();
  if (v.steering)
    require_answer(run, start,
                   {.key = "steering",
                    .input = &*v.steering,
                    .inputs = {.steering = probe_angle},
                    .answer = &Probed::yaw_rate,
                    .expected = probe_angle * run.now().view.speed / run.axles().wheelbase(),
                    .part = probe_share});
  if (v.drive) {
    const double force = std::clamp(most, run.lowest_drive(), run.highest_force());
    require_answer(run, start,
                   {.key = "drive",
                    .input = &*v.drive,
                    .inputs = {.force = force},
                    .answer = &Probed::speed,
                    .expected = probe_acceleration,
                    .part = probe_share * std::abs(force) / most});
  }
  if (v.brake) {
    const double force = std::min(most, run.highest_braking());
    require_answer(run, start,
                   {.key = "brake",
                    .input = &*v.brake,
                    .inputs = {.braking = force},
                    .answer = &Probed::speed,
                    .expected = -probe_acceleration,
                    .part = probe_share * force / most});
  }
  run.restore(start);
}

}  // namespace floatframe

#include "floatframe/linear/operating_point.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "floatframe/core/json_text.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/system_state.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {
namespace {

double time_of(const std::string& at) {
  double time = 0.0;
  const char* end = at.data() + at.size();
  const auto [read, error] = std::from_chars(at.data(), end, time);
  if (error != std::errc() || read != end || !std::isfinite(time) || time < 0.0)
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format(
            "--at: expected 'start', 'equilibrium' or a time [s] that is not negative, found '{}'",
            excerpt(at)));
  return time;
}

SystemState state_after(const Model& model, double time) {
  Simulation s(model);
  const double size = s.options().step, begin = s.time();
  if (time < begin)
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format(
            "--at: expected a time of at least {:g} s, at which the model starts, found {:g}",
            begin, time));
  if (time - begin > rules::most_steps * size)
    throw InputError(
        ErrorCode::too_large,
        fmt::format("--at {:g}: a run to that time takes more than {:g} steps of {:g} s", time,
                    rules::most_steps, size));
  // Whole steps from the start, so that the run is that of `floatframe run`; then the rest.
  const double steps = std::floor((time - begin) / size * (1.0 + 1e-12) + 1e-9);
  for (double k = 0.0; k < steps; k += 1.0)
    if (!s.step())
      throw RunError(ErrorCode::step_failed, fmt::format("--at {:g}: {}", time, s.failure()));
  const double rest = time - s.time();
  if (rest > 1e-9 * size && !s.step(rest))
    throw RunError(ErrorCode::step_failed, fmt::format("--at {:g}: {}", time, s.failure()));
  return s.state();
}

}  // namespace

Model at_operating_point(const Model& model, const std::string& at) {
  Model there = model;
  SimulationDescription& d = there.simulation;
  if (at.empty() || at == "start") return there;
  if (at == "equilibrium") {
    d.start = Start::equilibrium;
    d.state = nullptr;
  } else {
    const double time = time_of(at);
    d.state = std::make_shared<SystemState>(state_after(model, time));
    d.start = Start::state;
    d.velocity.setZero();  // included in the state
  }
  d.offset.clear();
  d.given_by("--at", "start");
  return there;
}

CountedStiffening counted_at_operating_point(const Model& model, const std::string& at) {
  CountedStiffening counted = counted_stiffening(at_operating_point(model, at));
  const bool after_a_run = !at.empty() && at != "start" && at != "equilibrium";
  if (!after_a_run || counted.bodies.empty()) return counted;
  Model with = model;
  for (std::size_t i = 0; i < with.bodies.size(); ++i)
    with.bodies[i].geometric_stiffening = counted.model.bodies[i].geometric_stiffening;
  with.simulation.inertia = counted.model.simulation.inertia;
  counted.model = at_operating_point(with, at);
  return counted;
}

Option operating_point_option(std::string& at) {
  return text_option("--at", at, "PLACE",
                     "start, equilibrium, or the time [s] that a run is made to first; default: "
                     "where a run starts");
}

}  // namespace floatframe

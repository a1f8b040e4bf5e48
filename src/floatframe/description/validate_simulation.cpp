// The group `simulation`.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"

namespace floatframe {

void validate(const SimulationDescription& s, ErrorList& errors) {
  const validation::Entity group{errors, s.origin, "simulation"};
  group.word("coordinates", s.coordinates, rules::coordinates);
  group.word("inertia", s.inertia, rules::inertia_methods);
  group.word("start", s.start, {"given", "equilibrium", "{state: file}"});
  if (s.start == Start::state && !s.state)
    group.error(ErrorCode::missing, "start", "found no state, expected the state to start from");
  if (s.start == Start::given && !s.offset.empty())
    group.error(ErrorCode::incomplete, "start.offset", sentences::offset_alone());
  for (const auto& [body, offset] : s.offset) {
    group.vector("start.offset." + body, offset.translation, "m");
    if (offset.rotation) group.vector("start.offset." + body, *offset.rotation, "rad");
  }
  group.vector("velocity", s.velocity, "m/s");
  const bool step = group.number("step", s.step, rules::step);
  group.number("duration", s.duration, rules::duration);
  group.number("output_interval", s.output_interval, rules::output_interval);
  group.number("spectral_radius", s.spectral_radius, rules::spectral_radius);
  group.number("tolerance", s.tolerance, rules::tolerance);
  group.whole("max_iterations", s.max_iterations, rules::max_iterations);
  if (group.number("min_step", s.min_step, rules::min_step) && step)
    group.complain(ErrorCode::out_of_range, "min_step", sentences::min_step(s.min_step, s.step));
  group.number("penalty", s.penalty, rules::penalty);
  group.number("position_tolerance", s.position_tolerance, rules::position_tolerance);
  group.number("velocity_tolerance", s.velocity_tolerance, rules::velocity_tolerance);
  if (s.record.every != 0) group.whole("record", s.record.every, rules::every);
}

void require_valid(const SimulationDescription& s) {
  ErrorList errors;
  validate(s, errors);
  errors.throw_if_any();
}

void require_valid_run(const SimulationDescription& s) {
  require_valid(s);
  if (const auto complaint = sentences::steps(s.duration, s.step))
    throw InputError(ErrorCode::out_of_range, mark_of_time_settings(s), *complaint);
}

SourceMark mark_of_time_settings(const SimulationDescription& s) {
  const SourceMark &step = s.origin.of("step"), &duration = s.origin.of("duration");
  // The position of one of them in the file is of little use if the other came from elsewhere.
  const auto from_file = [&](const SourceMark& mark) {
    return &mark == &s.origin.mark || mark.line > 0;
  };
  if (!from_file(step) || !from_file(duration))
    return step.is_option() || from_file(duration) ? step : duration;
  return s.origin.keys.contains("step") ? step : duration;
}

}  // namespace floatframe

#include "floatframe/realtime/realtime_options.hpp"

#include <fmt/format.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/realtime/realtime_rules.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

/// Checks step and duration against the range of the clock; both are valid by themselves.
void check_clock(const RealTimeOptions& o, const SimulationDescription& s, ErrorList& errors) {
  namespace rules = realtime_rules;
  if (o.paced && !(s.step >= rules::shortest_step && s.step <= rules::longest_step))
    errors.add(ErrorCode::out_of_range, s.origin.of("step"),
               fmt::format("found a step of {:g} s, expected at least 1e-6 s and at most 1e6 s in "
                           "step with the wall clock",
                           s.step));
  if (!o.endless && s.duration > rules::most_steps * s.step)
    errors.add(ErrorCode::too_large, mark_of_time_settings(s),
               fmt::format("a duration of {:g} s with a step of {:g} s takes more than {:g} steps",
                           s.duration, s.step, rules::most_steps));
}

}  // namespace

void require_valid(const RealTimeOptions& o, const SimulationDescription& s) {
  require_valid(s);
  ErrorList errors;
  const Origin none;
  const validation::Entity group{errors, none, "realtime"};
  group.whole("fixed_iterations", o.fixed_iterations, realtime_rules::fixed_iterations);
  group.number("time_budget", o.time_budget, realtime_rules::time_budget);
  group.number("max_lag", o.max_lag, realtime_rules::max_lag);
  group.number("input_timeout", o.input_timeout, realtime_rules::input_timeout);
  group.word("fallback", o.fallback, realtime_rules::fallbacks);
  group.whole("priority", o.priority, realtime_rules::priority);
  check_clock(o, s, errors);
  errors.throw_if_any();
  if (!o.endless) check_step(s);
}

}  // namespace floatframe

#pragma once
// What the summary of a run says of its start and its end, from the stepper.
#include "floatframe/run/run.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

/// Brings the formulation to the present state.
inline RunSummary summary_at_start(Stepper& steps, const SimulationDescription& options) {
  RunSummary s = asked_summary(steps.model().name, options);
  s.start = steps.start_report();
  const Energies e = steps.energies();
  s.energy.kinetic_start = e.kinetic;
  s.energy.potential_start = e.potential;
  s.energy.elastic_start = e.elastic;
  s.energy.total_start = e.total();
  return s;
}

/// `begin`: of the run [s]. The same.
inline void write_end(Stepper& steps, double begin, RunSummary& s) {
  s.StepCounters::operator=(steps.counters());
  s.duration = steps.state().t - begin;
  s.real_time_factor = s.cpu > 0.0 ? s.duration / s.cpu : 0.0;
  const Energies e = steps.energies();
  s.energy.kinetic_end = e.kinetic;
  s.energy.potential_end = e.potential;
  s.energy.elastic_end = e.elastic;
  s.energy.total_end = e.total();
}

/// About outputs and edges, behind the warnings of the watch.
inline void warn_of_steps(const Stepper& steps, std::vector<RangeWarning>& warnings) {
  if (std::string why = steps.undefined_outputs(); !why.empty())
    warnings.push_back({RangeLimit::formula, std::move(why)});
  if (std::string why = steps.crowded_edges(); !why.empty())
    warnings.push_back({RangeLimit::edges, std::move(why)});
}

}  // namespace floatframe

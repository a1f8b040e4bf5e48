#include "floatframe/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/run_loop.hpp"

namespace floatframe {

void check_step(const SimulationDescription& o) {
  if (o.duration > 0.0 && !(o.step <= o.duration * (1.0 + 1e-9)))
    throw InputError(
        ErrorCode::out_of_range, mark_of_time_settings(o),
        fmt::format(
            "the step of {:g} s is longer than the duration of {:g} s: expected at least one step",
            o.step, o.duration));
}

double default_penalty_mass(const Model& model, Coordinates coordinates) {
  return (coordinates == Coordinates::absolute ? 1e8 : 1e5) * model.mean_mass;
}

namespace {

/// Smallest mass or principal moment of inertia of the bodies above rounding.
double smallest_inertia(const Model& model) {
  double least = 1.0;
  for (const Body& b : model.bodies) {
    const InertiaInvariants& v = b.data->invariants;
    if (!(v.m > 0.0)) continue;
    const Vec3 c = v.centre_of_mass();
    const Mat3 P = v.P_u - v.m * c * c.transpose();
    least = std::min(least, v.m);
    for (const double J : symmetric_eigenvalues(P.trace() * Mat3::Identity() - P))
      if (J > 1e-9 * v.m * b.length * b.length) least = std::min(least, J);
  }
  return least;
}

}  // namespace

StepOptions step_options(const Model& model, const SimulationDescription& o) {
  StepOptions s;
  // A force of 1 N on a part of 1e-7 kg does not indicate a massless direction.
  s.largest_acceleration /= smallest_inertia(model);
  s.spectral_radius = o.spectral_radius;
  s.tolerance = o.tolerance;
  s.max_iterations = o.max_iterations;
  s.position_tolerance = o.position_tolerance;
  s.velocity_tolerance = o.velocity_tolerance;
  s.penalty_mass = o.penalty > 0.0 ? o.penalty * o.step * o.step / 4.0
                                   : default_penalty_mass(model, o.coordinates);
  return s;
}

State relative_start(RelativeFormulation& f, Start start, StartReport* report) {
  State state;
  f.start(state.q, state.v);
  VecX at_rest = VecX::Zero(f.velocities());
  close_loops(f, state.q, start == Start::equilibrium ? at_rest : state.v, true);
  if (start == Start::equilibrium) {
    const Equilibrium e = find_equilibrium(f, state.q);
    if (report != nullptr)
      if (std::string note = unstable_equilibrium(f, state.q, e.lambda); !note.empty())
        report->notes.push_back(std::move(note));
    close_loops(f, state.q, state.v, false);
  }
  if (report == nullptr) return state;
  kinematics_at(f, 0.0, state.q, state.v);
  for (const LockedLoops& locked : f.model().hints.locked) report->notes.push_back(locked.sentence);
  report_changes(f.motion(), start, *report);
  report_redundancy(f, state, *report);
  return state;
}

RunSummary asked_summary(const std::string& model, const SimulationDescription& o) {
  RunSummary s;
  s.model = model;
  s.coordinates = rules::coordinates[index_of(o.coordinates)];
  s.inertia = rules::inertia_methods[index_of(o.inertia)];
  s.step = o.step;
  s.locates_edges = o.locate_edges;
  return s;
}

RunSummary failed_summary(const std::string& model, const SimulationDescription& o,
                          const std::string& message) {
  RunSummary s = asked_summary(model, o);
  s.status = "failed";
  s.message = message;
  return s;
}

RunResult run(const Model& given, const SimulationDescription& o, const RunOptions& run_options) {
  require_valid_run(o);
  check_step(o);
  return o.coordinates == Coordinates::relative
             ? Run<RelativeFormulation>(given, o, run_options).result()
             : Run<AbsoluteFormulation>(given, o, run_options).result();
}

}  // namespace floatframe

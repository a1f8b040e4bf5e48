#include "floatframe/start/initial_state.hpp"

#include <algorithm>

#include "floatframe/loops/redundancy.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

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

void set_element_states(Formulation& f, State& state, StateStart of) {
  if (f.element_states().count() == 0) return;
  kinematics_at(f, state.t, state.q, state.v);
  f.start_element_states(of);
  state.z = f.element_states().values();
}

namespace {

/// Wheels that roll at the start do not rest: what is found of an equilibrium at rest, in which
/// their tyres hold by their deflections, says nothing of the motion.
bool rolls_from_start(const Model& model, const VecX& v) {
  return largest(v) > 0.0 && std::ranges::any_of(model.elements, [](const Element& e) {
           return e.states > 0 && element_kind(e.type).rolls;
         });
}

}  // namespace

State relative_start(RelativeFormulation& f, Start start, StartReport* report) {
  State state;
  f.start(state.q, state.v);
  VecX at_rest = VecX::Zero(f.velocities());
  close_loops(f, state.q, start == Start::equilibrium ? at_rest : state.v, true);
  set_element_states(f, state);
  if (start == Start::equilibrium) {
    const Equilibrium e = find_equilibrium(f, state.q);
    if (report != nullptr)
      for (std::string& note : equilibrium_notes(f, e)) report->notes.push_back(std::move(note));
    if (report != nullptr && !rolls_from_start(f.model(), state.v))
      if (std::string note = unstable_equilibrium(f, state.q, e.lambda); !note.empty())
        report->notes.push_back(std::move(note));
    close_loops(f, state.q, state.v, false);
    set_element_states(f, state, StateStart::sampled);
  }
  if (report == nullptr) return state;
  kinematics_at(f, 0.0, state.q, state.v);
  for (const LockedLoops& locked : f.model().hints.locked) report->notes.push_back(locked.sentence);
  report_changes(f.motion(), start, *report);
  report_redundancy(f, state, *report);
  return state;
}

}  // namespace floatframe

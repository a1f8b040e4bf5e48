#include "floatframe/linear/linearize.hpp"

#include "floatframe/formulation/owners.hpp"
#include "floatframe/linear/linear_reduction.hpp"
#include "floatframe/model/sampling.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/stepping/samples.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {
namespace {

Linearization linearized(const Model& model, const SimulationDescription& options) {
  InitialisedModel started(model, options);
  if (std::string note = settle_samples(started, options.step); !note.empty())
    started.add_note(std::move(note));
  Formulation& f = started.formulation();
  SmallMotions terms = small_motions(f, started.state());
  Linearization l;
  l.M = std::move(terms.M);
  l.C = std::move(terms.C);
  l.K = std::move(terms.K);
  l.J = std::move(terms.J);
  l.r = std::move(terms.r);
  l.coordinates = unknown_owners(f);
  l.constraints = constraint_owners(f);
  JointFollower joints(started.model());
  kinematics_at(f, started.state());
  l.state = system_state(f.motion(), joints);
  place_bodies(started.model(), options.inertia, l.state);
  l.start = started.report();
  if (std::string held = held_samples_note(model); !held.empty())
    l.start.notes.push_back(std::move(held));
  return l;
}

}  // namespace

Linearization linearize(const Model& model, const SimulationOptions& options) {
  const CountedStiffening counted = counted_at(model, options);
  const SimulationDescription& d = counted.model.simulation;
  Linearization l = linearized(counted.model, d);
  l.stiffened = counted.bodies;
  l.start.notes.insert(l.start.notes.end(), counted.notes.begin(), counted.notes.end());
  return l;
}

}  // namespace floatframe

#include "floatframe/start/check.hpp"

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/loops/redundancy.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/sampling.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/start/unique_loads.hpp"

namespace floatframe {
namespace {

/// What is odd about elements at the start.
void note_elements(const SystemMotion& motion, std::vector<std::string>& notes) {
  for (const Element& e : motion.model.elements)
    if (const auto note = element_kind(e.type).note) note(e, motion, notes);
}

void note_unstable_start(const Model& model, std::vector<std::string>& notes) {
  if (model.simulation.start != Start::equilibrium) return;
  constexpr int most = 300;  // unknowns: a check takes a moment
  RelativeFormulation f(model, model.simulation.inertia);
  if (f.velocities() + f.constraints() > most) return;
  State state;
  f.start(state.q, state.v);
  state.v.setZero();
  try {
    close_loops(f, state.q, state.v, true);
    const Equilibrium e = find_equilibrium(f, state.q);
    if (std::string note = unstable_equilibrium(f, state.q, e.lambda); !note.empty())
      notes.push_back(std::move(note));
  } catch (const RunError&) {
  }
}

}  // namespace

ModelCounts check(const Model& model) {
  started_model(built(model), model.simulation);  // rejects a state of another model, as a run
  require_samples_of_steps(model, model.simulation.step);
  RelativeFormulation relative(model, model.simulation.inertia);
  const AbsoluteFormulation absolute(model, model.simulation.inertia);
  ModelCounts c;
  c.bodies = static_cast<int>(model.bodies.size());
  for (const Body& b : model.bodies) c.flexible_bodies += b.modes() > 0 ? 1 : 0;
  c.joints = static_cast<int>(model.joints.size());
  c.cut_joints = static_cast<int>(relative.tree().topology().cut_joints.size());
  for (const int j : relative.tree().topology().cut_joints)
    c.cut_joint_names.push_back(model.joints[j].name);
  c.relative = relative.counts();
  c.absolute = absolute.counts();
  // Rank at the assembled start, with position constraints only.
  State start = relative_start(relative, Start::given, &c.start);
  require_unique_loads(relative, start.q);
  // A singular mass matrix is detected here.
  const double penalty_mass = default_penalty_mass(model, Coordinates::relative);
  if (start_accelerations(relative, start, penalty_mass) && model.simulation.spectral_radius == 1.0)
    std::ranges::move(massless_notes(relative, start, penalty_mass),
                      std::back_inserter(c.start.notes));
  kinematics_at(relative, 0.0, start.q, start.v);
  const int rank = rank_of(relative.constraint_rows());
  c.degrees_of_freedom = relative.velocities() - rank;
  c.redundant_constraints = relative.constraints() - rank;
  c.start.notes.insert(c.start.notes.end(), model.hints.notes.begin(), model.hints.notes.end());
  note_elements(relative.motion(), c.start.notes);
  note_unstable_start(model, c.start.notes);
  return c;
}

}  // namespace floatframe

// Coordinates, constraints, degrees of freedom of a model, and its equilibrium.
#include <fmt/format.h>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/run_error.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "floatframe/simulation/singular_position.hpp"
#include "floatframe/simulation/system_state.hpp"

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

/// A toggle this close to straight has forces a hundred thousand times its loads.
constexpr double nearly_singular = 1e-5;

/// Reactions that are not explained by loads.
bool out_of_proportion(const Model& model, const StaticsResult& s) {
  constexpr double most = 1e4;
  double load = 0.0, reaction = 0.0;
  for (const Body& b : model.bodies) load += b.data->invariants.m * model.gravity.norm();
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    (model.elements[k].links() ? reaction : load) += std::abs(s.forces[k].force);
  for (const StaticsJoint& j : s.joints) reaction = std::max(reaction, j.force.norm());
  return load > 0.0 && reaction > most * load;
}

}  // namespace

ModelCounts check(const Model& model) {
  started_model(built(model), model.simulation);  // rejects a state of another model, as a run
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

StaticsResult statics(const Model& model) {
  RelativeFormulation f(built(model), model.simulation.inertia);
  State state;
  f.start(state.q, state.v);
  state.v.setZero();
  close_loops(f, state.q, state.v, true);
  const Equilibrium e = find_equilibrium(f, state.q);
  const std::string unstable = unstable_equilibrium(f, state.q, e.lambda);
  const VecX zero = VecX::Zero(f.velocities());
  VecX r(f.velocities());
  kinematics_at(f, 0.0, state.q, zero);
  f.dynamics();
  f.residual(zero, e.lambda, 0.0, r);

  StaticsResult s;
  for (const LockedLoops& locked : model.hints.locked) s.notes.push_back(locked.sentence);
  const std::string singular = singular_position(f, nearly_singular).sentence;
  if (!singular.empty()) s.notes.push_back(singular);
  if (!unstable.empty()) s.notes.push_back(unstable);
  s.iterations = e.iterations;
  s.residual = e.residual;
  const SystemMotion& motion = f.motion();
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Efforts& x = motion.efforts[k];
    s.forces.push_back(
        {model.elements[k].name, element_type_name(model.elements[k].type), x.force, x.length});
  }
  Reactions tree;
  tree.joints.resize(model.joints.size());
  f.add_tree_wrenches(tree);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    StaticsJoint joint;
    joint.name = model.joints[k].name;
    joint.type = joint_type_name(model.joints[k].type);
    joint.force = tree.joints[k].force;
    joint.torque = tree.joints[k].torque;
    s.joints.push_back(joint);
  }
  for (std::size_t k = 0; k < f.constraint_set().parts().size();
       ++k) {  // multipliers of cut joints, motions and elements
    const ConstraintPart& p = f.constraint_set().parts()[k];
    for (int row = 0; row < p.rows(); ++row) {
      const double lambda = e.lambda[f.constraint_set().offset(k) + row];
      const WrenchRow& g = f.constraint_set().row(f.constraint_set().offset(k) + row).gradient;
      if (p.owner.element >= 0) {
        StaticsForce& force = s.forces[p.owner.element];
        force.force = p.force * lambda;
        force.length = p.motion ? evaluate(*p.motion, 0.0).f : p.scale;
      }
      if (p.owner.joint < 0) continue;
      StaticsJoint& joint = s.joints[p.owner.joint];
      joint.force -= lambda * g.b.F;
      joint.torque -= lambda * g.b.T;
    }
  }
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    StaticsBody b;
    const BodyKinematics& m = motion.bodies[i];
    b.name = model.bodies[i].name;
    b.position = m.p_WB;
    b.roll_pitch_yaw = roll_pitch_yaw(m.R_WB * model.bodies[i].X_WB.R.transpose());
    b.amplitudes = m.y;
    s.bodies.push_back(b);
  }
  if (f.constraints() > 0 && rank_of(f.constraint_rows()) < f.constraints()) {
    ConstraintAnalysis analysis(f, state.q);
    analysis.set_reactions(s);
    s.redundant = analysis.redundant();
  }
  if (!singular.empty() && out_of_proportion(model, s))
    throw RunError(ErrorCode::singular, "no equilibrium: " + singular);
  state.v = zero;
  JointFollower joints(model);
  kinematics_at(f, state);
  s.state = std::make_shared<SystemState>(system_state(f.motion(), joints));
  place_bodies(model, model.simulation.inertia, *s.state);
  return s;
}

}  // namespace floatframe

#include "floatframe/start/statics.hpp"

#include "floatframe/loops/redundancy.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/loops/singular_position.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/start/unique_loads.hpp"

namespace floatframe {
namespace {

/// A toggle this close to straight has forces a hundred thousand times its loads.
constexpr double nearly_singular = 1e-5;

/// Reactions that are not explained by loads.
bool out_of_proportion(const Model& model, const StaticsResult& s) {
  constexpr double most = 1e4;
  double load = 0.0, reaction = 0.0;
  for (const Body& b : model.bodies) load += b.data->invariants.m * model.gravity.norm();
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const double force = std::abs(s.forces[k].force);
    if (model.elements[k].links()) reaction += force;
    if (model.elements[k].acts) load += force;
  }
  for (const StaticsJoint& j : s.joints) reaction = std::max(reaction, j.force.norm());
  return load > 0.0 && reaction > most * load;
}

/// The measure of an element that holds, whose first part this is; zero of a constraint.
double length_of(const Model& model, const ConstraintPart& part) {
  if (part.motion) return evaluate(*part.motion, 0.0).f;
  const ElementType type = model.elements[part.owner.element].type;
  return element_kind(type).list == ElementList::constraints ? 0.0 : part.scale;
}

/// What the multipliers of cut joints, motions and elements that hold exert.
void add_multipliers(const RelativeFormulation& f, const VecX& multipliers, StaticsResult& s) {
  const ConstraintSet& set = f.constraint_set();
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    const double* lambda = multipliers.data() + set.offset(k);
    const bool first = k == 0 || set.parts()[k - 1].owner.element != p.owner.element;
    if (p.owner.element >= 0 && first) {
      StaticsForce& force = s.forces[p.owner.element];
      force.force = set.force_of(k, lambda);
      force.length = length_of(f.model(), p);
    }
    if (p.counted_by() < 0) continue;
    StaticsJoint& joint = s.joints[p.owner.joint];
    for (int row = 0; row < p.rows(); ++row) {
      const WrenchRow& g = set.row(k, row).gradient;
      joint.force -= lambda[row] * g.b.F;
      joint.torque -= lambda[row] * g.b.T;
    }
  }
}

/// Sets the reactions of joints and the forces of elements to those of least norm that balance the
/// model, and marks those that are not unique. Nothing is changed if no balance exists.
void set_reactions(const Model& model, const ConstraintAnalysis& analysis, StaticsResult& statics) {
  const auto found = analysis.multipliers(statics.residual);
  if (!found) return;
  const auto& [lambda, balanced] = *found;
  const Eigen::Index states = balanced.cols();
  const std::size_t joints = model.joints.size();
  std::vector<MatX> force(joints, MatX::Zero(3, states)), torque = force;
  for (StaticsJoint& j : statics.joints) {
    j.force.setZero();
    j.torque.setZero();
  }
  for (std::size_t k = 0; k < analysis.parts().size(); ++k) {
    const ConstraintPart& p = analysis.parts()[k];
    for (int r = 0; r < p.rows(); ++r) {
      const Eigen::Index i = analysis.row_of(k) + r;
      const WrenchRow& g = analysis.row(k, r).gradient;
      if (p.owner.element >= 0) {
        StaticsForce& of = statics.forces[p.owner.element];
        const bool first = k == 0 || analysis.parts()[k - 1].owner.element != p.owner.element;
        if (first && r == 0) {
          of.force = analysis.force_of(k, lambda);
          of.unique = true;
        }
        of.unique = of.unique && !(balanced.row(i).norm() > 1e-7);
      }
      if (p.counted_by() < 0) continue;
      const std::size_t owner = p.owner.joint;
      statics.joints[owner].force -= lambda[i] * g.b.F;
      statics.joints[owner].torque -= lambda[i] * g.b.T;
      force[owner] -= g.b.F * balanced.row(i);
      torque[owner] -= g.b.T * balanced.row(i);
    }
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const double length = model.bodies[model.joints[j].child].length;
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = c;
      statics.joints[j].unique_force[i] = !(force[j].row(c).norm() > 1e-7);
      statics.joints[j].unique_torque[i] = !(torque[j].row(c).norm() > 1e-7 * length);
    }
  }
}

}  // namespace

bool StaticsJoint::unique() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (!unique_force[i] || !unique_torque[i]) return false;
  return true;
}

StaticsResult statics(const Model& model) {
  RelativeFormulation f(built(model), model.simulation.inertia);
  State state;
  f.start(state.q, state.v);
  state.v.setZero();
  close_loops(f, state.q, state.v, true);
  set_element_states(f, state);
  require_unique_loads(f, state.q);
  const Equilibrium e = find_equilibrium(f, state.q);
  state.z = f.element_states().values();
  const std::string unstable = unstable_equilibrium(f, state.q, e.lambda);
  const VecX zero = VecX::Zero(f.velocities());
  VecX r = zero;
  kinematics_at(f, 0.0, state.q, zero);
  f.dynamics();
  f.residual(zero, e.lambda, 0.0, r);

  StaticsResult s;
  for (const LockedLoops& locked : model.hints.locked) s.notes.push_back(locked.sentence);
  const std::string singular = singular_position(f, nearly_singular).sentence;
  if (!singular.empty()) s.notes.push_back(singular);
  if (!unstable.empty()) s.notes.push_back(unstable);
  for (std::string& note : equilibrium_notes(f, e)) s.notes.push_back(std::move(note));
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
    const auto& [force, torque] = tree.joints[k];
    s.joints.push_back(
        {model.joints[k].name, joint_type_name(model.joints[k].type), force, torque});
  }
  add_multipliers(f, e.lambda, s);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    StaticsBody b;
    const BodyKinematics& m = motion.bodies[i];
    b.name = model.bodies[i].name;
    b.position = m.p_WB;
    b.roll_pitch_yaw =
        floatframe::roll_pitch_yaw<double>(m.R_WB * model.bodies[i].X_WB.R.transpose());
    b.amplitudes = m.y;
    s.bodies.push_back(b);
  }
  if (f.constraints() > 0 && rank_of(f.constraint_rows()) < f.constraints()) {
    const ConstraintAnalysis analysis(f, state.q);
    set_reactions(model, analysis, s);
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

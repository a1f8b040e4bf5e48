#include "floatframe/start/start_up.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/start/unique_loads.hpp"

namespace floatframe {
namespace {

/// Markers on stiffening bodies, at moving nodes without second-order displacements.
void note_linear_markers(const Model& model, StartReport& report) {
  std::vector<std::pair<int, int>> said;  // body, node
  for (const Marker& m : model.markers) {
    if (m.body < 0 || m.node < 0 || !model.bodies[m.body].stiffens()) continue;
    const Body& body = model.bodies[m.body];
    const ModalNode& node = body.data->nodes[m.node];
    if (node.X.isZero(0.0) && node.X_theta.isZero(0.0)) continue;
    const auto& known = body.data->second_order->nodes;
    if (std::any_of(known.begin(), known.end(),
                    [&](const SecondOrderNode& n) { return n.node == m.node; }))
      continue;
    if (std::find(said.begin(), said.end(), std::pair(m.body, m.node)) != said.end()) continue;
    said.emplace_back(m.body, m.node);
    report.notes.push_back(fmt::format(
        "body '{}': geometric stiffening has no displacements of second order of {}: what acts "
        "there does not stiffen the body",
        body.name,
        node.name.empty()
            ? fmt::format("its node at [{:.4g}, {:.4g}, {:.4g}]", node.p[0], node.p[1], node.p[2])
            : fmt::format("node '{}'", node.name)));
  }
}

/// A model that can satisfy its prescribed motions.
const Model& movable(const Model& model) {
  for (const LockedLoops& locked : model.hints.locked)
    if (locked.driven)
      throw RunError(ErrorCode::contradiction,
                     "the prescribed motion contradicts the constraints: " + locked.sentence);
  return model;
}

}  // namespace

InitialisedModel::InitialisedModel(const Model& given, const SimulationDescription& o,
                                   Coordinates coordinates)
    : given_(movable(built(given))),
      changed_(started_model(given, o)),
      inertia_(o.inertia),
      f_(make_formulation(coordinates, model(), inertia_)),
      step_options_(floatframe::step_options(model(), o)),
      min_step_(o.min_step > 0.0 ? o.min_step : o.step / 1024.0) {
  if (auto* relative = dynamic_cast<RelativeFormulation*>(f_.get())) {
    state_ = start_state(*relative, o, &report_);
    require_unique_loads(*relative, state_.q);
  } else {
    RelativeFormulation tree(model(), o.inertia);
    const State start = start_state(tree, o, &report_);
    require_unique_loads(tree, start.q);
    state_.t = start.t;
    state_.z = start.z;
    static_cast<AbsoluteFormulation&>(*f_).start_from(tree, start.q, start.v, state_.q, state_.v);
  }
  f_->element_states().give(state_.z);
  if (state_.z.size() > 0) {
    kinematics_at(*f_, state_);
    f_->start_element_states(StateStart::found);
    state_.z = f_->element_states().values();
  }
  double& spectral_radius = step_options_.spectral_radius;
  if (start_accelerations(*f_, state_, step_options_.penalty_mass) && spectral_radius >= 1.0)
    for (std::string& note : massless_notes(*f_, state_, step_options_.penalty_mass)) {
      spectral_radius = massless_spectral_radius;
      add_note(std::move(note));
    }
  if (state_.z.size() > 0) {
    dynamics_at(*f_, state_);
    state_.zd = state_.zd_alg = f_->element_states().rates();
  }
  note_linear_markers(model(), report_);
  for (std::string& note : doubtful_gauges(model())) add_note(std::move(note));
  spring_angles_.assign(f_->spring_angles().begin(), f_->spring_angles().end());
}

InitialisedModel::InitialisedModel(const InitialisedModel& found)
    : given_(found.model()),
      inertia_(found.inertia_),
      f_(make_formulation(found.f_->coordinates(), model(), inertia_)),
      state_(found.state_),
      spring_angles_(found.spring_angles_),
      report_(found.report_),
      step_options_(found.step_options_),
      min_step_(found.min_step_) {
  f_->set_spring_angles(spring_angles_);
}

InitialisedModel::InitialisedModel(const Model& changed, const SimulationDescription& o,
                                   const InitialisedModel& found)
    : given_(movable(built(changed))),
      changed_(started_model(changed, o)),
      inertia_(found.inertia_),
      f_(make_formulation(found.f_->coordinates(), model(), inertia_)),
      state_(found.state_),
      spring_angles_(found.spring_angles_),
      report_(found.report_),
      step_options_(floatframe::step_options(model(), o)),
      min_step_(found.min_step_) {
  const Formulation &now = *f_, &before = *found.f_;
  if (now.velocities() != before.velocities() || now.configurations() != before.configurations() ||
      now.constraints() != before.constraints() ||
      f_->element_states().count() != state_.z.size() ||
      now.spring_angles().size() != spring_angles_.size())
    throw InputError(ErrorCode::mismatch,
                     "found a changed model with other coordinates, constraints or states, "
                     "expected other numbers only");
  step_options_.spectral_radius = found.step_options_.spectral_radius;
  f_->set_spring_angles(spring_angles_);
  f_->element_states().give(state_.z);
}

}  // namespace floatframe

#include "floatframe/formulation/element_set.hpp"

#include <cmath>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

ElementSet::ElementSet(const Model& model)
    : model_(model),
      order_(model),
      links_(model.links.size()),
      links_from_(model.elements.size()),
      z_(model) {
  for (std::size_t l = 0; l < model.links.size(); ++l)
    links_from_[model.links[l].from].push_back(l);
  for (const SignalGroup& group : order_.groups)
    if (!group.links.empty()) rings_.emplace_back(model, group);
  for (const Element& e : model.elements) {
    states_.emplace_back(e.acts ? e.markers.size() : 0, e.states, e.further());
    std::vector<int>& slots = slots_.emplace_back();
    for (const CoordinatePort& c : e.coordinates) {
      slots.push_back(c.counted ? static_cast<int>(angles_.size()) : -1);
      if (c.counted) angles_.push_back(0.0);
    }
    const auto counted =
        std::find_if(slots.begin(), slots.end(), [](int slot) { return slot >= 0; });
    first_slot_.push_back(counted == slots.end() ? -1 : *counted);
  }
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    if (model.elements[k].acts) acting_.push_back(k);
    for (std::size_t i = 0; model.elements[k].exerts() && i < states_[k].markers(); ++i)
      wrenches_.emplace_back(model.elements[k].markers[i], &states_[k].wrench[i]);
  }
  kept_angles_ = angles_;
  branches_.assign(model.elements.size(), free_branch);
  for (const Input& input : model.inputs) inputs_.push_back(input.initial);
}

int ElementSet::undefined(double t) const noexcept {
  const auto finite = [](double x) { return std::isfinite(x); };
  for (const std::size_t k : acting_) {
    const Element& e = model_.elements[k];
    if (!e.reads) continue;
    const Efforts& now = states_[k];
    bool defined = finite(now.force) && std::ranges::all_of(now.further, finite);
    if (!e.clock.ticks())  // else it reads at its instants
      for (const Signal& signal : e.signals)
        if (const Formula* f = signal.function.formula.get())
          defined &= finite(formula_at(*f, t).f);
    if (!defined) return static_cast<int>(k);
  }
  return -1;
}

void ElementSet::connect(const std::vector<const MarkerState*>& markers) {
  assert(markers.size() == model_.markers.size());
  markers_.clear();
  held_angles_.clear();
  for (const Element& e : model_.elements) {
    const std::size_t k = markers_.size();
    std::vector<const MarkerState*>& own = markers_.emplace_back();
    for (const int marker : e.markers) own.push_back(markers[static_cast<std::size_t>(marker)]);
    for (std::size_t i = 0; e.holds && i < e.coordinates.size(); ++i) {
      const int port = e.coordinates[i].port;
      if (slot(k, i) >= 0) held_angles_.push_back({slot(k, i), own[port], own[port + 1]});
    }
  }
}

void ElementSet::count_turns_from(const Model& values, double t) noexcept {
  for (std::size_t k = 0; k < model_.elements.size(); ++k)
    for (std::size_t i = 0; i < slots_[k].size(); ++i) {
      const CoordinatePort& c = model_.elements[k].coordinates[i];
      const Joint& joint = values.joints[c.joint];
      const TimeFunction* motion = values.motion_of(joint, c.component);
      set_angle(slots_[k][i], motion                   ? floatframe::evaluate(*motion, t).f
                              : joint.position.empty() ? 0.0
                                                       : joint.position[c.component]);
    }
}

}  // namespace floatframe

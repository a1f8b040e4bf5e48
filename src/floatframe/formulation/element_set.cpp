#include "floatframe/formulation/element_set.hpp"

#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

ElementSet::ElementSet(const Model& model) : model_(model), z_(model) {
  for (const Element& e : model.elements) {
    states_.emplace_back(e.acts ? e.markers.size() : 0, static_cast<std::size_t>(e.states));
    slots_.push_back(e.counts_turns() ? static_cast<int>(angles_.size()) : -1);
    if (e.counts_turns()) angles_.push_back(0.0);
  }
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    if (model.elements[k].acts) acting_.push_back(k);
    for (std::size_t i = 0; i < states_[k].markers(); ++i)
      wrenches_.emplace_back(model.elements[k].markers[i], &states_[k].wrench[i]);
  }
  kept_angles_ = angles_;
  branches_.assign(model.elements.size(), free_branch);
  for (const Input& input : model.inputs) inputs_.push_back(input.initial);
}

void ElementSet::connect(const std::vector<const MarkerState*>& markers) {
  assert(markers.size() == model_.markers.size());
  markers_.clear();
  for (const Element& e : model_.elements) {
    std::vector<const MarkerState*>& own = markers_.emplace_back();
    for (const int marker : e.markers) own.push_back(markers[static_cast<std::size_t>(marker)]);
  }
}

void ElementSet::count_turns_from(const Model& values, double t) noexcept {
  for (std::size_t k = 0; k < model_.elements.size(); ++k) {
    if (slots_[k] < 0) continue;
    assert(model_.elements[k].joint >= 0);
    const Joint& joint = values.joints[model_.elements[k].joint];
    const TimeFunction* motion = values.motion_of(joint);
    set_angle(k, motion                   ? floatframe::evaluate(*motion, t).f
                 : joint.position.empty() ? 0.0
                                          : joint.position[0]);
  }
}

}  // namespace floatframe

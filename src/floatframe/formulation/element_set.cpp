#include "floatframe/formulation/element_set.hpp"

#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

ElementSet::ElementSet(const Model& model) : model_(model) {
  for (const Element& e : model.elements) {
    states_.emplace_back(e.acts ? e.markers.size() : 0);
  }
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    if (model.elements[k].acts) acting_.push_back(k);
    for (std::size_t i = 0; i < states_[k].markers(); ++i)
      wrenches_.emplace_back(model.elements[k].markers[i], &states_[k].wrench[i]);
  }
  angles_.assign(model.elements.size(), 0.0);
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
    const Element& e = model_.elements[k];
    angles_[k] = 0.0;
    if (!e.counts_turns()) continue;
    const Joint& joint = values.joints[e.joint];
    if (const TimeFunction* motion = values.motion_of(joint))
      angles_[k] = floatframe::evaluate(*motion, t).f;
    else if (!joint.position.empty())
      angles_[k] = joint.position[0];
  }
}

}  // namespace floatframe

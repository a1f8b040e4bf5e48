#include "floatframe/formulation/force_set.hpp"

#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

ForceSet::ForceSet(const Model& model) : model_(model) {
  states_.resize(model.forces.size());
  angles_.assign(model.forces.size(), 0.0);
  kept_angles_ = angles_;
  branches_.assign(model.forces.size(), free_branch);
  for (const Input& input : model.inputs) inputs_.push_back(input.initial);
}

void ForceSet::count_turns_from(const Model& values, double t) noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    angles_[k] = 0.0;
    if (!f.rotational) continue;
    for (const Joint& joint : values.joints) {
      if (joint.frame_F != f.a || joint.frame_M != f.b) continue;
      if (joint.motion)
        angles_[k] = floatframe::evaluate(*joint.motion, t).f;
      else if (!joint.position.empty())
        angles_[k] = joint.position[0];
    }
  }
}

}  // namespace floatframe

// Inputs of the description: external signals that forces refer to by name.
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

void ModelBuilder::inputs() {
  for (const InputDescription& i : d.inputs) {
    Input input;
    input.name = i.name;
    input.unit = i.unit;
    input.initial = i.initial;
    input.clamp = i.clamp;
    if (i.low) input.low = *i.low;
    if (i.high) input.high = *i.high;
    model.inputs.push_back(std::move(input));
  }
}

int ModelBuilder::input_index(const std::string& name) const {
  for (std::size_t i = 0; i < model.inputs.size(); ++i)
    if (model.inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace floatframe

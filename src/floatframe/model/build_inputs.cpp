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

}  // namespace floatframe

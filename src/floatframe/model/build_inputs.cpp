// Inputs of the description: external signals that forces refer to by name.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

std::string number(double x) { return fmt::format("{:g}", x); }

}  // namespace

void ModelBuilder::inputs() {
  std::set<std::string> names;
  for (const InputDescription& i : d.inputs) {
    const std::string who = "inputs." + i.name;
    if (!names.insert(i.name).second)
      faults.add(i.origin.mark, who + ": the name is taken, expected a name used once");
    Input input;
    input.name = i.name;
    input.unit = i.unit;
    input.initial = i.initial;
    input.clamp = i.clamp;
    if (i.low) input.low = *i.low;
    if (i.high) input.high = *i.high;
    if (!(input.low < input.high))
      faults.add(i.origin.of("max"), who + ".max: found " + number(input.high) +
                                         ", expected a number above min, " + number(input.low));
    else if (!std::isfinite(i.initial) || i.initial < input.low || i.initial > input.high)
      faults.add(i.origin.of("initial"), who + ".initial: found " + number(i.initial) +
                                             ", expected a number from " + number(input.low) +
                                             " to " + number(input.high));
    if (i.clamp && !i.low && !i.high)
      faults.add(i.origin.of("clamp"),
                 who + ".clamp: found true without limits, expected min, max or both beside it");
    model.inputs.push_back(std::move(input));
  }
}

int ModelBuilder::input_index(const std::string& name, const SourceMark& mark,
                              const std::string& who) {
  if (name.empty()) return -1;
  for (std::size_t i = 0; i < model.inputs.size(); ++i)
    if (model.inputs[i].name == name) return static_cast<int>(i);
  faults.add(mark, who + ": found input '" + name + "', expected the name of an input");
  return -1;
}

}  // namespace floatframe

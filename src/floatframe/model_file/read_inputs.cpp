// Inputs: numbers that come from outside while a model runs.
#include "floatframe/model/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {

void read_inputs(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::input)) {
    InputDescription i;
    i.name = self.prefix + name;
    i.origin = s.origin();
    if (const auto v = s.get("unit"))
      if (const auto unit = v->text("a unit, for example N")) {
        const auto complaint = sentences::unit(*unit);
        if (complaint)
          v->error("found " + v->found() + ", " + *complaint);
        else
          i.unit = *unit;
      }
    const char* unit = i.unit.c_str();
    i.initial = s.number("initial", any_number(unit), 0.0);
    if (const auto v = s.get("min")) i.low = v->number(any_number(unit));
    if (const auto v = s.get("max")) i.high = v->number(any_number(unit));
    i.clamp = s.boolean("clamp", false);
    s.finish();
    if (const auto complaint = sentences::clamp_without_limits(i.clamp, i.low, i.high)) {
      s.get("clamp")->error(*complaint);
      continue;
    }
    if (const auto complaint = sentences::input_limits(i.low, i.high)) {
      s.get("max")->error(*complaint);
      continue;
    }
    if (const auto complaint = sentences::input_initial(i.initial, i.low, i.high)) {
      const auto v = s.get("initial");
      v ? v->error(*complaint) : s.error("initial: " + *complaint);
      continue;
    }
    model.description.inputs.push_back(std::move(i));
  }
}

}  // namespace floatframe

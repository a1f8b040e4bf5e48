// Inputs: numbers set externally while a model runs.
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {

void read_inputs(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::input)) {
    InputDescription i;
    i.name = self.prefix + name;
    i.origin = s.origin();
    if (const auto v = s.get("unit")) i.unit = v->text("a unit, for example N").value_or("");
    const char* unit = i.unit.c_str();
    i.initial = s.number("initial", any_number(unit), 0.0);
    if (const auto v = s.get("min")) i.low = v->number(any_number(unit));
    if (const auto v = s.get("max")) i.high = v->number(any_number(unit));
    i.clamp = s.boolean("clamp", false);
    s.finish();
    const std::size_t before = self.context.errors->size();
    validate_entity(s, i.origin,
                    [&](const validation::Entity& entity) { validation::input(i, entity); });
    if (self.context.errors->size() > before) continue;
    model.description.inputs.push_back(std::move(i));
  }
}

}  // namespace floatframe

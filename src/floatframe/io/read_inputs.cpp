// Inputs: numbers that come from outside while a model runs.
#include <algorithm>

#include "floatframe/io/read_parts.hpp"

namespace floatframe {

void read_inputs(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::input)) {
    InputDescription i;
    i.name = self.prefix + name;
    i.origin = s.origin();
    if (const auto v = s.get("unit"))
      if (const auto unit = v->text("a unit, for example N")) {
        const bool plain = std::all_of(unit->begin(), unit->end(), [](unsigned char c) {
          return c >= ' ' && c != '"' && c != ',' && c != '[' && c != ']' && c != 127;
        });
        if (!plain || unit->size() > 20)
          v->unexpected("a unit of at most 20 characters without commas, quotes and brackets");
        else
          i.unit = *unit;
      }
    const char* unit = i.unit.c_str();
    i.initial = s.number("initial", any_number(unit), 0.0);
    if (const auto v = s.get("min")) i.low = v->number(any_number(unit));
    if (const auto v = s.get("max")) i.high = v->number(any_number(unit));
    i.clamp = s.boolean("clamp", false);
    s.finish();
    if (i.clamp && !i.low && !i.high) {
      s.get("clamp")->fault("found true without limits, expected min, max or both beside it");
      continue;
    }
    if (i.low && i.high && !(*i.low < *i.high)) {
      s.get("max")->fault("found " + number_text(*i.high) + ", expected a number above min, " +
                          number_text(*i.low));
      continue;
    }
    if ((i.low && i.initial < *i.low) || (i.high && i.initial > *i.high)) {
      const auto v = s.get("initial");
      const std::string found =
          "found " + number_text(i.initial) + ", expected a number " +
          (i.low && i.initial < *i.low ? "not below min, " + number_text(*i.low)
                                       : "not above max, " + number_text(*i.high));
      v ? v->fault(found) : s.fault("initial: " + found);
      continue;
    }
    model.description.inputs.push_back(std::move(i));
  }
}

}  // namespace floatframe

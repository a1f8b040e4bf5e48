// Inputs.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"

namespace floatframe::validation {

namespace {

void initial_value(const InputDescription& i, const Entity& entity) {
  const auto complaint = sentences::input_initial(i.initial, i.low, i.high);
  if (!complaint) return;
  // A key that is missing in a file has no position.
  if (i.origin.keys.empty() || i.origin.keys.contains("initial"))
    entity.error(ErrorCode::out_of_range, "initial", *complaint);
  else
    entity.error(ErrorCode::out_of_range, "initial: " + *complaint);
}

}  // namespace

void input(const InputDescription& i, const Entity& entity) {
  if (const auto complaint = sentences::unit(i.unit))
    entity.error(ErrorCode::wrong_value, "unit", "found '" + i.unit + "', " + *complaint);
  const char* unit = i.unit.c_str();
  bool good = entity.number("initial", i.initial, any_number(unit));
  if (i.low) good = entity.number("min", *i.low, any_number(unit)) && good;
  if (i.high) good = entity.number("max", *i.high, any_number(unit)) && good;
  if (!good) return;
  if (const auto complaint = sentences::clamp_without_limits(i.clamp, i.low, i.high))
    entity.error(ErrorCode::out_of_range, "clamp", *complaint);
  else if (const auto limits = sentences::input_limits(i.low, i.high))
    entity.error(ErrorCode::contradiction, "max", *limits);
  else
    initial_value(i, entity);
}

void inputs(const ModelDescription& d, ErrorList& errors) {
  std::set<std::string> taken;
  for (const InputDescription& i : d.inputs) {
    const Entity entity{errors, i.origin, "inputs." + i.name};
    name("inputs", i.name, taken, entity);
    input(i, entity);
  }
}

}  // namespace floatframe::validation

#include "floatframe/sweep/sweep_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/description/simulation_option.hpp"
#include "floatframe/model_file/parsed_files.hpp"

namespace floatframe {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The reader reports external values as `--set`: replaces that by their actual origin.
std::vector<ErrorEntry> renamed(std::vector<ErrorEntry> errors,
                                const std::vector<SweepSetting>& fixed, const std::string& origin) {
  for (ErrorEntry& error : errors) {
    if (error.message.compare(0, 5, "--set") != 0) continue;
    bool from_option = false;
    for (const SweepSetting& s : fixed)
      from_option = from_option ||
                    error.message.compare(0, 6 + s.name.size(), "--set." + s.name) == 0 ||
                    error.message.compare(0, 6 + s.name.size(), "--set " + s.name) == 0;
    if (!from_option) error.message = origin + error.message.substr(5);
  }
  return errors;
}

}  // namespace

SweepCaseReader::SweepCaseReader(std::string model, const std::optional<std::string>& text,
                                 const std::vector<SweepSetting>& fixed, const SweepPlan& plan)
    : model_(std::move(model)), fixed_(fixed), plan_(plan) {
  // The file may be invalid with its own values and valid with those of the study: only its
  // parameters are read here.
  if (text) options_.text = &*text;
  options_.parsed = std::make_shared<ParsedFiles>();
  ModelFingerprint file;
  try {
    read_model(model_, {}, &file, options_);
  } catch (const InputError&) {
    if (file.model.empty()) throw;
  }
  parameters_ = file.parameters;
  ErrorList errors;
  for (const SweepSetting& s : fixed_) fixed_targets_.push_back(target(s.name, "--set", errors));
  for (const std::string& name : plan_.names) {
    const std::string& origin = plan_.origins.front();
    const bool table = origin != "--vary";
    targets_.push_back(target(name, table ? origin.substr(0, origin.rfind(':')) : origin, errors));
    for (const SweepSetting& s : fixed_)
      if (s.name == name)
        errors.add(ErrorCode::duplicate, {}, fmt::format("'{}' is both fixed and varied", name));
  }
  errors.throw_if_any();
}

SweepCaseReader::Target SweepCaseReader::target(const std::string& name, const std::string& subject,
                                                ErrorList& errors) const {
  const std::string prefix = "simulation.";
  const bool explicit_option = name.compare(0, prefix.size(), prefix) == 0;
  const std::string option = explicit_option ? name.substr(prefix.size()) : name;
  if (!explicit_option && contains(parameters_, name)) return {false, name};
  if (contains(simulation_option_names(), option)) return {true, option};
  std::vector<std::string> known = parameters_;
  known.insert(known.end(), simulation_option_names().begin(), simulation_option_names().end());
  errors.add(ErrorCode::unknown_key, {},
             fmt::format("{}: '{}' is neither a parameter of {} nor a simulation option{}", subject,
                         name, model_, did_you_mean(option, known)));
  return {};
}

void SweepCaseReader::apply(const Target& target, const std::string& value,
                            const std::string& subject, SimulationDescription& simulation,
                            SweepCase& out, ErrorList& errors) const {
  if (!target.option) return;
  const std::string error = set_simulation_option(simulation, target.name, value);
  if (!error.empty())
    errors.add(ErrorCode::wrong_value, {}, fmt::format("{}: {}: {}", subject, target.name, error));
  out.fingerprint.simulation =
      ContentHash().add(out.fingerprint.simulation).add(target.name).add(value).text();
}

SweepCase SweepCaseReader::read(std::size_t run) const {
  const std::vector<std::string>& values = plan_.runs[run];
  std::vector<ParameterOverride> overrides;
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    if (!fixed_targets_[k].option) overrides.push_back({fixed_[k].name, fixed_[k].value});
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!targets_[k].option) overrides.push_back({plan_.names[k], values[k]});
  SweepCase out;
  try {
    out.description = read_model(model_, overrides, &out.fingerprint, options_);
  } catch (const InputError& error) {
    throw InputError(renamed(error.errors(), fixed_, plan_.origins[run]));
  }
  ErrorList errors;
  SimulationDescription& simulation = out.description.simulation;
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    apply(fixed_targets_[k], fixed_[k].value, "--set", simulation, out, errors);
  for (std::size_t k = 0; k < values.size(); ++k)
    apply(targets_[k], values[k], plan_.origins[run], simulation, out, errors);
  const std::string error = simulation_error(simulation);
  if (!error.empty()) errors.add(ErrorCode::wrong_value, {}, error);
  errors.throw_if_any();
  check_inertia_method(out.description, simulation.inertia);
  return out;
}

}  // namespace floatframe

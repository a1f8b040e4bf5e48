// Options, start, steps, inputs and parameters of a handle.
#include "floatframe/c_interface/simulation_handle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/simulation_option.hpp"
#include "floatframe/model/input_value.hpp"

namespace floatframe {
namespace {

constexpr double largest_step = 1e6;  ///< [s]

template <class Entity>
std::vector<NamedColumn> columns_of(const std::vector<Entity>& entities) {
  std::vector<NamedColumn> columns;
  columns.reserve(entities.size());
  for (const Entity& e : entities) columns.push_back({e.name, e.unit, ""});
  return columns;
}

std::string wrong_index(const char* kind, std::int32_t index, std::int32_t count) {
  if (count == 0)
    return fmt::format("found index {} of an {}, but the model has no {}s", index, kind, kind);
  return fmt::format("found index {} of an {}, expected 0 to {}", index, kind, count - 1);
}

void set_option_of(SimulationDescription& simulation, const std::string& key,
                   const std::string& value) {
  const std::vector<std::string>& known = simulation_option_names();
  if (std::ranges::find(known, key) == known.end())
    throw InputError(ErrorCode::unknown_key,
                     fmt::format("unknown option '{}'{}", key, did_you_mean(key, known)));
  if (const std::string error = set_simulation_option(simulation, key, value); !error.empty())
    throw InputError(ErrorCode::wrong_value, fmt::format("{}: {}", key, error));
}

}  // namespace

OpenedModel opened_bytes(std::span<const std::byte> bytes) {
  OpenedModel opened{.packed = PackedModel::from_bytes(bytes), .model = {}};
  opened.model = opened.packed->build();
  return opened;
}

SimulationHandle::SimulationHandle(OpenedModel opened)
    : packed_(std::move(opened.packed)), name_(opened.model.name) {
  input_columns_.set(columns_of(opened.model.inputs));
  output_columns_.set(columns_of(opened.model.outputs));
  if (packed_) {
    std::vector<NamedColumn> columns;
    for (const PackedParameter& p : packed_->parameters()) {
      columns.push_back({p.name, p.unit, p.about});
      parameters_.push_back(p.value);
    }
    parameter_columns_.set(std::move(columns));
    fingerprint_ = packed_->fingerprint();
  }
  for (const Input& input : opened.model.inputs) initial_.push_back(input.initial);
  inputs_ = initial_;
  given_.assign(inputs_.size(), false);
  outputs_.assign(opened.model.outputs.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::string> expected = expectations(opened.model);
  adopt(std::move(opened.model), std::move(expected));
}

std::vector<std::string> SimulationHandle::expectations(const Model& model) {
  std::vector<std::string> expected;
  for (const Input& input : model.inputs) expected.push_back(input_expectation(input));
  return expected;
}

void SimulationHandle::adopt(Model&& model, std::vector<std::string>&& expected) noexcept {
  expected_inputs_ = std::move(expected);
  model_ = std::move(model);
  stale_ = false;
  if (!simulation_) follow_model(inputs_);
}

void SimulationHandle::follow_model(std::vector<double>& inputs) const noexcept {
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (!given_[k]) inputs[k] = model_.inputs[k].initial;
}

Model SimulationHandle::built(const std::vector<double>& parameters) const {
  Model model = packed_ ? packed_->build(parameters) : model_;
  for (const auto& [key, value] : options_) set_option_of(model.simulation, key, value);
  return model;
}

floatframe_status SimulationHandle::set_option(const char* key, const char* value) {
  if (key == nullptr || value == nullptr)
    throw InputError(ErrorCode::missing,
                     "found NULL, expected the name and the value of an option");
  if (simulation_)
    throw WrongOrder(fmt::format("found the option '{}' after the start, expected it before", key));
  SimulationDescription changed = model_.simulation;
  set_option_of(changed, key, value);
  options_.emplace_back(key, value);
  model_.simulation = std::move(changed);
  return FLOATFRAME_OK;
}

std::unique_ptr<Simulation> SimulationHandle::begun(Model& model,
                                                    const std::vector<double>& inputs) const {
  for (std::size_t k = 0; k < inputs.size(); ++k) model.inputs[k].initial = inputs[k];
  return std::make_unique<Simulation>(model);
}

void SimulationHandle::take(std::unique_ptr<Simulation> simulation, StartValues from) noexcept {
  simulation_ = std::move(simulation);
  start_ = std::move(from);
  failed_ = false;
  copy_outputs();
}

floatframe_status SimulationHandle::start() {
  if (stale_) {
    Model model = built(parameters_);
    std::vector<std::string> expected = expectations(model);
    adopt(std::move(model), std::move(expected));
  }
  std::vector<double> inputs = inputs_;
  follow_model(inputs);
  std::unique_ptr<Simulation> simulation = begun(model_, inputs);
  StartValues from{inputs, parameters_};
  std::vector<double> running = parameters_;
  std::vector<std::string> notes = simulation->start_report().notes;
  take(std::move(simulation), std::move(from));
  inputs_ = std::move(inputs);
  running_ = std::move(running);
  notes_ = std::move(notes);
  return FLOATFRAME_OK;
}

floatframe_status SimulationHandle::reset() noexcept {
  simulation_.reset();
  failed_ = false;
  notes_.clear();
  std::ranges::fill(outputs_, std::numeric_limits<double>::quiet_NaN());
  return FLOATFRAME_OK;
}

void SimulationHandle::copy_outputs() noexcept {
  std::ranges::copy(simulation_->outputs(), outputs_.begin());
}

void SimulationHandle::require_start(const char* what) const {
  if (!simulation_)
    throw WrongOrder(
        fmt::format("found {} before the start, expected floatframe_start first", what));
}

floatframe_status SimulationHandle::step() {
  require_start("a step");
  return end_of_step(simulation_->step());
}

floatframe_status SimulationHandle::step_by(double size) {
  require_start("a step");
  if (!(size > 0.0 && size <= largest_step)) {
    message.format("found a step of {:g} s, expected a positive number [s] of at most {:g}", size,
                   largest_step);
    return FLOATFRAME_INVALID;
  }
  return end_of_step(simulation_->step(size));
}

floatframe_status SimulationHandle::end_of_step(const StepReport& report) {
  if (report) {
    copy_outputs();
    return FLOATFRAME_OK;
  }
  if (report.status == StepStatus::invalid_step) {
    message.set(simulation_->failure());
    return FLOATFRAME_INVALID;
  }
  if (!failed_) {
    failed_ = true;
    failure_.set(step_status_name(report.status));  // if there is no memory for more
    failure_.set(simulation_->failure());
  }
  message = failure_;
  return FLOATFRAME_STEP_FAILED;
}

floatframe_status SimulationHandle::set_input(std::int32_t index, double value) {
  if (input_columns_.at(index) == nullptr)
    throw InputError(ErrorCode::out_of_range, wrong_index("input", index, input_columns_.count()));
  const Input& input = model_.inputs[index];
  const std::optional<double> accepted = accepted_value(input, value);
  if (!accepted) {
    message.format("input '{}': found {:g}, expected {}", input.name, value,
                   expected_inputs_[index]);
    return FLOATFRAME_INVALID;
  }
  if (simulation_) simulation_->set_input(index, *accepted);
  inputs_[index] = *accepted;
  given_[index] = true;
  if (*accepted == value) return FLOATFRAME_OK;
  message.format("input '{}': found {:g}, expected {}; {:g} is taken", input.name, value,
                 expected_inputs_[index], *accepted);
  return FLOATFRAME_WARNING;
}

/// False: the next start takes these parameters, and says if they give no model. Before the start
/// limits of inputs, their initial values and the step follow the parameters at once.
bool SimulationHandle::step_with(const std::vector<double>& parameters) {
  if (failed_) return false;
  try {
    Model changed = built(parameters);
    std::vector<std::string> expected = expectations(changed);
    std::vector<double> running = parameters;
    if (simulation_) simulation_->change_model(changed);
    adopt(std::move(changed), std::move(expected));
    running_ = std::move(running);
    return true;
  } catch (const InputError&) {
    if (simulation_) throw;
    return false;
  }
}

floatframe_status SimulationHandle::set_parameters(std::span<const std::int32_t> indices,
                                                   std::span<const double> values) {
  std::vector<double> wanted = parameters_;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const NamedColumn* column = parameter_columns_.at(indices[k]);
    if (column == nullptr)
      throw InputError(
          ErrorCode::out_of_range,
          packed_ ? wrong_index("adjustable parameter", indices[k], parameter_columns_.count())
                  : "found a parameter of a model file, expected a packed model: its "
                    "parameters take new values");
    if (!std::isfinite(values[k]))
      throw InputError(
          ErrorCode::not_finite,
          fmt::format("parameter '{}': found {:g}, expected a number{}", column->name, values[k],
                      column->unit.empty() ? "" : " [" + column->unit + "]"));
    wanted[indices[k]] = values[k];
  }
  if (wanted == parameters_) return FLOATFRAME_OK;
  stale_ = !step_with(wanted);
  parameters_ = std::move(wanted);
  return FLOATFRAME_OK;
}

}  // namespace floatframe

// Variables of an instance: their value references, what they are worth, and setting them.
#include <cmath>

#include "fmi/instance.hpp"

namespace floatframe::fmi {

Instance::Variable Instance::variable(std::uint32_t reference) const noexcept {
  if (reference == 0) return {Kind::time, 0};
  const std::int32_t index = std::int32_t(reference & 0xffff);
  const auto within = [index](Kind kind, std::int32_t count) {
    return index < count ? Variable{kind, index} : Variable{};
  };
  switch (reference >> 16) {
    case 1:
      return within(Kind::input, f_.input_count(simulation_));
    case 2:
      return within(Kind::output, f_.output_count(simulation_));
    case 3:
      return within(Kind::parameter, f_.parameter_count(simulation_));
    case 4:
      return within(Kind::figure, figure_count);
    default:
      return {};
  }
}

double Instance::value(Variable variable) const noexcept {
  switch (variable.kind) {
    case Kind::time:
      return time();
    case Kind::input:
      return f_.input(simulation_, variable.index);
    case Kind::output:
      return f_.output(simulation_, variable.index);
    case Kind::parameter:
      return f_.parameter(simulation_, variable.index);
    case Kind::figure:
      return figure(Figure(variable.index));
    case Kind::none:
      break;
  }
  return std::nan("");
}

double Instance::figure(Figure figure) const noexcept {
  const auto counted = [this](std::int64_t count) {
    return run_.needs_start ? 0.0 : double(count);
  };
  switch (figure) {
    case Figure::steps:
      return counted(f_.step_count(simulation_));
    case Figure::substeps:
      return counted(f_.substep_count(simulation_));
    case Figure::iterations:
      return counted(f_.iteration_count(simulation_));
    case Figure::overruns:
      return run_.overruns;
    case Figure::largest_share:
      return run_.largest_share;
  }
  return std::nan("");
}

double Instance::time() const noexcept {
  return run_.needs_start ? run_.start : f_.time(simulation_) + run_.shift;
}

Status Instance::get(const std::uint32_t* references, std::size_t count, double* values) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr)
    return fail("found NULL, expected %zu value references and values", count);
  Status status = Status::ok;
  for (std::size_t k = 0; k < count; ++k) {
    const Variable found = variable(references[k]);
    if (found.kind == Kind::none)
      return fail("found value reference %u, expected one of modelDescription.xml",
                  unsigned(references[k]));
    if (found.kind == Kind::output && run_.needs_start) {
      // In initialization mode outputs follow the inputs and parameters that have been set.
      if (state_ != State::initialization)
        return fail("found value reference %u: outputs have no values before the initialization",
                    unsigned(references[k]));
      const Status start = ensure_start();
      if (start == Status::error) return start;
      if (start == Status::warning) status = start;
    }
    values[k] = value(found);
  }
  return status;
}

Status Instance::set(const std::uint32_t* references, std::size_t count, const double* values) {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr)
    return fail("found NULL, expected %zu value references and values", count);
  for (std::size_t k = 0; k < count; ++k) {
    const Kind kind = variable(references[k]).kind;
    if (kind != Kind::input && kind != Kind::parameter)
      return fail("found value reference %u, expected that of an input or of a parameter",
                  unsigned(references[k]));
  }
  const Status status = set_parameters(references, count, values);
  return status == Status::error ? status : set_inputs(references, count, values, status);
}

/// First: limits of inputs may follow from them.
Status Instance::set_parameters(const std::uint32_t* references, std::size_t count,
                                const double* values) {
  indices_.clear();
  numbers_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const Variable found = variable(references[k]);
    if (found.kind != Kind::parameter) continue;
    indices_.push_back(found.index);
    numbers_.push_back(values[k]);
  }
  if (indices_.empty()) return Status::ok;
  // Before the first step they are part of a start, not a change of the model that moves.
  if (state_ != State::stepping) unstart();
  return worse(Status::ok,
               f_.set_parameters(simulation_, indices_.data(), numbers_.data(), indices_.size()));
}

/// A value outside of the limits is discarded, with all others of the call: nothing has changed.
/// Beside parameters, which are set by then, it is an error.
Status Instance::set_inputs(const std::uint32_t* references, std::size_t count,
                            const double* values, Status status) {
  const bool alone = indices_.empty();
  if (alone) numbers_.clear();  // the values before
  for (std::size_t k = 0; k < count; ++k) {
    const Variable found = variable(references[k]);
    if (found.kind == Kind::parameter) continue;
    if (alone) numbers_.push_back(f_.input(simulation_, found.index));
    const floatframe_status answer = f_.set_input(simulation_, found.index, values[k]);
    if (answer == FLOATFRAME_INVALID && alone && std::isfinite(values[k])) {
      log_.write(Status::discard, Category::warning, "%s: %s", function_, f_.message(simulation_));
      for (std::size_t j = k; j-- > 0;)
        f_.set_input(simulation_, variable(references[j]).index, numbers_[j]);
      return Status::discard;
    }
    status = worse(status, answer);
    if (status == Status::error) return status;
  }
  if (state_ != State::stepping) run_.needs_start = true;
  return status;
}

Status Instance::worse(Status status, floatframe_status found) noexcept {
  if (found == FLOATFRAME_OK) return status;
  if (found != FLOATFRAME_WARNING) return fail("%s", f_.message(simulation_));
  log_.write(Status::warning, Category::warning, "%s: %s", function_, f_.message(simulation_));
  return Status::warning;
}

Status Instance::access_none(const std::uint32_t* references, std::size_t count) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr) return fail("found NULL, expected %zu value references", count);
  return fail("found value reference %u, expected none: all variables are real numbers of 64 bits",
              unsigned(references[0]));
}

}  // namespace floatframe::fmi

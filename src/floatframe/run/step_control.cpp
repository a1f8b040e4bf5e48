#include "floatframe/run/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model/input_value.hpp"

namespace floatframe {
namespace {

long steps_in(double period, double step) {
  if (period == 0.0) return 1;
  const double steps = std::round(period / step);
  if (!(steps >= 1.0) || !(steps < 1e15) || !(std::abs(period / step - steps) < 1e-6 * steps))
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("period: found {:g} s, expected a multiple of the step of {:g} s",
                                 period, step));
  return std::lround(steps);
}

}  // namespace

StepControl::StepControl(Stepper& steps, const Controller& controller)
    : steps_(steps),
      controller_(controller),
      every_(steps_in(controller.period, steps.grid().step())),
      row_(steps.model().outputs.size() + 1, 0.0),
      wanted_(steps.model().inputs.size(), 0.0) {}

void StepControl::sampled(const double* row) noexcept {
  std::copy_n(row, row_.size(), row_.begin());
  current_ = true;
}

void StepControl::before_step(long made) {
  const bool current = std::exchange(current_, false);
  if (made % every_ != 0) return;
  if (!current) steps_.sample(row_.data());
  const std::span<const double> inputs = steps_.formulation().inputs();
  std::copy(inputs.begin(), inputs.end(), wanted_.begin());
  controller_.on_step(row_[0], std::span<const double>(row_).subspan(1), wanted_);
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    const Input& input = steps_.model().inputs[k];
    const auto value = accepted_value(input, wanted_[k]);
    if (!value)
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("input '{}': on_step gave {:g} at t = {:.9g} s, expected {}",
                                   input.name, wanted_[k], row_[0], input_expectation(input)));
    wanted_[k] = *value;
  }
  steps_.formulation().set_inputs(wanted_);
}

}  // namespace floatframe

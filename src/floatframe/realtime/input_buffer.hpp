#pragma once
// The values of a model's inputs in one run. A value that is not finite is rejected, and so is one
// outside the limits of its input, unless the input is clamped: then the nearer limit replaces it.
// A rejected value leaves the last valid one unchanged. Both are counted per input. Nothing here
// allocates after construction.
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "floatframe/model/input_value.hpp"

namespace floatframe {

class InputBuffer {
 public:
  explicit InputBuffer(const Model& model)
      : inputs_(model.inputs), refused_(model.inputs.size(), 0), clamped_(model.inputs.size(), 0) {
    for (const Input& input : inputs_) values_.push_back(input.initial);
  }

  std::size_t size() const noexcept { return values_.size(); }
  std::span<const double> values() const noexcept { return values_; }

  /// One value per input, in the order of the model. False: no value was finite, as if none had
  /// been received.
  bool accept(std::span<const double> received) noexcept {
    bool any = values_.empty();
    for (std::size_t i = 0; i < values_.size() && i < received.size(); ++i) {
      any = any || std::isfinite(received[i]);
      const std::optional<double> value = accepted_value(inputs_[i], received[i]);
      if (!value) {
        ++refused_[i];
        continue;
      }
      if (*value != received[i]) ++clamped_[i];
      values_[i] = *value;
    }
    return any;
  }

  /// Restores the initial values.
  void reset() noexcept {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = inputs_[i].initial;
  }

  /// Rejected values of an input so far.
  long refused(std::size_t input) const noexcept { return refused_[input]; }
  /// Values of an input that were replaced by a limit so far.
  long clamped(std::size_t input) const noexcept { return clamped_[input]; }

 private:
  const std::vector<Input>& inputs_;
  std::vector<double> values_;
  std::vector<long> refused_, clamped_;
};

}  // namespace floatframe

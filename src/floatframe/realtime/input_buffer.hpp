#pragma once
// The values of a model's inputs in one run. A value that is not finite or outside of its input's
// limits is refused: the last good one stays, and the refusal is counted by input. Nothing here
// allocates after construction.
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

class InputBuffer {
 public:
  explicit InputBuffer(const Model& model)
      : inputs_(model.inputs), refused_(model.inputs.size(), 0) {
    for (const Input& input : inputs_) values_.push_back(input.initial);
  }

  std::size_t size() const noexcept { return values_.size(); }
  std::span<const double> values() const noexcept { return values_; }

  /// One value an input, in the order of the model.
  void accept(std::span<const double> wanted) noexcept {
    for (std::size_t i = 0; i < values_.size() && i < wanted.size(); ++i) {
      const double x = wanted[i];
      if (std::isfinite(x) && x >= inputs_[i].low && x <= inputs_[i].high)
        values_[i] = x;
      else
        ++refused_[i];
    }
  }

  /// Back to the initial values.
  void reset() noexcept {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = inputs_[i].initial;
  }

  /// Refused values of an input so far.
  long refused(std::size_t input) const noexcept { return refused_[input]; }

 private:
  const std::vector<Input>& inputs_;
  std::vector<double> values_;
  std::vector<long> refused_;
};

}  // namespace floatframe

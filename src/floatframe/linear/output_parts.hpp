#pragma once
// Outputs of a linear system: formulas are differentiated exactly in what they refer to, so that
// only that is found by differences. Load time only.
#include <span>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

class OutputParts {
 public:
  explicit OutputParts(std::vector<Output> outputs);
  /// What is sampled: the outputs that are no formulas, and what the formulas refer to.
  const std::vector<Output>& parts() const noexcept { return parts_; }
  /// The outputs, from the values of the parts and of the inputs of the model at the time t.
  VecX values(const VecX& parts, std::span<const double> inputs, double t) const;
  /// Their derivative in the direction (dparts, dinputs).
  VecX derivatives(const VecX& parts, std::span<const double> inputs, double t, const VecX& dparts,
                   const VecX& dinputs) const;

 private:
  template <class S, class Part, class InputOf>
  std::vector<S> evaluated(const Part& part, const InputOf& input, double t) const;

  std::vector<Output> outputs_, parts_;
};

}  // namespace floatframe

#pragma once
// A Python function of (time, outputs, inputs) that is called before steps: a controller. It
// changes the array of inputs in place, or returns a map of inputs.
#include <unordered_map>

#include "bindings.hpp"

namespace floatframe::python {

class StepCallback {
 public:
  /// Throws InputError for what cannot be called. `period` [s]: 0 for every step.
  StepCallback(nb::object function, std::vector<std::string> inputs, std::size_t outputs,
               double period = 0.0);

  /// With the lock held. Throws the exceptions of Python, and InputError for what it returned.
  void operator()(double time, std::span<const double> outputs, std::span<double> inputs);
  const nb::object& function() const { return function_; }

 private:
  void take(const nb::object& returned, std::span<double> inputs) const;

  nb::object function_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> index_;
  double period_, next_ = 0.0;  ///< [s]
  bool called_ = false;
  /// Arrays are views of numbers that live as long as this and the last view, whatever is done to
  /// the arrays.
  std::shared_ptr<std::vector<double>> seen_numbers_, changed_numbers_;
  nb::object seen_, changed_;
};

/// The period of a controller: a positive number, or None for every step.
double period_of(nb::handle value);

}  // namespace floatframe::python

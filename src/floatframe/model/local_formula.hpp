#pragma once
// A formula of an actuator that reads nothing but the measure s of its own element, the rate of
// that, inputs and the time. It is a part of the law of the element, F(s, sdot, t), with its slopes
// in the rows of the step: no element of its own, whose signal would be a column of the tangent
// (formulation/signal_tangent.hpp). Step time: no heap, noexcept.
#include <string>

#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

/// Names of references to the measure and its rate; no user can write them.
inline constexpr const char* own_measure = "its measure";
inline constexpr const char* own_rate = "its rate";

/// Of a formula whose references are the time, inputs of the model and these. Allocates.
std::shared_ptr<const LocalFormula> local_formula(const Model& model, std::string name,
                                                  const SharedFormula& formula);

struct LocalFormulaValue {
  double f, by_measure, by_rate;
  double by_inputs;  ///< along `Ports::input_changes`
};
template <class S>
LocalFormulaValue local_formula_value(const PortsOf<S>& in, double s, double rate) noexcept;
/// The side of the switches, if they are the branches of the element.
BranchSide local_formula_side(const Ports& in, double s, double rate) noexcept;
/// Why it has no value; empty if it has one.
std::string local_formula_complaint(const Ports& in, double s, double rate);

/// The signal 0 of an element with the measure s, and its slopes.
template <class S>
struct ActuatorValue {
  S f = 0.0;
  double by_measure = 0.0, by_rate = 0.0;
};
template <class S>
ActuatorValue<S> actuator_of(const PortsOf<S>& in, const S& s, const S& rate) noexcept {
  ActuatorValue<S> out{in.signal(0).f};
  if (!in.element.signals[0].local) return out;
  const LocalFormulaValue y = local_formula_value(in, value_of(s), value_of(rate));
  out.f += chained(y.f, y.by_measure, s) + chained(0.0, y.by_rate, rate);
  if constexpr (!std::is_same_v<S, double>) out.f.d[0] += y.by_inputs;
  out.by_measure = y.by_measure;
  out.by_rate = y.by_rate;
  return out;
}

}  // namespace floatframe

#pragma once
// The switches of a formula as branches of the law of an element: held ones move their digits,
// those that the held ones do not reach are open.
#include <algorithm>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

inline FormulaSwitches switches_of_branch(std::int64_t branch) noexcept {
  FormulaSwitches switches;
  switches.held = std::max<std::int64_t>(branch, 0);
  return switches;
}

/// The side of this branch; `evaluate(switches, fault)` evaluates the formula.
template <class Evaluate>
BranchSide formula_branch_side(std::int64_t branch, const Evaluate& evaluate) noexcept {
  FormulaSwitches switches = switches_of_branch(branch);
  FormulaFault fault;
  evaluate(switches, fault);
  if (branch == free_branch || switches.crossed < 0) return {-1.0, switches.present};
  FormulaSwitches across;  // the others where they are, as far as they are reached
  across.held = FormulaSwitches::with(switches.present, switches.crossed, switches.next);
  fault = {};
  evaluate(across, fault);
  return {switches.beyond, across.present};
}

}  // namespace floatframe

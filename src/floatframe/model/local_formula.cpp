#include "floatframe/model/local_formula.hpp"

#include <algorithm>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {
namespace {

using Operand = LocalFormula::Operand;

/// With a direction each of the measure and its rate, and a third one of inputs, if N is 3.
template <int N, class S>
DualNumber<N> local_formula_dual(const PortsOf<S>& in, double s, double rate,
                                 FormulaSwitches& switches, FormulaFault& fault) noexcept {
  using Variable = DualNumber<N>;
  const LocalFormula& local = *in.element.signals[0].local;
  return evaluate_formula<Variable>(
      *local.formula,
      [&](int i) -> Variable {
        const LocalFormula::Reference& r = local.references[i];
        if (r.of == Operand::measure) return Variable::variable(s, 0);
        if (r.of == Operand::rate) return Variable::variable(rate, 1);
        if (r.of == Operand::time) return in.t;
        Variable u = in.inputs[r.input];
        if constexpr (N == 3) u.d[2] = in.input_changes[r.input];
        return u;
      },
      switches, fault);
}

FormulaSwitches held_switches(std::int64_t branch, bool switched) noexcept {
  FormulaSwitches switches;
  if (switched) switches.held = std::max<std::int64_t>(branch, 0);
  return switches;
}

}  // namespace

std::shared_ptr<const LocalFormula> local_formula(const Model& model, std::string name,
                                                  const SharedFormula& formula) {
  LocalFormula local{std::move(name), formula, {}};
  for (const FormulaReference& r : formula->references) {
    LocalFormula::Reference found;
    for (int k = 0; k < std::ssize(model.inputs); ++k)
      if (r.function.empty() && model.inputs[k].name == r.name) found = {Operand::input, k};
    if (r.function == own_measure) found.of = Operand::measure;
    if (r.function == own_rate) found.of = Operand::rate;
    local.references.push_back(found);
  }
  return std::make_shared<const LocalFormula>(std::move(local));
}

template <class S>
LocalFormulaValue local_formula_value(const PortsOf<S>& in, double s, double rate) noexcept {
  FormulaSwitches switches = held_switches(in.branch, in.element.switched);
  FormulaFault fault;
  if (in.input_changes) {
    const DualNumber<3> y = local_formula_dual<3>(in, s, rate, switches, fault);
    return {y.v, y.d[0], y.d[1], y.d[2]};
  }
  const DualNumber<2> y = local_formula_dual<2>(in, s, rate, switches, fault);
  return {y.v, y.d[0], y.d[1], 0.0};
}
template LocalFormulaValue local_formula_value(const Ports&, double, double) noexcept;
template LocalFormulaValue local_formula_value(const DualPorts&, double, double) noexcept;

BranchSide local_formula_side(const Ports& in, double s, double rate) noexcept {
  FormulaFault fault;
  FormulaSwitches switches = held_switches(in.branch, true);
  local_formula_dual<2>(in, s, rate, switches, fault);
  if (in.branch == free_branch || switches.crossed < 0) return {-1.0, switches.present};
  FormulaSwitches across;  // the others where they are, as far as they are reached
  across.held = FormulaSwitches::with(switches.present, switches.crossed, switches.next);
  local_formula_dual<2>(in, s, rate, across, fault);
  return {switches.beyond, across.present};
}

std::string local_formula_complaint(const Ports& in, double s, double rate) {
  FormulaSwitches switches = held_switches(in.branch, in.element.switched);
  FormulaFault fault;
  local_formula_dual<2>(in, s, rate, switches, fault);
  return fault_text(*in.element.signals[0].local->formula, fault);
}

SignalDescription ElementExample::local_signal(ExampleNumbers& numbers) {
  SignalDescription s = signal(numbers);
  Formula f = *formula("3 * sin(s) - 4 * rate + 2 * s * rate - 1e-2 * u * s + 5 * t");
  for (FormulaReference& r : f.references) {
    if (r.name == "s") r = {own_measure, "", ""};
    if (r.name == "rate") r = {own_rate, "", ""};
    if (r.name == "u") r.name = s.input;
  }
  s.formula = std::make_shared<const Formula>(std::move(f));
  return s;
}

}  // namespace floatframe

#include "floatframe/linear/output_parts.hpp"

#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {
namespace {

using Along = DualNumber<1>;

bool is_formula(const Output& o) { return o.type == OutputType::formula; }

Along along(double value, double change) {
  Along x(value);
  x.d[0] = change;
  return x;
}

}  // namespace

OutputParts::OutputParts(std::vector<Output> outputs) : outputs_(std::move(outputs)) {
  for (const Output& o : outputs_) {
    if (!is_formula(o)) {
      parts_.push_back(o);
      continue;
    }
    for (const FormulaOperand& x : o.formula->operands) {
      if (x.kind != FormulaOperand::Kind::sample) continue;
      parts_.push_back(x.output);
      parts_.back().name = o.name;
    }
  }
}

template <class S, class Part, class InputOf>
std::vector<S> OutputParts::evaluated(const Part& part, const InputOf& input, double t) const {
  std::vector<S> out;
  int next = 0;
  for (const Output& o : outputs_) {
    if (!is_formula(o)) {
      out.push_back(part(next++));
      continue;
    }
    std::vector<S> operands;
    for (const FormulaOperand& x : o.formula->operands)
      operands.push_back(x.kind == FormulaOperand::Kind::time ? S(t)
                         : x.kind == FormulaOperand::Kind::input
                             ? input(x.index)
                             : S(x.factor * part(next++) + x.offset));
    FormulaSwitches switches;
    FormulaFault fault;
    out.push_back(o.factor *
                  evaluate_formula<S>(
                      *o.formula->formula, [&](int i) { return operands[i]; }, switches, fault));
  }
  return out;
}

VecX OutputParts::values(const VecX& parts, std::span<const double> inputs, double t) const {
  const std::vector<double> y =
      evaluated<double>([&](int i) { return parts[i]; }, [&](int k) { return inputs[k]; }, t);
  return VecX::ConstMapType(y.data(), std::ssize(y));
}

VecX OutputParts::derivatives(const VecX& parts, std::span<const double> inputs, double t,
                              const VecX& dparts, const VecX& dinputs) const {
  const std::vector<Along> y =
      evaluated<Along>([&](int i) { return along(parts[i], dparts[i]); },
                       [&](int k) { return along(inputs[k], dinputs[k]); }, t);
  VecX dy(std::ssize(y));
  for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = y[k].d[0];
  return dy;
}

}  // namespace floatframe

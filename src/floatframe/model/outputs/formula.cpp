// The value of a formula of other outputs, inputs and the time at a sample.
#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

double sampled_formula(const SystemMotion& motion, const OutputFormula& f,
                       std::vector<FollowedOutput>& parts) noexcept {
  FormulaSwitches switches;
  FormulaFault fault;
  assert(parts.size() == f.operands.size());
  return evaluate_formula<double>(
      *f.formula,
      [&](int i) {
        const FormulaOperand& x = f.operands[i];
        if (x.kind == FormulaOperand::Kind::time) return motion.t;
        if (x.kind == FormulaOperand::Kind::input) return motion.inputs[x.index];
        return x.factor * output_value(motion, x.output, parts[i]) + x.offset;
      },
      switches, fault);
}

template <>
double output_value_of<OutputType::formula>(const SystemMotion& motion, const Output& output,
                                            FollowedOutput& last) noexcept {
  return sampled_formula(motion, *output.formula, last.parts);
}

constinit const OutputKind formula_output = {
    .about = "value of a formula of measures, other outputs, inputs and the time",
    .of = OutputOf::formula,
    .unit = "-",
    .named_unit = true};

}  // namespace floatframe

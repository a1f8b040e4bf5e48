// The value of a formula of other outputs, inputs and the time at a sample. Where it has none the
// column has no number, and a run says so.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

/// In the memory of an output, behind what `Crossing` keeps: the first fault. Saved states hold
/// finite numbers only.
struct UndefinedSample {
  enum Memory : std::size_t { kind = 3, step, at };

  static void keep(const FormulaFault& fault, double t, FollowedOutput& last) noexcept {
    if (fault.kind == FormulaFault::Kind::none || last.values[kind] != 0.0) return;
    constexpr double most = std::numeric_limits<double>::max();
    last.values[kind] = static_cast<double>(fault.kind);
    last.values[step] = fault.step;
    last.values[at] = std::isnan(fault.at) ? 0.0 : std::clamp(fault.at, -most, most);
    last.time = t;
  }
};

}  // namespace

double sampled_formula(const SystemMotion& motion, const OutputFormula& f,
                       FollowedOutput& last) noexcept {
  FormulaSwitches switches;
  FormulaFault fault;
  assert(last.parts.size() == f.operands.size());
  const double value = evaluate_formula<double>(
      *f.formula,
      [&](int i) {
        const FormulaOperand& x = f.operands[i];
        if (x.kind == FormulaOperand::Kind::time) return motion.t;
        if (x.kind == FormulaOperand::Kind::input) return motion.inputs[x.index];
        return x.factor * output_value(motion, x.output, last.parts[i]) + x.offset;
      },
      switches, fault);
  UndefinedSample::keep(fault, motion.t, last);
  return value;
}

std::string undefined_sample(const OutputFormula& f, const FollowedOutput& last) {
  FormulaFault fault;
  const double kind = last.values[UndefinedSample::kind], step = last.values[UndefinedSample::step],
               steps = static_cast<double>(f.formula->sources.size());
  // Zero: none. A saved state may hold any numbers.
  if (!(kind >= 1.0 && kind <= 3.0 && step >= 0.0 && step < steps)) return {};
  fault.kind = static_cast<FormulaFault::Kind>(kind);
  fault.step = static_cast<int>(step);
  fault.at = last.values[UndefinedSample::at];
  return fmt::format("{} at t = {:.6g} s", fault_text(*f.formula, fault), last.time);
}

template <>
double output_value_of<OutputType::formula>(const SystemMotion& motion, const Output& output,
                                            FollowedOutput& last) noexcept {
  return sampled_formula(motion, *output.formula, last);
}

constinit const OutputKind formula_output = {
    .about = "value of a formula of measures, other outputs, inputs and the time",
    .of = OutputOf::formula,
    .unit = "-",
    .named_unit = true};

}  // namespace floatframe

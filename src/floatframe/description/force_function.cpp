#include "floatframe/description/force_function.hpp"

#include <fmt/format.h>

#include <atomic>
#include <random>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {
namespace {

/// Differs between functions of a process, and between processes.
std::string unique_identity() {
  static const std::string process = [] {
    std::random_device random;
    return fmt::format("{:08x}{:08x}{:08x}", random(), random(), random());
  }();
  static std::atomic<long> count{0};
  return fmt::format("function {} of {}", ++count, process);
}

}  // namespace

ForceFunction::ForceFunction(Law law, std::string label, int)
    : law_(std::move(law)), identity_(label.empty() ? unique_identity() : std::move(label)) {}

ForceFunction ForceFunction::of(const SharedFormula& formula) {
  using Variable = DualNumber<2>;  // by x and v
  std::vector<int> of_reference;   // 0: x, 1: v, 2: the time
  for (const FormulaReference& r : formula->references) {
    const bool is_known = r.is_time() || (r.function.empty() && (r.name == "x" || r.name == "v"));
    if (!is_known)
      throw InputError(
          ErrorCode::not_found,
          sentences::formula_of_law(r.function.empty() ? r.name : r.function + "(" + r.name + ")"));
    of_reference.push_back(r.is_time() ? 2 : r.name == "v");
  }
  ForceFunction out(
      [formula, of_reference](double x, double v, double t) -> ForceLawValue {
        FormulaSwitches switches;
        FormulaFault fault;
        const Variable all[] = {Variable::variable(x, 0), Variable::variable(v, 1), t};
        const Variable y = evaluate_formula<Variable>(
            *formula, [&](int i) -> const Variable& { return all[of_reference[i]]; }, switches,
            fault);
        return {y.v, y.d[0], y.d[1]};
      },
      "formula " + formula->text);
  out.formula_ = formula;
  return out;
}

}  // namespace floatframe

#include "floatframe/roads/height_formula.hpp"

#include <algorithm>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/roads/surface_jet.hpp"

namespace floatframe {

std::string height_formula_complaint(const Formula& formula) {
  for (const FormulaReference& r : formula.references)
    if (!r.function.empty() || (r.name != "x" && r.name != "y"))
      return "found '" + (r.function.empty() ? r.name : r.function) +
             "' in a formula of a height, expected x and y alone";
  if (std::ranges::any_of(formula.steps,
                          [](const FormulaStep& s) { return s.op == FormulaOp::grid; }))
    return "found 'table2' in a formula of a height, expected the key 'grid' of the road";
  return {};
}

SurfacePoint formula_height(const Formula& formula, double x, double y) noexcept {
  FormulaSwitches switches;
  FormulaFault fault;
  const auto variable = [&](int k) noexcept {
    return formula.references[k].name == "x" ? SurfaceJet(x, 1.0, 0.0, 0.0, 0.0, 0.0)
                                             : SurfaceJet(y, 0.0, 1.0, 0.0, 0.0, 0.0);
  };
  const auto z = evaluate_formula<SurfaceJet>(formula, variable, switches, fault);
  return {z.f, z.x, z.y, z.xx, z.xy, z.yy, 1.0};
}

}  // namespace floatframe

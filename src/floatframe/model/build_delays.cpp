// What formulas delay, as elements of their own.
#include <algorithm>

#include "floatframe/model/model_builder.hpp"

namespace floatframe {

std::string delay_name(const std::string& owner, const Formula& f, const FormulaReference& r) {
  const auto number =
      std::count_if(f.references.data(), &r, [](const FormulaReference& x) { return x.delayed; });
  return owner + "/delay" + (number > 0 ? std::to_string(number + 1) : "");
}

void ModelBuilder::delays_apart(const Formula& f, const std::string& owner,
                                const InnerFormula& inner) {
  for (const FormulaReference& r : f.references) {
    if (!r.delayed) continue;
    Delay keys;
    keys.input.formula = r.delayed;
    keys.time = r.delay;
    const ElementDescription e{delay_name(owner, f, r), keys, inner.element.origin};
    const std::size_t before = formulas.size();
    const ElementDescription apart = with_formulas_apart(e, ElementList::controllers);
    if (formulas.size() > before) formulas.back().path = inner.path;
    formulas.push_back({apart, inner.path});
  }
}

void ModelBuilder::delays_apart() {
  for (const ElementDescription& e : d.controllers)
    if (const auto* value = std::get_if<FormulaValue>(&e.kind))
      delays_apart(*value->formula, e.name, {e, "controllers." + e.name + ".formula"});
  for (const auto& [list, name] : {std::pair(&d.outputs, "outputs."), {&d.measures, "measures."}})
    for (const OutputDescription& o : *list)
      if (o.formula)
        delays_apart(*o.formula, name + o.name, {{"", {}, o.origin}, name + o.name + ".formula"});
  if (const SharedFormula& until = d.simulation.until)
    delays_apart(*until, "simulation", {{"", {}, d.simulation.origin}, "simulation.until"});
  for (std::size_t k = 0; k < formulas.size(); ++k) {  // also of those that are added: nested ones
    const InnerFormula inner = formulas[k];
    if (const auto* value = std::get_if<FormulaValue>(&inner.element.kind))
      delays_apart(*value->formula, inner.element.name, inner);
  }
}

}  // namespace floatframe

// Notes about formulas: what they read too late, where they have corners or jumps.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/hint_list.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

void hint_at_samples(const Model& model, HintList& out) {
  for (const Element& e : model.elements) {
    std::string names;
    for (const FormulaOperand& x : e.operands)
      if (x.kind == FormulaOperand::Kind::sample)
        names += (names.empty() ? "'" : ", '") + x.output.name + "'";
    if (!names.empty())
      out.add("formula", e.name,
              "reads " + names +
                  " of the end of the step before: results are of first order in the step, and "
                  "linear systems hold them constant");
  }
}

bool is_rate(const Model& model, const Element& e, const FormulaOperand& x) {
  if (x.kind == FormulaOperand::Kind::link)
    return model.links[e.signals[x.index].link].quantity == ElementQuantity::rate;
  if (x.kind != FormulaOperand::Kind::measure) return false;
  const std::string unit = output_kind(x.output.type).unit;
  return unit.find("/s") != std::string::npos && unit.find("/s2") == std::string::npos;
}

/// A jump at a rate: friction that sticks there has one edge after the other.
bool may_stick(const Formula& f, const auto& reads_rate) {
  return std::ranges::any_of(f.kinks, [&](const FormulaKink& kink) {
    return std::ranges::any_of(kink.references, reads_rate) && jumps_at(f, kink);
  });
}

/// "'floor' and 'table'", of the kinks that no step ends at.
std::string words_not_found(const Formula& f, bool of_time) {
  std::vector<std::string> words;
  for (const FormulaKink& kink : f.kinks)
    if ((of_time ? !kink.between_pieces() : kink.held < 0) &&
        std::ranges::find(words, kink.word) == words.end())
      words.push_back(kink.word);
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "'" : k + 1 < words.size() ? ", '" : " and '") + words[k] + "'";
  return text;
}

void hint_at_words(const std::string& name, const Formula& f, bool of_time, HintList& out) {
  if (const std::string words = words_not_found(f, of_time); !words.empty())
    out.add("formula", name,
            fmt::format("has corners or jumps of {} that steps cross, also with locate_edges: "
                        "results there are of first order in the step",
                        words));
}

void hint_at_kinks(const std::string& name, const Formula& f, bool sticks, bool located,
                   HintList& out) {
  if (sticks)
    out.add("formula", name,
            "jumps with a rate, as friction does: where that sticks no step ends at the jump, also "
            "with locate_edges; the width of sign(x, w), the friction of a joint and "
            "bristle_friction do without the jump");
  else if (!located && std::ranges::any_of(f.kinks, [](const auto& k) { return k.held >= 0; }))
    out.add("formula", name,
            "has corners or jumps (comparisons, clip, min, max, abs, sign) that steps cross; "
            "locate_edges: true divides steps there");
  hint_at_words(name, f, false, out);
}

}  // namespace

void hint_at_formulas(const Model& model, bool located, HintList& out) {
  hint_at_samples(model, out);
  for (const Element& e : model.elements) {
    for (const ElementSignal& s : signals_of(e))
      if (const SharedFormula& f = s.signal->function.formula)
        hint_at_words(e.name + "/" + s.what, *f, true, out);
    for (const Signal& s : e.signals)
      if (s.local) {
        const Formula& f = *s.local->formula;
        const auto reads_rate = [&](int i) {
          return s.local->references[i].of == LocalFormula::Operand::rate;
        };
        hint_at_kinks(s.local->name, f, may_stick(f, reads_rate), located, out);
      }
    if (const auto* keys = std::get_if<ForceLaw>(e.keys.get()); keys && keys->law.formula()) {
      const Formula& f = *keys->law.formula();
      const auto reads_rate = [&](int i) { return f.references[i].name == "v"; };
      hint_at_kinks(e.name, f, may_stick(f, reads_rate), located, out);
    }
    if (const auto* keys = std::get_if<FormulaValue>(e.keys.get())) {
      const auto reads_rate = [&](int i) { return is_rate(model, e, e.operands[i]); };
      hint_at_kinks(e.name, *keys->formula, may_stick(*keys->formula, reads_rate), located, out);
    }
  }
}

}  // namespace floatframe

#include "floatframe/formats/equation_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/limited_errors.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

/// Adds terms of equal degrees of freedom up and leaves out those that cancel. There may be
/// millions of equations, so `terms` is used again.
void add_up(const LinearEquation& e, std::vector<LinearEquation::Term>& terms) {
  const auto place = [](const LinearEquation::Term& t) { return std::pair{t.node, t.axis}; };
  terms = e.terms;
  std::sort(terms.begin(), terms.end(),
            [&](const auto& a, const auto& b) { return place(a) < place(b); });
  double scale = 0.0;
  std::size_t count = 0;
  for (const LinearEquation::Term& t : terms) {
    scale = std::max(scale, std::abs(t.factor));
    if (count > 0 && place(terms[count - 1]) == place(t))
      terms[count - 1].factor += t.factor;
    else
      terms[count++] = t;
  }
  terms.resize(count);
  std::erase_if(terms, [&](const auto& t) { return std::abs(t.factor) <= 1e-12 * scale; });
}

/// Equations of one line for a set of nodes share one note.
void note_empty(FeModel& model, const std::map<std::pair<int, int>, long>& empty) {
  for (const auto& [place, count] : empty) {
    const SourceMark mark = model.mark({place.first, place.second});
    model.notes.push_back(fmt::format(
        "{}:{}: {} 0 = 0, since {} terms cancel: left out", mark.file, mark.line,
        count == 1 ? std::string("the equation says") : fmt::format("{} equations say", count),
        count == 1 ? "its" : "their"));
  }
}

}  // namespace

void check_equations(FeModel& model) {
  if (model.equations.empty() || model.matrices) return;
  const std::vector<int> dofs = dofs_without_springs(model);
  std::map<std::pair<int, int>, long> empty;  // by file and line
  LimitedErrors errors;
  std::vector<LinearEquation::Term> sums;
  std::erase_if(model.equations, [&](const LinearEquation& e) {
    add_up(e, sums);
    if (sums.empty()) {
      ++empty[{e.source.file, e.source.line}];
      return true;
    }
    const auto& [node, axis, factor] = sums.front();
    if (sums.size() == 1 && axis < dofs[node + 1])
      errors.add(ErrorCode::unsupported, "equations", model.mark(e.source),
                 "the equation holds {} of {} to the ground, to which a part that floats cannot be "
                 "tied: take it out",
                 node_dof_names[axis], model.node_label(node));
    return false;
  });
  note_empty(model, empty);
  errors.throw_if_any();
}

}  // namespace floatframe

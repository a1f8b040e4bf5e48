#include "floatframe/formats/equation_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/limited_errors.hpp"
#include "floatframe/fe/node_dof_names.hpp"

namespace floatframe {
namespace {

/// Factors of the degrees of freedom that are left once equal ones are added.
std::map<std::pair<int, int>, double> added_up(const LinearEquation& e) {
  std::map<std::pair<int, int>, double> sums;
  double scale = 0.0;
  for (const LinearEquation::Term& t : e.terms) {
    sums[{t.node, t.axis}] += t.factor;
    scale = std::max(scale, std::abs(t.factor));
  }
  std::erase_if(sums, [&](const auto& s) { return std::abs(s.second) <= 1e-12 * scale; });
  return sums;
}

/// Equations of one line for a set of nodes have one note.
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

void look_at_equations(FeModel& model) {
  if (model.equations.empty() || model.matrices) return;
  const std::vector<int> dofs = dofs_without_springs(model);
  std::map<std::pair<int, int>, long> empty;  // by file and line
  LimitedErrors errors;
  std::erase_if(model.equations, [&](const LinearEquation& e) {
    const auto sums = added_up(e);
    if (sums.empty()) {
      ++empty[{e.source.file, e.source.line}];
      return true;
    }
    const auto& [node, axis] = sums.begin()->first;
    if (sums.size() == 1 && axis < dofs[node + 1])
      errors.add("equations", model.mark(e.source),
                 fmt::format("the equation holds {} of {} to the ground, to which a part that "
                             "floats cannot be tied: take it out",
                             node_dof_names[axis], model.node_label(node)));
    return false;
  });
  note_empty(model, empty);
  errors.throw_if_any();
}

}  // namespace floatframe

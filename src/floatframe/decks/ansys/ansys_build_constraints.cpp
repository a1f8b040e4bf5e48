// Constraint equations, coupled degrees of freedom, supports, components.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/decks/ansys/ansys_build.hpp"

namespace floatframe {
namespace {

/// A term in the axes of the body.
void add_term(const AnsysBuild& b, int node, int axis, double factor, LinearEquation& equation) {
  if (!b.content.node_angles.contains(node)) {
    equation.terms.push_back({node, axis, factor});
    return;
  }
  const Vec3 direction = b.nodal_axes(node).col(axis % 3);
  for (int k = 0; k < 3; ++k)
    if (const double x = factor * direction(k); std::abs(x) > 1e-15 * std::abs(factor))
      equation.terms.push_back({node, axis >= 3 ? 3 + k : k, x});
}

/// Members of a component as indices; a negative number ends a range.
class AnsysMembers {
 public:
  explicit AnsysMembers(std::vector<std::pair<int, int>> number_and_index)
      : sorted_(std::move(number_and_index)) {
    std::sort(sorted_.begin(), sorted_.end());
  }
  /// An end that is not there, 0 if both are; between them there may be gaps.
  int append(int first, int last, std::vector<int>& out) const {
    auto it = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{first, -1});
    if (it == sorted_.end() || it->first != first) return first;
    int reached = 0;
    for (; it != sorted_.end() && it->first <= last; ++it) {
      if (it->second >= 0) out.push_back(it->second);
      reached = it->first;
    }
    return reached == last ? 0 : last;
  }

 private:
  std::vector<std::pair<int, int>> sorted_;
};

/// Of a range or alone; `missing`: the one that is not there.
void refuse_member(AnsysBuild& b, const AnsysComponent& component, int first, int last,
                   int missing) {
  const char* const what = component.elements ? "element" : "node";
  std::string text = fmt::format("component {} has ", component.name);
  if (last != first) text += fmt::format("{}s {} to {}, ", what, first, last);
  if (last < first) {
    text += "expected numbers that rise";
  } else {
    text += fmt::format("{}{} {}{} is not in the file", last != first ? "of which " : "", what,
                        missing, last != first ? "" : ", which");
  }
  b.source.error(ErrorCode::wrong_value, component.at, text);
}

}  // namespace

void build_ansys_equations(AnsysBuild& b) {
  for (const auto& [number, raw] : b.content.equations) {
    const std::string who = fmt::format("CE {}", number);
    if (raw.constant != 0.0) {
      b.source.error(ErrorCode::unsupported, raw.at,
                     "{}: its constant is {:g}, only equations that sum to 0 are read", who,
                     raw.constant);
      continue;
    }
    LinearEquation equation;
    equation.source = raw.at;
    bool known = true;
    for (const AnsysTerm& term : raw.terms) {
      const int node = b.node(term.node, raw.at, who);
      known = known && node >= 0;
      if (node >= 0 && term.factor != 0.0) add_term(b, node, term.axis, term.factor, equation);
    }
    if (known && !equation.terms.empty()) b.model.equations.push_back(std::move(equation));
  }
  for (const auto& [number, raw] : b.content.couplings) {
    const std::string who = fmt::format("CP {}", number);
    const int first = raw.nodes.empty() ? -1 : b.node(raw.nodes[0], raw.at, who);
    for (std::size_t k = 1; k < raw.nodes.size() && first >= 0; ++k) {
      const int node = b.node(raw.nodes[k], raw.at, who);
      if (node < 0 || node == first) continue;
      LinearEquation equation;
      equation.source = raw.at;
      add_term(b, node, raw.axis, 1.0, equation);
      add_term(b, first, raw.axis, -1.0, equation);
      b.model.equations.push_back(std::move(equation));
    }
  }
}

void build_ansys_supports(AnsysBuild& b) {
  for (const auto& [term, at] : b.content.supports) {
    const int node = b.node(term.node, at, "D");
    if (node < 0) continue;
    unsigned mask = 0;
    for (int axis = 0; axis < 6; ++axis) {
      if (term.axis >= 0 && term.axis != axis) continue;
      // A turned direction is a hint only where it lies along an axis of the body.
      const Vec3 direction = b.nodal_axes(node).col(axis % 3);
      for (int k = 0; k < 3; ++k)
        if (std::abs(direction(k)) > 1.0 - 1e-9 || term.axis < 0)
          mask |= 1u << (axis >= 3 ? 3 + k : k);
    }
    if (mask == 0) continue;
    auto& all = b.model.supports;
    if (!all.empty() && all.back().node == node) {
      all.back().mask |= mask;
    } else {
      all.push_back({node, mask, at});
    }
  }
}

void build_ansys_components(AnsysBuild& b) {
  std::vector<std::pair<int, int>> elements;
  for (std::size_t k = 0; k < b.content.elements.size(); ++k)
    elements.emplace_back(b.content.elements[k].id, b.index[k]);
  const AnsysMembers of_nodes({b.content.node_index.begin(), b.content.node_index.end()}),
      of_elements(std::move(elements));
  // A few bytes can name all nodes again and again.
  const std::size_t most =
      10'000'000 + 100 * (b.content.elements.size() + b.model.positions.size());
  std::size_t spent = 0;
  for (const AnsysComponent& component : b.content.components) {
    std::vector<int> found;
    const auto& members = component.members;
    const AnsysMembers& all = component.elements ? of_elements : of_nodes;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const int first = members[k];
      const bool range = k + 1 < members.size() && members[k + 1] < 0;
      const int last = range ? -members[++k] : first;
      const int missing = first < 1 || last < first ? first : all.append(first, last, found);
      if (missing != 0) refuse_member(b, component, first, last, missing);
      if (spent + found.size() > most)
        b.source.stop(ErrorCode::too_large, component.at,
                      "the components have more than {} members in all, too many for a file of {} "
                      "nodes and {} elements",
                      most, b.model.nodes(), b.content.elements.size());
    }
    spent += found.size();
    if (found.empty()) continue;
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    (component.elements ? b.model.element_sets : b.model.node_sets)[component.name] = found;
  }
}

}  // namespace floatframe

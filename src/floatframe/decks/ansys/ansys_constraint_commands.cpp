// Constraint equations, coupled degrees of freedom, rigid regions, supports: their commands, and
// their form in the model; components.
#include <algorithm>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::array ansys_axes = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

int axis_of(AnsysFields& f, std::size_t k) {
  const int axis = ansys_axis(f.text(k));
  if (axis < 0)
    f.stop(ErrorCode::wrong_value, "{}: expected a degree of freedom UX to ROTZ, found {}",
           f.command(), shown(f.text(k)));
  return axis;
}

/// Node, label and factor from field 3 on.
void append_terms(AnsysFields& f, AnsysEquation& e) {
  for (std::size_t k = 3; k < f.size() && !f.blank(k); k += 3)
    e.terms.push_back({f.label(k, "the node"), axis_of(f, k + 1), f.real(k + 2, "the factor")});
}

/// A number, or NEXT: one above all others; HIGH: the highest.
template <typename Map>
int number_in(AnsysFields& f, std::size_t k, const Map& map) {
  const int highest = map.empty() ? 0 : map.rbegin()->first;
  if (f.word(k) == "NEXT") return highest + 1;
  if (f.word(k) == "HIGH") return std::max(highest, 1);
  return f.label(k, "the number of the set");
}

/// Requirement of a constraint on a whole selection.
void refuse_selection(AnsysFields& f, std::size_t k) {
  const std::string word = f.word(k);
  if (f.number(k) || word.empty()) return;
  f.stop(ErrorCode::unsupported,
         "{}: {} needs the selection or component of the session, only numbers of nodes are read; "
         "write the model with CDWRITE",
         f.command(), shown(f.text(k)));
}

/// CE,R5.0,DEFI,number,terms,constant and CE,R5.0,NODE,node,label,factor,...;
/// CE,number,constant,node,label,factor,...
void read_ansys_equation(AnsysFields& f, AnsysContent& c) {
  if (!ansys_written(f)) {
    const int number = number_in(f, 1, c.equations);
    refuse_selection(f, 3);
    AnsysEquation& e = c.equations[number];
    e.at = f.at();
    e.constant = f.real(2, "the constant");
    return append_terms(f, e);
  }
  if (f.word(2) == "DEFI") {
    c.constraint = f.label(3, "the number of the equation");
    c.equations[c.constraint] = {{}, f.real(5, "the constant"), f.at()};
    return;
  }
  if (f.word(2) != "NODE" || c.equations.empty())
    f.stop(ErrorCode::wrong_value, "CE: expected DEFI, then NODE, found {}", shown(f.text(2)));
  append_terms(f, c.equations[c.constraint]);
}

/// CP,R5.0,DEFI,number,...,label and CP,R5.0,NODE,nodes; CP,number,label,nodes.
void read_ansys_coupling(AnsysFields& f, AnsysContent& c) {
  const bool written = ansys_written(f);
  if (written && f.word(2) == "NODE") {
    if (c.couplings.empty())
      f.stop(ErrorCode::contradiction, "CP: NODE, but there is no DEFI before");
  } else {
    const std::size_t at = written ? 3 : 1;
    c.constraint = number_in(f, at, c.couplings);
    AnsysCoupling& coupling = c.couplings[c.constraint];
    coupling.at = f.at();
    std::size_t label = at + 1;
    while (written && label + 1 < f.size() && ansys_axis(f.text(label)) < 0) ++label;
    coupling.axis = axis_of(f, label);
    if (written) return;
  }
  AnsysCoupling& coupling = c.couplings[c.constraint];
  for (std::size_t k = 3; k < f.size(); ++k) {
    if (f.blank(k)) continue;
    refuse_selection(f, k);
    coupling.nodes.push_back(f.label(k, "the node"));
  }
}

/// CERIG,master,slave,label,...
void read_ansys_rigid(AnsysFields& f, AnsysContent& c) {
  refuse_selection(f, 1);
  refuse_selection(f, 2);
  AnsysRigid rigid;
  rigid.at = f.at();
  rigid.master = f.label(1, "the master node");
  rigid.slave = f.label(2, "the slave node");
  rigid.mask = 0;
  for (std::size_t k = 3; k < 8; ++k) {
    const std::string word = f.word(k);
    if (word.empty() && k > 3) continue;
    if (word.empty() || word == "ALL")
      rigid.mask = 63u;
    else if (word == "UXYZ" || word == "RXYZ")
      rigid.mask |= word == "UXYZ" ? 7u : 56u;
    else
      rigid.mask |= 1u << axis_of(f, k);
  }
  c.rigid.push_back(rigid);
}

/// D,node,label,value,value2,last,increment,label,...
void read_ansys_support(AnsysFields& f, AnsysContent& c) {
  if (!f.number(1)) {
    c.ignored.try_emplace("D of a selection", f.at());
    return;
  }
  for (const std::size_t k : {2u, 7u, 8u, 9u, 10u, 11u}) {
    const std::string word = f.word(k);
    if (word.empty()) continue;
    const int axis = ansys_axis(word);
    if (axis < 0 && word != "ALL") continue;  // of another field of physics
    c.supports.push_back({{f.label(1, "the node"), axis, 0.0}, f.at()});
  }
}

constexpr AnsysCommand constraint_commands[] = {
    {"CE", read_ansys_equation},
    {"CP", read_ansys_coupling},
    {"CERIG", read_ansys_rigid},
    {"D", read_ansys_support},
};

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
  /// A missing end, 0 if both exist; there may be gaps between them.
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

/// In a range or single; `missing`: the number that is missing.
void refuse_member(AnsysBuild& b, const AnsysComponent& component, int first, int last,
                   int missing) {
  const char* const what = component.elements ? "element" : "node";
  std::string text = fmt::format("component {} has ", component.name);
  if (last != first) text += fmt::format("{}s {} to {}, ", what, first, last);
  if (last < first)
    text += "expected numbers that rise";
  else
    text += fmt::format("{}{} {}{} is not in the file", last != first ? "of which " : "", what,
                        missing, last != first ? "" : ", which");
  b.source.error(ErrorCode::wrong_value, component.at, text);
}

}  // namespace

int ansys_axis(std::string_view word) noexcept {
  for (std::size_t k = 0; k < ansys_axes.size(); ++k)
    if (same_word(word, ansys_axes[k])) return static_cast<int>(k);
  return -1;
}

std::span<const AnsysCommand> ansys_constraint_commands() { return constraint_commands; }

void build_ansys_equations(AnsysBuild& b) {
  for (const auto& [number, raw] : b.content.equations) {
    const std::string who = fmt::format("CE {}", number);
    if (raw.constant != 0.0) {
      b.source.error(ErrorCode::unsupported, raw.at,
                     "{}: its constant is {:g}, only equations that sum to 0 are read", who,
                     raw.constant);
      continue;
    }
    LinearEquation equation{{}, raw.at};
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
      LinearEquation equation{{}, raw.at};
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
      // A rotated direction is a hint only if it is along an axis of the body.
      const Vec3 direction = b.nodal_axes(node).col(axis % 3);
      for (int k = 0; k < 3; ++k)
        if (std::abs(direction(k)) > 1.0 - 1e-9 || term.axis < 0)
          mask |= 1u << (axis >= 3 ? 3 + k : k);
    }
    if (mask == 0) continue;
    auto& all = b.model.supports;
    if (!all.empty() && all.back().node == node)
      all.back().mask |= mask;
    else
      all.push_back({node, mask, at});
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

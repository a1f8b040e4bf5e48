#include "floatframe/formats/written/calculix_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "floatframe/core/plural.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// Numbers of the nodes whose displacements are the rotations of another node; 0: none.
std::vector<int> add_rotation_nodes(CalculixText& deck, const DofTable& table) {
  const FeModel& model = deck.model;
  std::vector<char> bends(model.positions.size(), 0);
  for (const Element& e : model.elements)
    if (element_kernel(e.type).dofs_per_node == 6)
      for (int k = 0; k < element_nodes(e.type); ++k)
        bends[static_cast<std::size_t>(e.nodes[static_cast<std::size_t>(k)])] = 1;
  std::vector<int> out(model.positions.size(), 0);
  for (const Spider& s : model.spiders)
    if (s.rotation_node >= 0)
      out[static_cast<std::size_t>(s.reference)] = deck.node(s.rotation_node);
  std::string lines;
  int& last = deck.numbers.last_node;
  for (int n = 0; n < model.nodes(); ++n) {
    const auto at = static_cast<std::size_t>(n);
    if (table.count(n) < 6 || bends[at] != 0 || out[at] != 0) continue;
    out[at] = ++last;
    const Vec3& p = model.positions[at];
    lines += fmt::format("{}, {}, {}, {}\n", last, calculix_number(p(0)), calculix_number(p(1)),
                         calculix_number(p(2)));
  }
  if (!lines.empty()) deck.text += "** Their displacements are rotations of nodes\n*NODE\n" + lines;
  return out;
}

/// Of what ties a node, for a message.
FeSource source_of_tie(const FeModel& model, int node) {
  for (const Spider& s : model.spiders)
    if (s.reference == node || std::find(s.nodes.begin(), s.nodes.end(), node) != s.nodes.end())
      return s.source;
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms)
      if (t.node == node) return e.source;
  return {};
}

}  // namespace

CalculixEquations::CalculixEquations(CalculixText& deck)
    : deck_(deck),
      table_(dof_table(deck.model)),
      dependences_(resolve_dependences(deck.model, table_)),
      place_(static_cast<std::size_t>(table_.size())) {
  if (!dependences_.any && deck.model.springs.empty()) return;
  const std::vector<int> rotations = add_rotation_nodes(deck, table_);
  for (int n = 0; n < deck.model.nodes(); ++n)
    for (int axis = 0; axis < table_.count(n); ++axis) {
      const int turned = axis < 3 ? 0 : rotations[static_cast<std::size_t>(n)];
      place_[static_cast<std::size_t>(table_.index(n, axis))] =
          turned > 0 ? std::pair{turned, axis - 2} : std::pair{deck.node(n), axis + 1};
    }
}

void CalculixEquations::add_dependences() {
  for (int node = 0; node < deck_.model.nodes(); ++node)
    for (int axis = 0; axis < table_.count(node); ++axis) {
      const auto dof = static_cast<std::size_t>(table_.index(node, axis));
      if (dependences_.dependent[dof] != 0)
        add(place_[dof], dependences_.terms[dof], source_of_tie(deck_.model, node));
    }
}

void CalculixEquations::add(const std::pair<int, int>& place, const Terms& terms,
                            const FeSource& source) {
  const auto& [node, axis] = place;
  if (terms.empty()) {
    zeros_ += fmt::format("{}, {}, {}\n", node, axis, axis);
    return;
  }
  if (axis > 3) refuse(node, source);
  deck_.text += fmt::format("*EQUATION\n{}\n{}, {}, -1", terms.size() + 1, node, axis);
  int in_line = 1;
  for (const auto& [other, factor] : terms) {
    const auto& [there, direction] = place_[static_cast<std::size_t>(other)];
    if (direction > 3) refuse(there, source);
    deck_.text += in_line++ % 4 == 0 ? ",\n" : ", ";
    deck_.text += fmt::format("{}, {}, {}", there, direction, calculix_number(factor));
  }
  deck_.text += '\n';
}

std::pair<int, int> CalculixEquations::place(int node, int axis, const FeSource& source) {
  const std::pair<int, int> place = place_[static_cast<std::size_t>(table_.index(node, axis))];
  if (place.second > 3) refuse(place.first, source);
  return place;
}

void CalculixEquations::refuse(int node, const FeSource& source) {
  if (!refused_.insert(node).second || refused_.size() > 1) return;
  first_refused_ = node;
  first_source_ = source;
}

void CalculixEquations::say_refused() {
  if (refused_.empty()) return;
  const auto more = static_cast<long>(refused_.size()) - 1;
  deck_.errors.add(
      deck_.model.mark(first_source_),
      fmt::format(
          "the rotation of node {}, of a beam or shell, is in an equation, a spring or the "
          "arm of an end beside its node; CalculiX, which makes solids of beams and shells, "
          "would lose it (.vtu and .msh show the mesh){}",
          first_refused_,
          more == 0
              ? ""
              : fmt::format("; the same holds for {}", plural(more, "more node", "more nodes"))));
}

void CalculixEquations::add_zeros() {
  if (!zeros_.empty()) deck_.text += "*BOUNDARY\n" + zeros_;
}

CalculixEquations::Terms CalculixEquations::independent(int node, const Vec6& factors) const {
  std::map<int, double> sum;
  for (int axis = 0; axis < 6; ++axis) {
    const int dof = table_.index(node, axis);
    if (factors(axis) == 0.0 || dof < 0) continue;
    const std::size_t k = static_cast<std::size_t>(dof);
    if (dependences_.dependent[k] == 0) sum[dof] += factors(axis);
    for (const auto& [other, factor] : dependences_.terms[k]) sum[other] += factors(axis) * factor;
  }
  Terms out;
  for (const auto& [dof, factor] : sum)
    if (factor != 0.0) out.emplace_back(dof, factor);
  return out;
}

}  // namespace floatframe

// Constraints and point masses of a CalculiX deck.
#include <fmt/format.h>

#include "floatframe/core/plural.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/written/calculix_text.hpp"

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
  int last = deck.numbers.last_node;
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

void add_equations(CalculixText& deck) {
  const DofTable table = dof_table(deck.model);
  const DependentDofs dependences = resolve_dependences(deck.model, table);
  if (!dependences.any) return;
  const std::vector<int> rotations = add_rotation_nodes(deck, table);
  std::vector<std::pair<int, int>> place(static_cast<std::size_t>(table.size()));
  for (int n = 0; n < deck.model.nodes(); ++n)
    for (int axis = 0; axis < table.count(n); ++axis) {
      const int turned = axis < 3 ? 0 : rotations[static_cast<std::size_t>(n)];
      place[static_cast<std::size_t>(table.index(n, axis))] =
          turned > 0 ? std::pair{turned, axis - 2} : std::pair{deck.node(n), axis + 1};
    }
  std::string zeros;
  for (std::size_t dof = 0; dof < place.size(); ++dof) {
    if (dependences.dependent[dof] == 0) continue;
    const auto& terms = dependences.terms[dof];
    if (terms.empty()) {
      zeros += fmt::format("{}, {}, {}\n", place[dof].first, place[dof].second, place[dof].second);
      continue;
    }
    deck.text += fmt::format("*EQUATION\n{}\n{}, {}, -1", terms.size() + 1, place[dof].first,
                             place[dof].second);
    int in_line = 1;
    for (const auto& [other, factor] : terms) {
      const auto& [node, axis] = place[static_cast<std::size_t>(other)];
      deck.text += in_line++ % 4 == 0 ? ",\n" : ", ";
      deck.text += fmt::format("{}, {}, {}", node, axis, calculix_number(factor));
    }
    deck.text += '\n';
  }
  if (!zeros.empty()) deck.text += "*BOUNDARY\n" + zeros;
}

void add_masses(CalculixText& deck) {
  int number = deck.numbers.last_element;
  std::size_t turning = 0;
  for (const PointMass& m : deck.model.masses) {
    turning += !m.J.isZero(0.0);
    if (m.mass == 0.0) continue;
    const std::string set = written_name(fmt::format("MASS_{}", ++number), true, deck.names);
    deck.text += fmt::format("*ELEMENT, TYPE=MASS, ELSET={0}\n{1}, {2}\n*MASS, ELSET={0}\n{3}\n",
                             set, number, deck.node(m.node), calculix_number(m.mass));
  }
  if (turning > 0)
    deck.notes.push_back(
        fmt::format("the inertia of {} about the node is left out: CalculiX has "
                    "masses without inertia",
                    plural(static_cast<long>(turning), "point mass", "point masses")));
}

}  // namespace

void add_calculix_constraints(CalculixText& deck) {
  add_equations(deck);
  add_masses(deck);
}

}  // namespace floatframe

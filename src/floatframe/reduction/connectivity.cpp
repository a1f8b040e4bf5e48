#include "floatframe/reduction/connectivity.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/flat_nodes.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/union_find.hpp"

namespace floatframe {
namespace {

/// Sets of tied nodes.
class Pieces {
 public:
  explicit Pieces(int nodes) : sets_(nodes), used_(nodes, 0) {}
  void use(int node) { used_[node] = 1; }
  bool used(int node) const { return used_[node] != 0; }
  int root(int node) const { return sets_.root(node); }
  void tie(int a, int b) {
    use(a);
    use(b);
    sets_.join(std::max(root(a), root(b)), std::min(root(a), root(b)));
  }

 private:
  UnionFind sets_;
  std::vector<char> used_;
};

Pieces pieces_of(const FeModel& model) {
  Pieces pieces(model.nodes());
  for (const FeElement& e : model.elements) {
    for (int a = 0; a < element_nodes(e.type); ++a) pieces.tie(e.nodes[0], e.nodes[a]);
  }
  for (const PointMass& m : model.masses) pieces.use(m.node);
  for (const Spring& s : model.springs) pieces.tie(s.nodes[0], s.nodes[s.nodes[1] < 0 ? 0 : 1]);
  for (const Spider& s : model.spiders)
    for (const int node : s.nodes) pieces.tie(s.reference, node);
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms) pieces.tie(e.terms.front().node, t.node);
  if (model.matrices) {
    const FeMatrices& m = *model.matrices;
    for (const int scalar : m.scalars) pieces.tie(m.dofs.front().node, scalar);
    for (int j = 0; j < m.K.outerSize(); ++j) {
      const int node = m.dofs[j].node;
      pieces.use(node);
      for (SparseMatrix::InnerIterator it(m.K, j); it; ++it)
        if (it.value() != 0.0) pieces.tie(m.dofs[it.row()].node, node);
    }
  }
  return pieces;
}

/// The element for which a reader generated this node (an end of a bar offset from its node, or
/// with a hinge); -1 if the node is in the file.
int element_of_made(const FeModel& model, int node) {
  if (!std::binary_search(model.generated_nodes.begin(), model.generated_nodes.end(), node))
    return -1;
  const FeSource& at = model.node_sources[node];
  for (int i = 0; at.line > 0 && i < static_cast<int>(model.elements.size()); ++i) {
    const FeSource& of_element = model.elements[i].source;
    if (of_element.line == at.line && of_element.file == at.file) return i;
  }
  return -1;
}

/// "element 11 (beam2), part.bdf:16"
std::string element_with_place(const FeModel& model, int element) {
  const SourceMark mark = model.mark(model.elements[element].source);
  return fmt::format("{}, {}:{}", model.element_label(element), mark.file, mark.line);
}

std::string made_text(const FeModel& model, int node) {
  const int e = element_of_made(model, node);
  return e < 0 ? "" : fmt::format(" (made for {})", element_with_place(model, e));
}

/// For a node of the file also the first bar with a hinge or an offset there.
std::string bar_text(const FeModel& model, int node) {
  std::string text = made_text(model, node);
  std::vector<int> tied;
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms)
      if (t.node == node && e.terms.front().node != node) tied.push_back(e.terms.front().node);
  for (const Spider& s : model.spiders)
    if (s.reference == node) tied.insert(tied.end(), s.nodes.begin(), s.nodes.end());
  for (std::size_t k = 0; text.empty() && k < tied.size(); ++k)
    if (const int e = element_of_made(model, tied[k]); e >= 0)
      text = fmt::format(" ({}, has a hinge or an offset there)", element_with_place(model, e));
  return text;
}

}  // namespace

std::string list_nodes(const FeModel& model, const std::vector<int>& nodes, std::size_t limit) {
  std::string text, made;  // of the first that is not in the file
  const std::size_t shown = nodes.size() > limit + 1 ? limit : nodes.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == nodes.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + model.node_label(nodes[i]);
    if (made.empty()) text += made = made_text(model, nodes[i]);
  }
  if (shown < nodes.size()) text += fmt::format(" and {} more", nodes.size() - shown);
  return text;
}

void check_connected(const FeModel& model) {
  Pieces pieces = pieces_of(model);
  std::vector<std::vector<int>> of_root(model.positions.size());
  for (int k = 0; k < model.nodes(); ++k)
    if (pieces.used(k)) of_root[pieces.root(k)].push_back(k);
  std::erase_if(of_root, [](const auto& nodes) { return nodes.empty(); });
  if (of_root.size() < 2) {
    if (const std::string flat = flat_nodes(model); !flat.empty())
      throw InputError(ErrorCode::wrong_value, flat);
    return;
  }
  std::stable_sort(of_root.begin(), of_root.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  ErrorList errors;
  for (std::size_t i = 1; i < of_root.size() && i < 6; ++i) {
    errors.add(ErrorCode::singular, {},
               fmt::format("the part is in {} pieces: {} {} not connected with the other {} nodes",
                           of_root.size(), list_nodes(model, of_root[i]),
                           of_root[i].size() == 1 ? "is" : "are", of_root[0].size()));
  }
  errors.throw_if_any();
}

std::string row_label(const FeModel& model, const FeSystem& system, int row) {
  const Dof& dof = system.dofs[row];
  return model.node_label(dof.node) + " " + node_dof_names[dof.axis] + bar_text(model, dof.node);
}

}  // namespace floatframe

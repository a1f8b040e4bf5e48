#include "floatframe/fe/flat_nodes.hpp"

#include <fmt/format.h>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Directions of the stiffness of an element at its nodes, as a projection.
Mat3 resisted(const ElementInput& in, const ElementKernel& kernel) {
  if (kernel.family == ElementFamily::rod) {
    const Vec3 axis = (in.p[1] - in.p[0]).normalized();
    return axis * axis.transpose();
  }
  const Vec3 n = shell_normal({in.p.data(), static_cast<std::size_t>(kernel.nodes)});
  return Mat3::Identity() - n * n.transpose();
}

}  // namespace

std::string flat_nodes(const FeModel& model) {
  std::vector<Mat3> held(model.positions.size(), Mat3::Zero());
  std::vector<char> sheet(model.positions.size(), 0);
  const auto hold = [&](int node) {
    if (node >= 0) held[node].setIdentity();
  };
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    const bool surface = is_membrane(e.type) || is_panel(e.type);
    if (!surface && !is_rod(e.type)) {
      for (int a = 0; a < kernel.nodes; ++a) hold(e.nodes[a]);
      continue;
    }
    const Mat3 P = resisted(gather(model, e), kernel);
    for (int a = 0; a < kernel.nodes; ++a) {
      held[e.nodes[a]] += P;
      if (surface) sheet[e.nodes[a]] = 1;
    }
  }
  for (const Spring& s : model.springs)
    for (const int node : s.nodes) hold(node);
  for (const Spider& s : model.spiders) {
    hold(s.reference);
    for (const int node : s.nodes) hold(node);
  }
  for (const LinearEquation& equation : model.equations)
    for (const LinearEquation::Term& term : equation.terms) hold(term.node);
  // Planes closer than 1e-4 are treated as equal: Nastran's AUTOSPC takes 1e-8 of the stiffness.
  constexpr double least = 1e-8;
  int count = 0, first = -1;
  for (int k = 0; k < model.nodes(); ++k) {
    if (sheet[k] == 0) continue;
    const VecX lambda = symmetric_eigenvalues(held[k]);
    if (lambda(0) > least * lambda(2)) continue;
    if (count++ == 0) first = k;
  }
  if (count == 0) return {};
  return fmt::format(
      "the part is a mechanism: {} {} on membranes or shear panels of one plane and on nothing "
      "else, which do not resist motions across it, first {}; other programs hold such nodes in "
      "space (AUTOSPC), which a part that moves cannot be: give them bending stiffness",
      count, count == 1 ? "node is" : "nodes are", model.node_label(first));
}

}  // namespace floatframe

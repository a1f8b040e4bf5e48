#include "floatframe/formats/stiffeners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// cos of the largest angle between a shell and the mean of those at the node: beyond, its bending
/// resists the turn about the normal of the others.
constexpr double smooth = 0.93969262;  // 20 degrees

std::span<const int> nodes_of(const Element& e) {
  return {e.nodes.data(), static_cast<std::size_t>(element_nodes(e.type))};
}

/// Twice the area, along the normal.
Vec3 area_normal(const FeModel& model, const Element& e) {
  const bool triangle = e.type == ElementType::tri3 || e.type == ElementType::tri6;
  const auto p = [&](int k) -> const Vec3& { return model.positions[e.nodes[k]]; };
  return triangle ? (p(1) - p(0)).cross(p(2) - p(0)) : (p(2) - p(0)).cross(p(3) - p(1));
}

}  // namespace

ShellsAtNodes::ShellsAtNodes(const FeModel& model, const std::vector<char>& wanted)
    : model_(model), of_node_(model.positions.size()) {
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& e = model.elements[i];
    if (!is_shell(e.type)) continue;
    for (const int k : nodes_of(e))
      if (wanted[k] != 0) of_node_[k].push_back(static_cast<int>(i));
  }
}

std::optional<Vec3> ShellsAtNodes::normal_along(int node, const std::vector<int>& others) const {
  const std::vector<int>& shells = of_node_[node];
  const auto in_a_shell = [&](int other) {
    return std::any_of(shells.begin(), shells.end(), [&](int shell) {
      const std::span<const int> nodes = nodes_of(model_.elements[shell]);
      return std::find(nodes.begin(), nodes.end(), other) != nodes.end();
    });
  };
  if (shells.empty() || !std::all_of(others.begin(), others.end(), in_a_shell)) return std::nullopt;
  Vec3 sum = Vec3::Zero();
  for (const int shell : shells) {
    const Vec3 n = area_normal(model_, model_.elements[shell]);
    sum += n.dot(sum) < 0.0 ? Vec3(-n) : n;
  }
  const Vec3 mean = sum.normalized();
  const auto along_mean = [&](int shell) {
    const Vec3 n = area_normal(model_, model_.elements[shell]);
    return std::abs(n.dot(mean)) >= smooth * n.norm() && n.norm() > 0.0;
  };
  if (!std::all_of(shells.begin(), shells.end(), along_mean)) return std::nullopt;
  return mean;
}

void note_stiffeners(FeModel& model, int ends) {
  if (ends > 0)
    model.notes.push_back(
        fmt::format("{} ends of beams along shells and beside them turn about the normal of the "
                    "shell by themselves: shells here resist that turn, in most programs hardly",
                    ends));
}

}  // namespace floatframe

#include "floatframe/decks/stiffeners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/decks/nodes_of_element.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe {
namespace {

/// cos of the largest angle between a shell and the mean of those at the node: beyond, its bending
/// resists the turn about the normal of the others.
constexpr double smooth = 0.93969262;  // 20 degrees

bool has_node(const FeElement& e, int node) {
  const std::span<const int> nodes = nodes_of_element(e);
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

Vec3 normal_of(const FeModel& model, int shell) {
  const std::span<const int> nodes = nodes_of_element(model.elements[shell]);
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < nodes.size(); ++k) p[k] = model.positions[nodes[k]];
  return shell_normal({p.data(), nodes.size()});
}

bool are_smooth(const FeModel& model, const std::vector<int>& shells) {
  Vec3 sum = Vec3::Zero();
  for (const int shell : shells) {
    const Vec3 n = normal_of(model, shell);
    sum += n.dot(sum) < 0.0 ? Vec3(-n) : n;
  }
  return std::all_of(shells.begin(), shells.end(), [&](int shell) {
    return std::abs(normal_of(model, shell).dot(sum)) >= smooth * sum.norm();
  });
}

/// Each node with the beams that may stiffen shells there: its shells.
class StiffenedNodes {
 public:
  StiffenedNodes(const FeModel& model, std::span<const BeamOnNodes> beams)
      : model_(model), shells_(model.positions.size()), state_(model.positions.size(), none) {
    for (const BeamOnNodes& beam : beams)
      if (beam.offset && beam.holds)
        for (const int k : beam.nodes)
          if (k >= 0) state_[k] = wanted;
    for (std::size_t i = 0; i < model.elements.size(); ++i) {
      if (!is_shell(model.elements[i].type)) continue;
      for (const int k : nodes_of_element(model.elements[i]))
        if (state_[k] == wanted) shells_[k].push_back(static_cast<int>(i));
    }
    for (const BeamOnNodes& beam : beams) look_at(beam);
  }

  const std::vector<int>& shells(int node) const { return shells_[node]; }
  bool is_one(int node) const {
    return state_[node] == stiffened && are_smooth(model_, shells_[node]);
  }

 private:
  enum State : char { none, wanted, stiffened, left };  // left by a beam that goes elsewhere

  void look_at(const BeamOnNodes& beam) {
    for (const int node : beam.nodes) {
      if (node < 0 || state_[node] == none || state_[node] == left) continue;
      if (!goes_along(beam, node))
        state_[node] = left;
      else if (beam.offset && beam.holds)
        state_[node] = stiffened;
    }
  }

  bool goes_along(const BeamOnNodes& beam, int node) const {
    return std::all_of(beam.nodes.begin(), beam.nodes.end(), [&](int other) {
      return other < 0 || std::any_of(shells_[node].begin(), shells_[node].end(), [&](int shell) {
               return has_node(model_.elements[shell], other);
             });
    });
  }

  const FeModel& model_;
  std::vector<std::vector<int>> shells_;  ///< of the nodes that are not `none`
  std::vector<State> state_;
};

}  // namespace

void free_drilling_at_stiffeners(FeModel& model, std::span<const BeamOnNodes> beams) {
  const auto stiffens = [](const BeamOnNodes& b) { return b.offset && b.holds; };
  if (std::none_of(beams.begin(), beams.end(), stiffens)) return;
  const StiffenedNodes nodes(model, beams);
  int count = 0;
  for (int k = 0; k < model.nodes(); ++k) {
    if (nodes.shells(k).empty() || !nodes.is_one(k)) continue;
    ++count;
    for (const int shell : nodes.shells(k)) {
      FeElement& e = model.elements[shell];
      const std::span<const int> of_shell = nodes_of_element(e);
      for (std::size_t a = 0; a < of_shell.size(); ++a)
        if (of_shell[a] == k) e.own_drilling |= 1u << a;
    }
  }
  if (count > 0)
    model.notes.push_back(
        fmt::format("at {} nodes of beams along shells and next to them the shells do not resist "
                    "the turn about "
                    "their normal, as in most programs; here they do elsewhere",
                    count));
}

}  // namespace floatframe

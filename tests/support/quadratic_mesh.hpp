#pragma once
// Quadratic meshes made of bricks of 8 nodes.
#include <algorithm>
#include <map>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe::test {

/// Nodes in the middles of edges, made once.
class Middles {
 public:
  explicit Middles(FeModel& model) : model_(model) {}
  int operator()(int a, int b) {
    const auto [it, added] = of_.try_emplace(std::minmax(a, b), model_.nodes());
    if (!added) return it->second;
    model_.positions.push_back(0.5 * (model_.positions[a] + model_.positions[b]));
    for (auto& [name, set] : model_.node_sets)
      if (std::count(set.begin(), set.end(), a) > 0 && std::count(set.begin(), set.end(), b) > 0)
        set.push_back(it->second);
    return it->second;
  }

 private:
  FeModel& model_;
  std::map<std::pair<int, int>, int> of_;
};

inline FeModel hex20_of(FeModel model) {
  constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  Middles middle(model);
  for (FeElement& e : model.elements) {
    e.type = FeElementType::hex20;
    for (int k = 0; k < 12; ++k) e.nodes[8 + k] = middle(e.nodes[edge[k][0]], e.nodes[edge[k][1]]);
  }
  return model;
}

/// Six tetrahedra of each brick, around a diagonal; linear, or quadratic.
inline FeModel tets_of(FeModel model, bool quadratic) {
  constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
  constexpr int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  const std::vector<FeElement> bricks = std::move(model.elements);
  model.elements.clear();
  Middles middle(model);
  for (const FeElement& brick : bricks)
    for (const auto& [b, c] : path) {
      FeElement e = brick;
      e.type = quadratic ? FeElementType::tet10 : FeElementType::tet4;
      e.nodes = {brick.nodes[0], brick.nodes[b], brick.nodes[c], brick.nodes[6]};
      for (int k = 0; k < 6 && quadratic; ++k)
        e.nodes[4 + k] = middle(e.nodes[edge[k][0]], e.nodes[edge[k][1]]);
      model.elements.push_back(e);
    }
  return model;
}

}  // namespace floatframe::test

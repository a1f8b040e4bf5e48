#pragma once
// Nodes used by the elements of a model.
#include <span>
#include <vector>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

inline std::span<const int> nodes_of_element(const FeElement& e) {
  return {e.nodes.data(), static_cast<std::size_t>(element_nodes(e.type))};
}

/// For each node: 1 if an element of a kind has it.
template <class Condition>
std::vector<char> nodes_of_elements(const FeModel& model, Condition is_of_kind) {
  std::vector<char> out(model.positions.size(), 0);
  for (const FeElement& e : model.elements)
    if (is_of_kind(e))
      for (const int node : nodes_of_element(e)) out[node] = 1;
  return out;
}

}  // namespace floatframe

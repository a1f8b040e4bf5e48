#include "floatframe/fe/made_nodes.hpp"

#include <algorithm>

namespace floatframe {

std::vector<char> made_nodes(const FeModel& model) {
  std::vector<char> out(model.positions.size(), 0);
  if (model.node_sources.size() != model.positions.size()) return out;
  std::vector<std::pair<int, int>> elements;  // file and line
  for (const Element& e : model.elements)
    if (e.source.line > 0) elements.emplace_back(e.source.file, e.source.line);
  std::sort(elements.begin(), elements.end());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const FeSource& at = model.node_sources[k];
    out[k] = std::binary_search(elements.begin(), elements.end(), std::pair{at.file, at.line});
  }
  return out;
}

}  // namespace floatframe

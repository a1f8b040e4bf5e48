#include "floatframe/parts/beam_arms.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

std::vector<char> beam_arms(const FeModel& model) {
  std::vector<char> out(model.spiders.size(), 0);
  if (model.spiders.empty() || model.generated_nodes.empty()) return out;
  std::set<std::pair<int, int>> bars;  // file and line
  for (const FeElement& e : model.elements)
    if ((is_beam(e.type) || is_rod(e.type)) && e.source.line > 0)
      bars.emplace(e.source.file, e.source.line);
  std::set<int> ends;
  for (const int node : model.generated_nodes) {
    const FeSource& at = model.node_sources[static_cast<std::size_t>(node)];
    if (bars.contains({at.file, at.line})) ends.insert(node);
  }
  for (std::size_t i = 0; i < model.spiders.size(); ++i) {
    const Spider& s = model.spiders[i];
    out[i] =
        s.kind == Spider::Kind::rigid && !s.nodes.empty() &&
        std::all_of(s.nodes.begin(), s.nodes.end(), [&](int node) { return ends.contains(node); });
  }
  return out;
}

}  // namespace floatframe

#include "floatframe/parts/beam_arms.hpp"

#include <algorithm>

#include "floatframe/fe/made_nodes.hpp"

namespace floatframe {

std::vector<char> beam_arms(const FeModel& model) {
  std::vector<char> out(model.spiders.size(), 0);
  if (model.spiders.empty()) return out;
  const std::vector<char> made = made_nodes(model);
  for (std::size_t i = 0; i < model.spiders.size(); ++i) {
    const Spider& s = model.spiders[i];
    out[i] = s.kind == Spider::Kind::rigid && !s.nodes.empty() &&
             std::all_of(s.nodes.begin(), s.nodes.end(),
                         [&](int node) { return made[static_cast<std::size_t>(node)] != 0; });
  }
  return out;
}

}  // namespace floatframe

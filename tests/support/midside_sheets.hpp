#pragma once
// Mapped squares of shells with nodes on their edges.
#include <map>

#include "support/fe_models.hpp"

namespace floatframe::test {

struct MidsideSheet {
  FeModel model;
  std::map<std::pair<int, int>, int> node;  ///< by half cells along x and y
};

/// n x m cells as quad8 or as pairs of tri6.
template <class Map>
MidsideSheet midside_sheet(FeElementType type, int n, int m, const Map& map,
                           const Material& material, double thickness) {
  MidsideSheet s;
  s.model.materials = {material};
  s.model.shells = {{thickness}};
  const auto at = [&](int i, int j) {
    const auto [it, fresh] = s.node.try_emplace({i, j}, s.model.nodes());
    if (fresh) s.model.positions.push_back(map(0.5 * i / n, 0.5 * j / m));
    return it->second;
  };
  for (int j = 0; j < 2 * m; j += 2)
    for (int i = 0; i < 2 * n; i += 2) {
      const int a = at(i, j), b = at(i + 2, j), c = at(i + 2, j + 2), d = at(i, j + 2);
      const int ab = at(i + 1, j), bc = at(i + 2, j + 1), cd = at(i + 1, j + 2), da = at(i, j + 1);
      if (type == FeElementType::quad8) {
        add_element(s.model, type, {a, b, c, d, ab, bc, cd, da});
      } else {
        const int ac = at(i + 1, j + 1);
        add_element(s.model, type, {a, b, c, ab, bc, ac});
        add_element(s.model, type, {a, c, d, ac, cd, da});
      }
    }
  return s;
}

}  // namespace floatframe::test

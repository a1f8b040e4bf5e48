#pragma once
// Finite-element models that tests put together, and what they ask of them.
#include <array>
#include <utility>
#include <vector>

#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe::test {

inline FeElement& add_element(FeModel& model, FeElementType type,
                              const std::array<int, 20>& nodes) {
  FeElement& e = model.elements.emplace_back();
  e.type = type;
  e.nodes = nodes;
  return e;
}

inline Spider& add_spider(FeModel& model, int reference, std::vector<int> nodes,
                          Spider::Kind kind = Spider::Kind::rigid) {
  Spider& s = model.spiders.emplace_back();
  s.kind = kind;
  s.reference = reference;
  s.nodes = std::move(nodes);
  return s;
}

/// Of K x = lambda M x, ascending: squares of the angular frequencies of the free part.
inline VecX free_eigenvalues(const FeSystem& system) {
  return generalised_eigenvalues(MatX(system.K), MatX(system.M)).values;
}

inline VecX free_eigenvalues(const FeModel& model) { return free_eigenvalues(assemble(model)); }

}  // namespace floatframe::test

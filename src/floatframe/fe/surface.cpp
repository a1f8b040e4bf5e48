#include "floatframe/fe/surface.hpp"

#include <algorithm>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

using Triangle = std::array<int, 3>;

/// A face of a solid; its sorted corners identify a face shared by two elements.
struct Candidate {
  std::array<int, 4> key;
  int element, face;
};

void divide(const FeElement& element, const FaceNodes& face, std::vector<Triangle>& out) {
  constexpr Triangle tri3[] = {{0, 1, 2}};
  constexpr Triangle tri6[] = {{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}};
  constexpr Triangle quad4[] = {{0, 1, 2}, {0, 2, 3}};
  constexpr Triangle quad8[] = {{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}, {4, 5, 6}, {4, 6, 7}};
  std::span<const Triangle> parts = tri3;
  if (face.count == 6) parts = tri6;
  if (face.count == 4) parts = quad4;
  if (face.count == 8) parts = quad8;
  const auto node = [&](int i) {
    const int local = face.nodes[i];
    return element.nodes[local];
  };
  for (const Triangle& t : parts) out.push_back({node(t[0]), node(t[1]), node(t[2])});
}

}  // namespace

Surface outer_surface(const FeModel& model) {
  std::vector<Candidate> candidates;
  Surface surface;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const FeElement& element = model.elements[e];
    const std::span<const FaceNodes> faces = element_faces(element.type);
    if (is_beam(element.type) || is_rod(element.type)) {
      const int count = element_kernel(element.type).nodes;
      for (int i = 0; i + 1 < count; ++i) {
        surface.lines.push_back({element.nodes[i], element.nodes[i + 1]});
      }
    } else if (has_shell_section(element.type)) {
      divide(element, faces[0], surface.triangles);
    } else {
      for (std::size_t f = 0; f < faces.size(); ++f) {
        Candidate c{{-1, -1, -1, -1}, static_cast<int>(e), static_cast<int>(f)};
        for (int i = 0; i < faces[f].corners; ++i) {
          c.key[i] = element.nodes[faces[f].nodes[i]];
        }
        std::sort(c.key.begin(), c.key.end());
        candidates.push_back(c);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.key, a.element, a.face) < std::tie(b.key, b.element, b.face);
  });
  std::vector<Candidate> outer;
  for (std::size_t i = 0; i < candidates.size();) {
    std::size_t end = i + 1;
    while (end < candidates.size() && candidates[end].key == candidates[i].key) ++end;
    if (end == i + 1) outer.push_back(candidates[i]);
    i = end;
  }
  std::sort(outer.begin(), outer.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.element, a.face) < std::tie(b.element, b.face);
  });
  for (const Candidate& c : outer) {
    const FeElement& element = model.elements[c.element];
    divide(element, element_faces(element.type)[c.face], surface.triangles);
  }

  std::vector<int> place(model.positions.size(), -1);
  for (const Triangle& t : surface.triangles) {
    for (const int node : t) place[node] = 0;
  }
  for (const auto& line : surface.lines) {
    for (const int node : line) place[node] = 0;
  }
  for (std::size_t k = 0; k < place.size(); ++k) {
    if (place[k] < 0) continue;
    place[k] = static_cast<int>(surface.nodes.size());
    surface.nodes.push_back(static_cast<int>(k));
  }
  for (Triangle& t : surface.triangles) {
    for (int& node : t) node = place[node];
  }
  for (auto& line : surface.lines) {
    for (int& node : line) node = place[node];
  }
  return surface;
}

}  // namespace floatframe

#pragma once
// Checks of meshes that come from files, without the element kernels.
#include <gtest/gtest.h>

#include <set>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe::test {

inline std::set<int> as_set(const std::vector<int>& list) { return {list.begin(), list.end()}; }

/// Volume of the elements with straight edges: divergence theorem over their faces.
inline double corner_volume(const FeModel& model) {
  double volume = 0.0;
  for (const FeElement& e : model.elements) {
    const auto p = [&](const FaceNodes& f, int k) {
      const int local = f.nodes[k];
      return model.positions[e.nodes[local]];
    };
    for (const FaceNodes& f : element_faces(e.type)) {
      for (int k = 1; k + 1 < f.corners; ++k) {
        volume += p(f, 0).dot(p(f, k).cross(p(f, k + 1))) / 6.0;
      }
    }
  }
  return volume;
}

/// The order of the mid-side nodes: each is near the middle of its edge.
inline void expect_midside_nodes_near_edges(const FeModel& model) {
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const FeElement& e = model.elements[i];
    for (const FaceNodes& f : element_faces(e.type)) {
      for (int k = 0; k < f.count - f.corners; ++k) {
        const auto p = [&](int index) {
          const int local = f.nodes[index];
          const int node = e.nodes[local];
          return model.positions[node];
        };
        const Vec3 a = p(k), b = p((k + 1) % f.corners), m = p(f.corners + k);
        ASSERT_LT((m - 0.5 * (a + b)).norm(), 0.25 * (b - a).norm()) << "element " << i;
      }
    }
  }
}

/// Equal numbers, coordinates and elements, in whatever order the nodes are.
inline void expect_same_mesh(const FeModel& a, const FeModel& b, double tolerance) {
  ASSERT_EQ(a.nodes(), b.nodes());
  ASSERT_EQ(a.node_ids, b.node_ids);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    largest = std::max(largest, (a.positions[i] - b.positions[i]).norm());
  }
  EXPECT_LE(largest, tolerance);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    ASSERT_EQ(a.elements[i].type, b.elements[i].type) << i;
    ASSERT_EQ(a.elements[i].nodes, b.elements[i].nodes) << i;
  }
  EXPECT_NEAR(corner_volume(a), corner_volume(b), 1e3 * tolerance * (1.0 + corner_volume(a)));
}

}  // namespace floatframe::test

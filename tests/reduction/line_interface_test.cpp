// Interfaces that follow the mean motion of nodes on a line: their translations, and turns that are
// not about the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reduction/part_beam.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

/// The beam with the set EDGE: three nodes along z at the end B.
FeModel with_edge() {
  FeModel model = beam();
  for (int k = 0; k < model.nodes(); ++k) {
    const Vec3& p = model.positions[k];
    if (std::abs(p.x() - 0.6) < 1e-9 && std::abs(p.y()) < 1e-9)
      model.node_sets["EDGE"].push_back(k);
  }
  return model;
}

PartOptions held_at_edge(unsigned mask) {
  PartOptions options = both_ends(10);
  options.interfaces[1] = bore("EDGE");
  options.interfaces[1].kind = Spider::Kind::mean;
  options.interfaces[1].mask = mask;
  return options;
}

TEST(LineInterface, FollowsTheMeanMotionOfItsNodes) {
  for (const unsigned mask : {2u, 7u, 7u | 8u | 16u}) {
    const FeModel model = with_edge();
    const ReducedPart part = reduce_part(model, held_at_edge(mask));
    const ModalNode& node = part.body.nodes[1];
    EXPECT_LT((node.p - Vec3(0.6, 0.0, 0.015)).norm(), 1e-12);
    Mat3X mean = Mat3X::Zero(3, part.body.modes());
    for (const int k : model.node_sets.at("EDGE")) {
      const auto at = std::find(part.surface.nodes.begin(), part.surface.nodes.end(), k);
      ASSERT_NE(at, part.surface.nodes.end());
      mean += part.surface_modes.middleRows<3>(3 * (at - part.surface.nodes.begin())) / 3.0;
    }
    EXPECT_LT((node.X - mean).norm(), 1e-9 * mean.norm());
    // About the line it turns as the part does there, which rigid motions show.
    EXPECT_LT(part.health.rigid_residual, 1e-12);
    EXPECT_GT(node.X_theta.row(2).norm(), 1e-3 * node.X_theta.norm());
    EXPECT_LT(part.health.interfaces[1].static_error, 1e-6);
    EXPECT_LT(part.health.interfaces[1].condition, 10.0);
    EXPECT_LT(std::abs(part.health.free_frequencies[0].relative_error()), 1e-3);
  }
}

TEST(LineInterface, TheTurnAboutTheLineIsRefused) {
  const auto refused = [](PartOptions options) {
    return error_of([&] { reduce_part(with_edge(), options); });
  };
  EXPECT_EQ(refused(held_at_edge(63u)), "singular");
  PartOptions rigid = held_at_edge(7u);
  rigid.interfaces[1].kind = Spider::Kind::rigid;
  EXPECT_EQ(refused(rigid), "singular");
  PartOptions beside = held_at_edge(7u);
  beside.interfaces[1].at = Vec3(0.6, 0.01, 0.015);
  EXPECT_EQ(refused(beside), "singular");
}

/// A cantilever of Z section, in shells.
TEST(LineInterface, OnTheEdgeOfShells) {
  FeModel model;
  model.materials = {steel};
  model.shells.emplace_back().thickness = 0.1;
  constexpr int nx = 8, ns = 16;
  for (int i = 0; i <= nx; ++i)
    for (int s = 0; s <= ns; ++s) {
      const double t = s / 4.0;  // 1 along the upper flange, 2 along the web, 1 along the lower one
      const double y = t < 1.0 ? 1.0 - t : t < 3.0 ? 0.0 : 3.0 - t;
      const double z = t < 1.0 ? 1.0 : t < 3.0 ? 2.0 - t : -1.0;
      model.positions.emplace_back(10.0 * i / nx, y, z);
      if (i == 0) model.node_sets["ROOT"].push_back(s);
      if (i == nx && t <= 1.0) model.node_sets["TOP"].push_back(model.nodes() - 1);
    }
  for (int i = 0; i < nx; ++i)
    for (int s = 0; s < ns; ++s) {
      const int a = i * (ns + 1) + s;
      add_element(model, FeElementType::quad4, {a, a + ns + 1, a + ns + 2, a + 1});
    }
  PartOptions options = both_ends(4);
  options.interfaces = {bore("ROOT"), bore("TOP")};
  options.interfaces[1].kind = Spider::Kind::mean;
  options.interfaces[1].mask = 2u;
  const ReducedPart part = reduce_part(model, options);
  EXPECT_EQ(part.body.modes(), 5);  // six and one degrees of freedom, four modes, no rigid motions
  EXPECT_LT(part.health.rigid_residual, 1e-12);
  EXPECT_LT(std::abs(part.health.free_frequencies[0].relative_error()), 0.05);
}

}  // namespace
}  // namespace floatframe::test

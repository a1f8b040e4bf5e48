// Stress of solids of plies: at each node that of the ply there, and plies are not averaged.
#include <gtest/gtest.h>

#include "floatframe/body/fe_stress.hpp"
#include "floatframe/fe/elasticity.hpp"

namespace floatframe::test {
namespace {

/// Two bricks on each other, each a soft ply below a stiff one, in constant strain.
TEST(LayupStress, OfThePlyAtTheNode) {
  FeModel model;
  model.materials = {{1e9, 0.3, 1000.0}, {7e10, 0.25, 2000.0}};
  model.material_names = {"SOFT", "STIFF"};
  model.layups = {{{{0, 3.0, 0.0}, {1, 1.0, 0.0}}}};
  for (int k = 0; k < 3; ++k)
    for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {0, 1}})
      model.positions.emplace_back(x, y, 0.5 * k);
  for (int k = 0; k < 2; ++k) {
    FeElement e;
    e.type = FeElementType::hex8;
    for (int a = 0; a < 8; ++a) e.nodes[a] = 4 * k + a;
    e.layup = 0;
    model.elements.push_back(e);
  }
  validate(model);
  std::vector<int> surface(model.positions.size());
  for (std::size_t k = 0; k < surface.size(); ++k) surface[k] = static_cast<int>(k);
  const StressRecovery recovery(model, surface);
  const BodyStress& layout = recovery.layout();
  ASSERT_EQ(layout.groups.size(), 2u);
  EXPECT_EQ(layout.groups[0].name, "SOFT");
  EXPECT_EQ(layout.groups[1].name, "STIFF");
  EXPECT_EQ(layout.groups[1].young, 7e10);
  ASSERT_EQ(layout.places.size(), 16u);  // both plies meet at the four nodes in the middle
  Mat3 G;
  G << 1e-3, 2e-3, -1e-3, 0, 3e-3, 5e-4, 2e-3, 0, -2e-3;
  Vec6 strain;
  strain << G(0, 0), G(1, 1), G(2, 2), G(0, 1) + G(1, 0), G(1, 2) + G(2, 1), G(2, 0) + G(0, 2);
  StressFields fields;
  fields.displacements.U.resize(36, 1);
  for (int a = 0; a < 12; ++a)
    fields.displacements.U.block<3, 1>(3 * a, 0) = G * model.positions[a];
  const MatX stress = recovery.recover(fields).places;
  for (std::size_t k = 0; k < layout.places.size(); ++k) {
    const Vec6 right = elasticity_matrix(model.materials[layout.places[k].group]) * strain;
    const Vec6 found = stress.block<6, 1>(6 * static_cast<Eigen::Index>(k), 0);
    EXPECT_LT((found - right).norm(), 1e-12 * right.norm()) << k;
  }
}

}  // namespace
}  // namespace floatframe::test

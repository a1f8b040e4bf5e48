// Reduced parts of laminates and of orthotropic solids: the health report finds nothing wrong, mass
// and inertia with the plies beside the nodes are those of the elements.
#include <gtest/gtest.h>

#include "floatframe/body/body_stress.hpp"
#include "reduction/part_beam.hpp"
#include "support/shell_sheets.hpp"
#include "support/solid_plies.hpp"

namespace floatframe::test {
namespace {

void check_layered(const FeModel& model) {
  const ReducedPart part = reduce_part(model, both_ends(20));
  const HealthReport& h = part.health;
  EXPECT_LT(h.rigid_residual, 1e-9);
  EXPECT_NEAR(h.from_invariants.mass, h.from_elements.mass, 1e-10 * h.from_elements.mass);
  EXPECT_NEAR(h.volume_times_density, h.from_elements.mass, 1e-10 * h.from_elements.mass);
  EXPECT_LT((h.from_invariants.centre - h.from_elements.centre).norm(), 1e-9);
  EXPECT_LT((h.from_invariants.J_origin - h.from_elements.J_origin).norm(),
            1e-8 * h.from_elements.J_origin.norm());
  ASSERT_GE(h.free_frequencies.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(h.free_frequencies[k].reduced / h.free_frequencies[k].full, 1.0, 5e-3) << k;
  // Strain does not follow from stress alone there.
  ASSERT_TRUE(part.body.stress);
  for (const auto& group : part.body.stress->groups) {
    EXPECT_EQ(group.young, 0.0);
  }
}

TEST(LayeredParts, Laminate) {
  FeModel model = sheet(
      FeElementType::quad4, 12, 4, [](double x, double y) { return Vec3(0.4 * x, 0.1 * y, 0); },
      anisotropic_material(lamina_elasticity(fibres), true, fibres_density), 0.001);
  model.shells[0] = {.thickness = 0.003, .offset = 0.01};
  model.shells[0].plies = {{0, 0.001, 0.0}, {0, 0.002, 1.2}};
  for (int j = 0; j <= 4; ++j) {
    model.node_sets["A"].push_back(13 * j);
    model.node_sets["B"].push_back(13 * j + 12);
  }
  check_layered(model);
}

TEST(LayeredParts, OrthotropicSolid) {
  FeModel model = brick_beam(10, 2, 2, 0.4, 0.04);
  model.materials = {anisotropic_material(elasticity_of(fibres), false, fibres_density)};
  Orientation o;
  o.axes = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  model.orientations = {o};
  for (FeElement& e : model.elements) e.orientation = 0;
  check_layered(model);
}

}  // namespace
}  // namespace floatframe::test

// Modes of equal frequency, of parts with symmetry and of free parts: all of them are found, also
// where few are asked for. A Krylov space has one vector of each.
#include <gtest/gtest.h>

#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "reduction/part_beam.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

void expect_lowest(const SparseMatrix& K, const SparseMatrix& M, double shift,
                   const std::function<Eigenpairs(int)>& lowest) {
  ASSERT_GT(K.rows(), 240);  // by Lanczos iteration, not densely
  const VecX mu = generalised_eigenvalues(MatX(M), MatX(K + shift * M)).values.reverse();
  int equal = 0;
  for (int count = 1; count <= 14; ++count) {
    const Eigenpairs found = lowest(count);
    ASSERT_EQ(found.lambda.size(), count);
    for (int k = 0; k < count; ++k)
      EXPECT_NEAR((found.lambda[k] + shift) * mu[k], 1.0, 1e-9) << k << " of " << count;
    const MatX one = found.shapes.transpose() * (M * found.shapes) - MatX::Identity(count, count);
    EXPECT_LT(one.cwiseAbs().maxCoeff(), 1e-9);
    if (count > 1 && mu[count - 1] > (1.0 - 1e-9) * mu[count - 2]) ++equal;
  }
  EXPECT_GT(equal, 2);
}

TEST(EqualModes, OfFreeCubesAndBeams) {
  for (const FeModel& model : {brick_beam(4, 4, 4, 0.01, 0.01), brick_beam(5, 5, 5, 0.01, 0.01),
                               brick_beam(10, 3, 3, 0.05, 0.01)}) {
    const FeSystem system = assemble(model);
    const double estimate = elastic_estimate(model, system);
    const FreeStructure free(system.K, system.M, rigid_motions(model, system, Vec3::Zero()),
                             estimate);
    expect_lowest(system.K, system.M, estimate, [&](int count) { return free.modes(count); });
  }
}

TEST(EqualModes, OfHeldBeams) {
  const FeModel model = brick_beam(8, 3, 3, 0.05, 0.01);
  const FeSystem system = assemble(model);
  const int held = 3 * static_cast<int>(model.node_sets.at("A").size()), n = system.size() - held;
  const SparseMatrix K = system.K.bottomRightCorner(n, n), M = system.M.bottomRightCorner(n, n);
  expect_lowest(K, M, 0.0, [&](int count) {
    const Eigenmodes modes = lowest_modes(K, M, count);
    return Eigenpairs{modes.omega.cwiseAbs2(), modes.shapes};
  });
}

TEST(EqualModes, OfPartsWithFewNormalModes) {
  for (int modes = 1; modes <= 8; ++modes) {
    PartOptions options;
    options.interfaces = {bore("A")};
    options.modes = modes;
    for (const FeModel& model :
         {brick_beam(6, 6, 6, 0.01, 0.01), brick_beam(10, 4, 4, 0.05, 0.01)}) {
      const HealthReport health = reduce_part(model, options).health;
      ASSERT_TRUE(health.rigid_eigenvalues.has_value());
      EXPECT_LT(health.rigid_eigenvalues->cwiseAbs().maxCoeff(), 1e-9) << modes;
    }
  }
}

}  // namespace
}  // namespace floatframe::test

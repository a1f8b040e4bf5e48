// Reactions of least norm by sparse factors: an orthogonal projection whose rank is that of the
// constraints.
#include "floatframe/simulation/least_reactions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Parallelograms in a row, planar: each repeats three constraints. The first crank is `angle` from
/// upright.
Model row_of_parallelograms(int cells, double angle) {
  std::string bodies = "bodies:\n", joints = "joints:\n";
  const auto bar = [&](const std::string& name, double x, double z) {
    bodies += fmt::format(
        "  {}: {{rigid: {{mass: 1, centre_of_mass: [{},0,{}], inertia: [.1,.1,.1]}}}}\n", name, x,
        z);
  };
  const auto hinge = [&](const std::string& name, const std::string& parent,
                         const std::string& child, double x, double z, const std::string& more) {
    joints +=
        fmt::format("  {}: {{type: revolute, parent: {}, child: {}, at: [{},0,{}], axis: y{}}}\n",
                    name, parent, child, x, z, more);
  };
  bar("c0", 0.0, 0.5);
  hinge("a0", "ground", "c0", 0.0, 0.0, fmt::format(", position: {}", angle));
  for (int k = 1; k <= cells; ++k) {
    const std::string crank = fmt::format("c{}", k), rod = fmt::format("r{}", k);
    bar(crank, k, 0.5);
    bar(rod, k - 0.5, 1.0);
    hinge(fmt::format("a{}", k), "ground", crank, k, 0.0, "");
    hinge(fmt::format("b{}", k), fmt::format("c{}", k - 1), rod, k - 1, 1.0, "");
    hinge(fmt::format("d{}", k), crank, rod, k, 1.0, "");
  }
  return model_of(bodies + joints);
}

TEST(LeastReactions, AreAnOrthogonalProjection) {
  constexpr int cells = 6;
  const Model model = row_of_parallelograms(cells, 0.4);
  RelativeFormulation f(model, model.simulation.inertia);
  const State s = relative_start(f, Start::given);
  f.positions(s.t, s.q);
  f.velocities(s.v);
  LeastReactions<RelativeFormulation> least(model);
  least.place(f, s.t);
  const int n = least.rows();
  MatX P(n, n);
  for (int k = 0; k < n; ++k) {
    VecX lambda = VecX::Unit(n, k);
    least.shorten(lambda);
    P.col(k) = lambda;
  }
  EXPECT_EQ(n, 5 * (1 + 3 * cells));
  EXPECT_LT((P * P - P).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-9);
  // Three constraints of each cell are repeated.
  EXPECT_NEAR(P.trace(), n - 3 * cells, 1e-8);
  EXPECT_EQ(f.constraints() - floatframe::rank_of(f.constraint_rows()), 3 * cells);
}

}  // namespace
}  // namespace floatframe::test

// Reactions of least norm by sparse factors: an orthogonal projection whose rank is that of the
// constraints.
#include "floatframe/reactions/least_reactions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/loops/redundancy.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Parallelograms in a row, planar: each repeats three constraints. The first crank is `angle` from
/// upright.
std::string text_of_parallelograms(int cells, const std::string& first) {
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
  hinge("a0", "ground", "c0", 0.0, 0.0, first);
  for (int k = 1; k <= cells; ++k) {
    const std::string crank = fmt::format("c{}", k), rod = fmt::format("r{}", k);
    bar(crank, k, 0.5);
    bar(rod, k - 0.5, 1.0);
    hinge(fmt::format("a{}", k), "ground", crank, k, 0.0, "");
    hinge(fmt::format("b{}", k), fmt::format("c{}", k - 1), rod, k - 1, 1.0, "");
    hinge(fmt::format("d{}", k), crank, rod, k, 1.0, "");
  }
  return bodies + joints;
}

/// Those of a run at rest by sparse factors, those of statics by dense linear algebra.
TEST(LeastReactions, AreThoseOfDenseLinearAlgebra) {
  constexpr int cells = 12;
  std::string text = text_of_parallelograms(cells, ", motion: {polynomial: [0.4]}") + "outputs:\n";
  const Model described = model_of(text_of_parallelograms(cells, ""));
  for (const Joint& j : described.joints)
    text += fmt::format("  F_{0}: {{joint_force: {0}}}\n  T_{0}: {{joint_torque: {0}}}\n", j.name);
  const Model model = model_of(text + "simulation: {step: 1e-3, duration: 1e-3}\n");
  const StaticsResult dense = statics(model);
  for (const Coordinates coordinates : both_coordinates) {
    const SimulationDescription o = with(model.simulation, coordinates);
    const RunResult sparse = run(model, o);
    double worst = 0.0, largest = 0.0;
    for (const StaticsJoint& j : dense.joints)
      for (int c = 0; c < 3; ++c) {
        const std::string axis(1, "xyz"[c]);
        for (const auto& [name, x] :
             {std::pair("F_" + j.name, j.force[c]), std::pair("T_" + j.name, j.torque[c])}) {
          const double found = sparse.table.at(0, sparse.table.column(name + "." + axis));
          worst = std::max(worst, std::abs(found - x));
          largest = std::max(largest, std::abs(x));
        }
      }
    std::printf("[ figure ] reactions of 12 parallelograms, sparse - dense [N] %.2g of %.3g\n",
                worst, largest);
    EXPECT_LT(worst, 1e-9 * largest);
  }
}

TEST(LeastReactions, AreAnOrthogonalProjection) {
  constexpr int cells = 6;
  const Model model = model_of(text_of_parallelograms(cells, ", position: 0.4"));
  RelativeFormulation f(model, model.simulation.inertia);
  const State s = relative_start(f, Start::given);
  f.positions(s.t, s.q);
  f.velocities(s.v);
  LeastReactions least(model);
  least.place(f);
  const int n = least.rows();
  MatX P(n, n);
  for (int k = 0; k < n; ++k) {
    VecX lambda = VecX::Unit(n, k);
    least.project_to_minimum_norm(lambda);
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

// Starts of long systems: sparse linear algebra gives what the dense one gives, and says so of the
// models of the benchmark. Times are not tested.
#include "floatframe/bench/bench_start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "floatframe/loops/redundancy.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe::test {
namespace {

/// The model at its start, without accelerations.
template <class F>
struct Started {
  explicit Started(const Model& model) : f(model, InertiaMethod::preprocessing) {
    if constexpr (std::is_same_v<F, RelativeFormulation>) {
      f.start(model, 0.0, state.q, state.v);
    } else {
      Started<RelativeFormulation> tree(model);
      f.start_from(tree.f, tree.state.q, tree.state.v, state.q, state.v);
    }
    state.lambda = VecX::Zero(f.constraints());
    state.a = VecX::Zero(f.velocities());
    go();
  }
  void go() {
    f.positions(0.0, state.q);
    f.velocities(state.v);
    f.dynamics();
  }
  F f;
  State state;
};

TEST(Starts, DiagonalOfTheMassMatrixOfATree) {
  for (const StartKind kind : all_start_kinds)
    for (const bool flexible : {false, true}) {
      const Model model = build_model(start_model(kind, flexible, 3));
      Started<RelativeFormulation> s(model);
      const VecX r0 = residual_at(s.f, 0.0, s.state.q, s.state.v, s.state.lambda);
      const VecX possible = possible_masses(s.f, s.state);
      s.go();
      const MatX M = mass_matrix(s.f, test_accelerations(r0, possible), r0, s.state.lambda);
      const VecX diagonal = s.f.mass_diagonal();
      for (Eigen::Index i = 0; i < diagonal.size(); ++i)
        EXPECT_NEAR(diagonal[i], M(i, i), 1e-9 * possible[i]) << word(kind) << flexible << ' ' << i;
    }
}

template <class F>
double penalty_of(const Model& model) {
  return default_penalty_mass(model, std::is_same_v<F, RelativeFormulation>
                                         ? Coordinates::relative
                                         : Coordinates::absolute);
}

// Links of a chain have no inertia about their own axes. From 17 links on the start is sparse: the
// same accelerations as by dense linear algebra.
template <class F>
void starts_as_by_dense_linear_algebra(const ModelDescription& description) {
  const Model model = build_model(description);
  Started<F> s(model);
  State sparse = s.state, dense = s.state;
  start_accelerations_dense(s.f, dense);
  s.go();
  start_accelerations(s.f, sparse, penalty_of<F>(model));
  // What has no mass of its own, the twist of a link, has no acceleration that the equations tell.
  const VecX diagonal = s.f.mass_diagonal();
  const VecX weight = (diagonal.array() > no_mass * diagonal.maxCoeff()).template cast<double>();
  const double size = 1.0 + dense.a.lpNorm<Eigen::Infinity>();
  EXPECT_LT(weight.cwiseProduct(sparse.a - dense.a).lpNorm<Eigen::Infinity>(), 1e-6 * size)
      << model.name;
}

TEST(Starts, SparseAsByDenseLinearAlgebra) {
  for (const int links : {12, 30}) {
    const ModelDescription chain = start_model(StartKind::chain, true, links);
    starts_as_by_dense_linear_algebra<RelativeFormulation>(chain);
    starts_as_by_dense_linear_algebra<AbsoluteFormulation>(chain);
  }
}

// All loops of a ladder are one cluster, which is wide enough here for a front by its profile.
TEST(Starts, LaddersAsByDenseLinearAlgebra) {
  starts_as_by_dense_linear_algebra<RelativeFormulation>(start_model(StartKind::ladder, false, 60));
  starts_as_by_dense_linear_algebra<RelativeFormulation>(start_model(StartKind::ladder, true, 15));
}

// Its front then has a border: the coordinates of the body that the cluster hangs from.
TEST(Starts, LaddersOnAMovingBodyAsByDenseLinearAlgebra) {
  ModelDescription d = start_model(StartKind::ladder, false, 60);
  d.name = "ladder_on_a_car";
  for (JointDescription& j : d.joints)
    if (j.parent.body == ground_name) j.parent.body = "car";
  BodyDescription car;
  car.name = "car";
  car.kind = RigidDescription{100.0, Vec3::Zero(), 50.0 * Mat3::Identity()};
  d.bodies.push_back(car);
  starts_as_by_dense_linear_algebra<RelativeFormulation>(d);
}

TEST(Starts, AFlexibleChainLacksMassAndIsHeldByStiffness) {
  const Model model = build_model(start_model(StartKind::chain, true, 30));
  Started<RelativeFormulation> s(model);
  const double penalty = penalty_of<RelativeFormulation>(model);
  const VecX possible = possible_masses(s.f, s.state);
  s.go();
  const VecX diagonal = mass_diagonal(s.f, s.state);
  EXPECT_GT(diagonal.size(), few_dense);
  EXPECT_TRUE(may_lack_mass(s.f, diagonal, possible, penalty));
  EXPECT_TRUE(start_held_by_stiffness(s.f, s.state, mass_scale(diagonal, possible), penalty));
}

// Each field of a ladder is a planar loop of hinges: three of its constraints repeat others.
TEST(Starts, RedundantDirectionsOfShortAndLongLadders) {
  for (const int fields : {5, 80}) {
    const ModelCounts counts = check(build_model(start_model(StartKind::ladder, false, fields)));
    EXPECT_EQ(counts.start.redundant.size(), static_cast<std::size_t>(3 * fields));
    EXPECT_EQ(counts.degrees_of_freedom, 1);
  }
}

// At 737 links the masses of single directions are as small as rounding of the sparse test.
TEST(Starts, ALongRigidChainStarts) {
  const Model model = build_model(start_model(StartKind::chain, false, 737));
  Started<RelativeFormulation> s(model);
  EXPECT_NO_THROW(start_accelerations(s.f, s.state, penalty_of<RelativeFormulation>(model)));
  EXPECT_TRUE(s.state.a.allFinite());
}

TEST(Starts, TableHasARowForEachSize) {
  StartOptions o;
  o.kinds = {StartKind::vehicles};
  o.coordinates = {Coordinates::relative};
  o.most = 200;
  o.runs = 1;
  const StartResult r = bench_start(o);
  ASSERT_EQ(r.rows.size(), 8u);
  for (const StartRow& row : r.rows) {
    EXPECT_TRUE(row.failure.empty()) << row.failure;
    EXPECT_GT(row.start, 0.0);
    EXPECT_GT(row.allowed(), 2e-3 + 50e-6 * row.freedoms);
  }
  EXPECT_NE(start_text(r).find("vehicles"), std::string::npos);
  EXPECT_NE(start_json(r).find("\"allowed_s\""), std::string::npos);
}

}  // namespace
}  // namespace floatframe::test

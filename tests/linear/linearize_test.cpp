// The linear system of a model against closed forms, and in both coordinates the same vibrations.
#include "floatframe/linear/linearize.hpp"

#include <gtest/gtest.h>

#include "floatframe/math/dense.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Squares of the circular frequencies of the motions that the constraints allow, ascending
/// [1/s2]: symmetric in equilibrium.
VecX squares(const Linearization& l) {
  const Eigen::Index n = l.M.rows();
  MatX N = MatX::Identity(n, n);
  if (l.J.rows() > 0) {
    // Rows of redundant constraints are no more than one; those of all are scaled alike.
    const PivotedQr qr = pivoted_qr(l.J.transpose(), 1e-10);
    N = qr.Q.rightCols(n - qr.rank);
  }
  const MatX K = N.transpose() * l.K * N, M = N.transpose() * l.M * N;
  EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff());
  const SymmetricEigen e = generalised_eigenvalues(0.5 * (K + K.transpose()), M);
  EXPECT_TRUE(e.found);
  return e.values;
}

TEST(Linearize, MassOnASpring) {
  const Model model = model_of(oscillator);
  const Linearization l = linearize(model);
  ASSERT_EQ(l.M.rows(), 1);
  EXPECT_NEAR(l.M(0, 0), 3, 1e-12);
  EXPECT_NEAR(l.C(0, 0), 7, 1e-9);
  EXPECT_NEAR(l.K(0, 0), 40, 1e-7);
  EXPECT_EQ(l.J.rows(), 0);
  EXPECT_EQ(l.coordinates, std::vector<std::string>{"joint 'slide'"});
  EXPECT_TRUE(l.constraints.empty());
  for (const Coordinates coordinates : both_coordinates) {
    const VecX w2 = squares(linearize(model, {.coordinates = coordinates}));
    ASSERT_EQ(w2.size(), 1);
    EXPECT_NEAR(std::sqrt(w2[0]), std::sqrt(40.0 / 3.0), 1e-8);
  }
}

const char* const pendulum = R"(
bodies: {rod: {position: [0, 0, -1.5], rigid: {mass: 2, inertia: [0.3, 0.3, 0.3]}}}
joints: {arm: {type: revolute, child: rod, at: [0, 0, 0], axis: y}}
simulation: {step: 0.001, duration: 1}
)";
constexpr double inertia = 2 * 1.5 * 1.5 + 0.3, moment = 2 * 1.5 * 9.81;

TEST(Linearize, PendulumInBothCoordinates) {
  const Model model = model_of(pendulum);
  ASSERT_NEAR(model.gravity.norm(), 9.81, 1e-12);
  for (const Coordinates coordinates : both_coordinates) {
    const Linearization l = linearize(model, {.coordinates = coordinates});
    const VecX w2 = squares(l);
    ASSERT_EQ(w2.size(), 1);
    EXPECT_NEAR(w2[0], moment / inertia, 1e-8 * w2[0]);
    EXPECT_EQ(static_cast<Eigen::Index>(l.coordinates.size()), l.M.rows());
    EXPECT_EQ(static_cast<Eigen::Index>(l.constraints.size()), l.J.rows());
    EXPECT_LT(l.r.cwiseAbs().maxCoeff(), 1e-9);
    ASSERT_EQ(l.state.joints.size(), 1u);
    EXPECT_EQ(l.state.joints[0].name, "arm");
    EXPECT_NEAR(l.state.bodies.at(0).position.z(), -1.5, 1e-12);
  }
  const Linearization absolute = linearize(model, {.coordinates = Coordinates::absolute});
  EXPECT_EQ(absolute.M.rows(), 12);
  EXPECT_EQ(absolute.coordinates[0], "body 'rod'");
  EXPECT_EQ(absolute.constraints.back(), "joint 'arm'");
}

TEST(Linearize, AtAStateThatIsGiven) {
  const Model model = model_of(pendulum);
  Simulation s(model, {.step = 1e-3, .start = Start::given});
  SystemState pushed = s.state();
  pushed.joints.at(0).velocity = {2.0};
  pushed.bodies.at(0).velocity = {-3.0, 0.0, 0.0};
  pushed.bodies.at(0).angular_velocity = {0.0, 2.0, 0.0};
  Simulation swinging(model, {.step = 1e-3, .state = std::make_shared<SystemState>(pushed)});
  while (swinging.time() < 0.3) ASSERT_TRUE(swinging.step()) << swinging.failure();
  const auto away = std::make_shared<SystemState>(swinging.state());
  const double angle = away->joints.at(0).position.at(0);
  ASSERT_GT(angle, 0.3);
  const Linearization l = linearize(model, {.coordinates = Coordinates::relative, .state = away});
  EXPECT_NEAR(l.K(0, 0), moment * std::cos(angle), 1e-7);
  EXPECT_NEAR(l.r[0], moment * std::sin(angle), 1e-9);
  EXPECT_NEAR(l.state.time, 0.3, 1e-12);
  EXPECT_NEAR(l.state.joints[0].position[0], angle, 1e-12);
  EXPECT_NEAR(l.state.joints[0].velocity[0], away->joints[0].velocity[0], 1e-12);
}

TEST(Linearize, DoublePendulum) {
  const Model model = model_of(R"(
bodies:
  one: {position: [0, 0, -1], rigid: {mass: 1}}
  two: {position: [0, 0, -2], rigid: {mass: 1}}
joints:
  first: {type: revolute, child: one, at: [0, 0, 0], axis: y}
  second: {type: revolute, parent: one, child: two, at: [0, 0, -1], axis: y}
simulation: {step: 0.001, duration: 1}
)");
  for (const Coordinates coordinates : both_coordinates) {
    const VecX w2 = squares(linearize(model, {.coordinates = coordinates}));
    ASSERT_EQ(w2.size(), 2);
    EXPECT_NEAR(w2[0], 9.81 * (2.0 - std::sqrt(2.0)), 1e-6);
    EXPECT_NEAR(w2[1], 9.81 * (2.0 + std::sqrt(2.0)), 1e-6);
  }
}

TEST(Linearize, AFlexibleLoopInEquilibrium) {
  const Model model = model_of(flexible_loop);
  const Linearization relative = linearize(model, {.coordinates = Coordinates::relative});
  const Linearization absolute = linearize(model, {.coordinates = Coordinates::absolute});
  EXPECT_GT(relative.J.rows(), 0) << "the loop is cut somewhere";
  EXPECT_LT(relative.M.rows(), absolute.M.rows());
  const VecX r = squares(relative), a = squares(absolute);
  ASSERT_EQ(r.size(), a.size());
  ASSERT_GT(r.size(), 5);
  EXPECT_GT(r[0], 0.0);
  for (Eigen::Index k = 0; k < r.size(); ++k)
    EXPECT_NEAR(a[k], r[k], 1e-5 * r[k] + 1e-9 * r[r.size() - 1]) << k;
}

TEST(Linearize, RefusesWhatASimulationRefuses) {
  const Model model = model_of(pendulum);
  EXPECT_TRUE(contains(error_of([&] { linearize(model, {.step = -1.0}); }), "step"));
  SystemState other;
  other.model = "another";
  EXPECT_EQ(error_of([&] { linearize(model, {.state = std::make_shared<SystemState>(other)}); }),
            "duplicate");
}

}  // namespace
}  // namespace floatframe::test

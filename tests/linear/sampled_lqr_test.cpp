// An inverted pendulum on the tip of a flexible column on a cart, balanced by a sampled LQR: its
// gains follow from the matrices of `linearize` by the discrete Riccati equation, and its motion
// from the discrete closed loop.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/math/dense.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double period = 0.02;

/// Six outputs, as many as states: the cart, the bending of the column, the angle of the pendulum.
std::string lqr_pendulum(const std::string& actuator, double tilt, const std::string& more = "") {
  return fmt::format(R"(
points: {{o: [0, 0, 0], tip: [0, 0, 1], head: [0, 0, 1.6]}}
bodies:
  cart: {{rigid: {{mass: 2, centre_of_mass: o, inertia: [0.01, 0.01, 0.01]}}}}
  column:
    flexible:
      material: {{young: 7e10, poisson: 0.3, density: 2700}}
      bars: {{one: {{from: o, to: tip, elements: 4, section: {{rectangle: [0.03, 0.004]}}}}}}
      clamped: [o]
      static_modes: [{{point: tip, dofs: [x]}}]
      normal_modes: 0
  pendulum: {{rigid: {{mass: 0.1, centre_of_mass: head, inertia: [0.001, 0.001, 0.001]}}}}
joints:
  slide: {{type: prismatic, child: cart, at: o, axis: x}}
  foot: {{type: weld, parent: cart, child: column, at: o}}
  hinge: {{type: revolute, parent: column, child: pendulum, at: tip, axis: y, position: {}}}
forces: {{push: {{type: joint_spring, joint: slide, actuator: {}}}}}
outputs:
  x: {{joint_position: slide}}
  v: {{joint_velocity: slide}}
  tip: {{position: {{body: column, node: tip}}, axis: x}}
  tip_v: {{velocity: {{body: column, node: tip}}, axis: x}}
  q: {{joint_position: hinge}}
  w: {{joint_velocity: hinge}}
{}
simulation: {{step: 0.002, duration: 1}}
)",
                     tilt, actuator, more);
}

/// exp(M) by a series of M / 2^10.
MatX exponential(MatX M) {
  M /= 1024.0;
  MatX sum = MatX::Identity(M.rows(), M.cols()), term = sum;
  for (int k = 1; k < 12; ++k) {
    term = term * M / k;
    sum += term;
  }
  for (int k = 0; k < 10; ++k) sum = (sum * sum).eval();
  return sum;
}

/// y_k+1 = A y_k + B u_k of the outputs, and u = -K y, which minimises sum y^T y + u^2 / 100.
struct Lqr {
  MatX A, B, K;
};
Lqr lqr(Coordinates c) {
  const Model model = model_of(lqr_pendulum("{input: u}", 0.0, "inputs: {u: {unit: N}}"));
  const StateSpace s = state_space(linear_model(model, {}, {.coordinates = c}));
  EXPECT_EQ(s.C.rows(), s.C.cols());
  EXPECT_TRUE(s.D.isZero(1e-12));
  const Eigen::Index n = s.A.rows();
  MatX M = MatX::Zero(n + 1, n + 1);
  const MatX back = lu_solve(s.C, MatX(MatX::Identity(n, n)));
  M.topLeftCorner(n, n) = period * s.C * s.A * back;
  M.topRightCorner(n, 1) = period * s.C * s.B;
  const MatX E = exponential(M);
  Lqr out{E.topLeftCorner(n, n), E.topRightCorner(n, 1), {}};
  MatX P = MatX::Identity(n, n);
  for (int k = 0; k < 5000; ++k) {
    out.K = (out.B.transpose() * P * out.A) / (0.01 + (out.B.transpose() * P * out.B)(0));
    P = (MatX::Identity(n, n) + out.A.transpose() * P * (out.A - out.B * out.K)).eval();
    P = (0.5 * (P + P.transpose())).eval();
  }
  return out;
}

Model lqr_balanced(const MatX& K, double tilt, double delay = 0.0) {
  std::string formula;
  const char* const names[] = {"x", "v", "tip", "tip_v", "q", "w"};
  for (int k = 0; k < 6; ++k)
    formula += fmt::format("{}({:.17g}) * {}", k ? " + " : "-(", K(k), names[k]);
  const std::string lqr = fmt::format(
      "controllers: {{lqr: {{type: zero_order_hold, input: {{formula: '{})'}}, period: {}, delay: "
      "{}}}}}",
      formula, period, delay);
  return model_of(lqr_pendulum("{controller: lqr}", tilt, lqr));
}

VecX last_outputs(const Model& model, Coordinates c, double step, double duration) {
  const RunResult r = completed_run(model, with(model.simulation, c, step, duration));
  return Eigen::Map<const VecX>(&*(r.table.data.end() - 6), 6);
}

TEST(SampledLqr, GainsAreThoseOfBothFormulations) {
  const Lqr a = lqr(Coordinates::absolute), r = lqr(Coordinates::relative);
  EXPECT_LT((a.K - r.K).norm(), 1e-6 * r.K.norm());
  EXPECT_GT(general_eigen(r.A).values.cwiseAbs().maxCoeff(), 1.05);  // it falls
  EXPECT_LT(general_eigen(r.A - r.B * r.K).values.cwiseAbs().maxCoeff(), 0.99);
}

// A small tilt: as the discrete closed loop says, up to the errors of the steps.
TEST(SampledLqr, MovesAsTheDiscreteClosedLoop) {
  const Lqr l = lqr(Coordinates::relative);
  constexpr double tilt = 1e-3;
  const Model model = lqr_balanced(l.K, tilt);
  VecX y = VecX::Zero(6);
  y[4] = tilt;
  for (int k = 0; k < 40; ++k) y = (l.A * y - l.B * (l.K * y)).eval();
  for (const Coordinates c : both_coordinates) {
    double errors[2];
    for (int k = 0; k < 2; ++k)
      errors[k] = (last_outputs(model, c, k == 0 ? 1e-3 : 2.5e-4, 40 * period) - y).norm();
    EXPECT_LT(errors[1], 2e-3 * tilt);
    EXPECT_GT(errors[0] / errors[1], 4.0);
  }
}

// From 0.2 rad it comes back to rest, with steps that divide the period or do not; absolute =
// relative up to the error of the steps.
TEST(SampledLqr, BalancesThePendulum) {
  const Lqr l = lqr(Coordinates::relative);
  const Model model = lqr_balanced(l.K, 0.2);
  double differences[2];
  for (int k = 0; k < 2; ++k) {
    const double h = k == 0 ? 2e-3 : 1e-3;
    const VecX a = last_outputs(model, Coordinates::absolute, h, 1.0),
               r = last_outputs(model, Coordinates::relative, h, 1.0);
    differences[k] = (a - r).norm();
  }
  EXPECT_LT(differences[1], 1e-4);
  EXPECT_GT(differences[0] / differences[1], 3.5);
  for (const Coordinates c : both_coordinates)
    EXPECT_LT(last_outputs(model, c, 3e-3, 12.0).cwiseAbs().maxCoeff(), 2e-3);
}

// A delay of six periods is too much: it falls.
TEST(SampledLqr, FallsIfItActsTooLate) {
  const Lqr l = lqr(Coordinates::relative);
  const VecX y =
      last_outputs(lqr_balanced(l.K, 1e-3, 6 * period), Coordinates::relative, 2e-3, 2.0);
  EXPECT_GT(std::abs(y[4]), 0.1);  // a hundred times the tilt
}

}  // namespace
}  // namespace floatframe::test

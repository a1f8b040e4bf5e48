// The rows of a point that slides along nodes of a flexible body, where it is on its path:
// gradients and accelerations against differences, in both formulations.
#include <gtest/gtest.h>

#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

constexpr double time_of_slide = 0.3;

/// A flexible body and a free one, whose point slides along nodes of the first with a motion.
ModelDescription sliding_pair() {
  RandomSystem s(29);
  s.add_body("girder", 4);
  s.add_body("trolley", 3);
  s.add_joint("root", JointType::spherical, ground_name, 0, "girder", 0);
  SlideAlong keys;
  keys.a = s.at("girder", 1);
  keys.b = s.at("trolley", 2);
  const BodyDescription& girder = s.d.bodies[0];
  const std::vector<ModalNode>& nodes = std::get<FlexibleBody>(girder.kind).nodes;
  keys.points.resize(4, 3);
  for (int k = 0; k < 4; ++k)
    keys.points.row(k) = (girder.X_WB.R * (nodes[k + 1].p - nodes[1].p)).transpose();
  keys.motion = TimeFunction{PiecewisePolynomial::polynomial({0.4, 0.5, -0.2}), {}};
  s.d.constraints = {{"path", keys, {}}};
  return s.d;
}

class SlideRows : public ::testing::Test {
 protected:
  static constexpr int rows = 3;
  Model model_ = build_model(sliding_pair());
  RandomPair pair_{model_, 5};

  /// Moves the trolley to the path at time_of_slide, and along it as the motion says.
  static void put_on_path(RelativeFormulation& f, VecX& q, VecX& v) {
    const TreeBody& trolley = f.tree().body(1);
    const auto by_trolley = [&](const VecX& error) {
      const MatX J = f.constraint_jacobian().middleCols(trolley.iv, trolley.nj);
      VecX dx = VecX::Zero(f.velocities());
      dx.segment(trolley.iv, trolley.nj) = -J.completeOrthogonalDecomposition().solve(error);
      return dx;
    };
    for (int round = 0; round < 30; ++round) {
      evaluate_at(f, time_of_slide, q, v);
      if (largest(f.constraint_values()) < 1e-13) break;
      const VecX before = q;
      f.retract(before, by_trolley(f.constraint_values()), q);
    }
    evaluate_at(f, time_of_slide, q, v);
    EXPECT_LT(largest(f.constraint_values()), 1e-12);
    VecX rates(f.constraints());
    f.constraint_rates(rates);
    v += by_trolley(rates);
  }
};

TEST_F(SlideRows, AreThoseOfDifferencesOnThePath) {
  auto& [relative, absolute, random, q, v, qa, va] = pair_;
  put_on_path(relative, q, v);
  absolute.start_from(relative, q, v, qa, va);
  const VecX a = random.vector(relative.velocities(), 3.0);
  const VecX aa = absolute_accelerations(relative, absolute, q, v, a);
  const auto check = [&](auto& f, const VecX& place, const VecX& rate, const VecX& acceleration,
                         bool independent) {
    evaluate_at(f, time_of_slide, place, rate);
    EXPECT_LT(largest(f.constraint_values().tail(rows)), 1e-10);
    constexpr double h = 1e-5;
    VecX plus(f.constraints()), minus(f.constraints()), exact(f.constraints()), moved = place;
    const auto go = [&](double dt, bool values, VecX& out) {
      f.retract(place, dt * rate + 0.5 * dt * dt * acceleration, moved);
      evaluate_at(f, time_of_slide + dt, moved, rate + dt * acceleration);
      values ? void(out = f.constraint_values()) : f.constraint_rates(out);
    };
    for (const bool values : {true, false}) {
      go(h, values, plus);
      go(-h, values, minus);
      evaluate_at(f, time_of_slide, place, rate);
      values ? f.constraint_rates(exact) : f.constraint_accelerations(acceleration, exact);
      for (Eigen::Index i = f.constraints() - rows; i < f.constraints(); ++i)
        EXPECT_NEAR(exact[i], (plus[i] - minus[i]) / (2.0 * h), 2e-6 * (1.0 + std::abs(exact[i])))
            << i << values;
    }
    const MatX J = f.constraint_jacobian();
    const VecX w = Random(9).vector(f.constraints());
    VecX push(f.velocities());
    f.constraint_forces(w, push);
    EXPECT_LT(largest(push - J.transpose() * w), 1e-11);
    // Along each coordinate; natural ones alone leave the rotations.
    if (!independent) return;
    for (int j = 0; j < f.velocities(); ++j) {
      const VecX unit = VecX::Unit(f.velocities(), j);
      f.retract(place, h * unit, moved);
      evaluate_at(f, time_of_slide, moved, rate);
      plus = f.constraint_values();
      f.retract(place, -h * unit, moved);
      evaluate_at(f, time_of_slide, moved, rate);
      const VecX slope = (plus - f.constraint_values()) / (2.0 * h);
      for (Eigen::Index i = f.constraints() - rows; i < f.constraints(); ++i)
        EXPECT_NEAR(J(i, j), slope[i], 1e-7 * (1.0 + std::abs(slope[i]))) << i << ' ' << j;
    }
  };
  check(relative, q, v, a, true);
  check(absolute, qa, va, aa, false);
}

}  // namespace
}  // namespace floatframe::test

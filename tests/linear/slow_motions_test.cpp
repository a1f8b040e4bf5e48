// The slowest motions of models of many degrees of freedom: those of a small model beside which
// many stiff pendulums stand are those of the small one, at rest or moving, with loops and without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr int pendulums = few_degrees + 10;

struct Pieces {
  std::string bodies, joints, forces = "";
};

std::string text_of(const Pieces& p) {
  return "gravity: [0, 0, 0]\nbodies:\n" + p.bodies + "joints:\n" + p.joints +
         (p.forces.empty() ? "" : "forces:\n" + p.forces) + "simulation: {step: 0.001}\n";
}

/// With pendulums of 300 rad/s and more beside it.
std::string among_pendulums(Pieces p) {
  for (int k = 0; k < pendulums; ++k) {
    const std::string n = std::to_string(k);
    p.bodies += "  w" + n + ": {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [0, 0, -5]}\n";
    p.joints += "  h" + n + ": {type: revolute, child: w" + n + ", at: [0, 0, -5], axis: y}\n";
    p.forces += "  k" + n + ": {type: joint_spring, joint: h" + n +
                ", spring: " + std::to_string(9e4 * (1.0 + k)) + "}\n";
  }
  return text_of(p);
}

/// Without those that nothing holds: place and speed are two real ones or a pair, by rounding.
std::vector<LinearMode> held_modes(const LinearSystem& system) {
  std::vector<LinearMode> modes = linear_modes(system);
  std::erase_if(modes, [](const LinearMode& m) { return std::abs(m.lambda) < 1e-3; });
  return modes;
}

void expect_motions_of_the_small(const Pieces& pieces) {
  const LinearSystem small = linear_system(model_of(text_of(pieces)));
  const auto expected = held_modes(small);
  const Model model = model_of(among_pendulums(pieces));
  const int count = static_cast<int>(expected.size()) + 5;
  const LinearSystem large = linear_system(model, {}, count);
  EXPECT_EQ(large.degrees, small.degrees + pendulums);
  EXPECT_EQ(large.massless, 0);
  EXPECT_LE(large.A.rows(), 2 * count + 2);
  EXPECT_NEAR(large.fastest, std::sqrt(9e4 * pendulums), 0.05 * large.fastest);
  const auto found = held_modes(large);
  ASSERT_GE(found.size(), expected.size() + 1);
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_LT(std::abs(found[k].lambda - expected[k].lambda),
              1e-7 * std::max(1.0, std::abs(expected[k].lambda)))
        << k << " " << found[k].lambda << " " << expected[k].lambda;
  EXPECT_NEAR(found[expected.size()].lambda.imag(), 300.0, 1e-6);
  const auto springs = std::ranges::count_if(model.elements, &Element::acts);
  EXPECT_NEAR(mode_parts(model, large, found[expected.size()]).springs.at(springs - pendulums), 1.0,
              1e-6);
  // Shapes move as the system says: the increments follow, and so do the accelerations.
  const double size = (large.x_of * large.A).norm();
  EXPECT_LT((large.xdot_of - large.x_of * large.A).norm(), 1e-9 * size);
}

TEST(SlowMotions, DampedOscillator) {
  expect_motions_of_the_small({"  box: {position: [0, 0, 0], rigid: {mass: 3}}\n",
                               "  slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}\n",
                               "  s: {type: joint_spring, joint: slide, spring: 40, damper: 7}\n"});
}

TEST(SlowMotions, OverdampedOscillator) {
  expect_motions_of_the_small(
      {"  box: {position: [0, 0, 0], rigid: {mass: 3}}\n",
       "  slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}\n",
       "  s: {type: joint_spring, joint: slide, spring: 40, damper: 70}\n"});
}

TEST(SlowMotions, BeadOnAnArmThatIsDriven) {
  expect_motions_of_the_small(
      {"  arm: {position: [0, 0, 0], rigid: {mass: 1, inertia: [1, 1, 1]}}\n"
       "  bead: {position: [0.5, 0, 0], rigid: {mass: 0.2}}\n",
       "  drive: {type: revolute, child: arm, at: [0, 0, 0], axis: z, motion: {polynomial: [0, "
       "12]}}\n"
       "  slide: {type: prismatic, parent: arm, child: bead, at: [0.5, 0, 0], axis: x}\n",
       "  s: {type: joint_spring, joint: slide, spring: {linear: {stiffness: 90, preload: "
       "-14.4}}}\n"});
}

// Its axis turns with what it spins by: Gamma is not zero.
TEST(SlowMotions, SpinningTopOnASpring) {
  expect_motions_of_the_small(
      {"  top: {position: [0, 0, 0.04], rigid: {mass: 0.5, inertia: [8e-4, 8e-4, 3e-4]}}\n",
       "  tip: {type: spherical, child: top, at: [0, 0, 0], velocity: [0, 0, 40]}\n",
       "  s: {type: spring_damper, from: {body: ground, at: [0, 0, 0.3]}, to: {body: top, at: [0, "
       "0, 0.04]}, "
       "spring: {linear: {stiffness: 50, free: 0.2}}}\n"});
}

TEST(SlowMotions, FourBarLoop) {
  expect_motions_of_the_small(
      {"  a: {position: [0, 0, 0.5], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}\n"
       "  b: {position: [0.7, 0, 1.1], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}\n"
       "  c: {position: [1.4, 0, 0.6], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}\n",
       "  j1: {type: revolute, child: a, at: [0, 0, 0], axis: y}\n"
       "  j2: {type: revolute, parent: a, child: b, at: [0, 0, 1], axis: y}\n"
       "  j3: {type: revolute, parent: b, child: c, at: [1.4, 0, 1.2], axis: y}\n"
       "  j4: {type: revolute, child: c, at: [1.4, 0, 0], axis: y}\n",
       "  s: {type: joint_spring, joint: j1, spring: 12, damper: 0.1}\n"});
}

// Six motions that nothing holds, each with a place and a speed.
TEST(SlowMotions, FreeBody) {
  const Pieces pieces{"  box: {position: [0, 0, 1], rigid: {mass: 3, inertia: [1, 2, 3]}}\n",
                      "  free: {type: free, child: box, at: [0, 0, 1]}\n"};
  const LinearSystem s = linear_system(model_of(among_pendulums(pieces)), {}, 20);
  const MatX still = s.A.topLeftCorner(12, 12);
  EXPECT_LT((still * still).norm(), 1e-6 * still.squaredNorm());
  EXPECT_EQ(pivoted_rank(s.x_of.leftCols(12), 1e-6), 6);
  EXPECT_EQ(pivoted_rank(s.v_of.leftCols(12), 1e-6), 6);
  const auto modes = linear_modes(s);
  for (const LinearMode& m : modes)
    EXPECT_TRUE(std::abs(m.lambda) < 1e-7 * s.fastest || m.lambda.imag() > 299.0) << m.lambda;
}

TEST(SlowMotions, HeldByNothing) {
  const Pieces pieces{"  dummy: {position: [0, 0, 1], rigid: {mass: 0}}\n",
                      "  slide: {type: prismatic, child: dummy, at: [0, 0, 0], axis: x}\n"};
  EXPECT_THROW(linear_system(model_of(among_pendulums(pieces)), {}, 20), RunError);
}

TEST(SlowMotions, SmallModelsHaveAll) {
  const Pieces pieces{"  box: {position: [0, 0, 0], rigid: {mass: 3}}\n",
                      "  slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}\n",
                      "  s: {type: joint_spring, joint: slide, spring: 40, damper: 7}\n"};
  const Model model = model_of(text_of(pieces));
  EXPECT_EQ(linear_system(model, {}, 40).A, linear_system(model).A);
  EXPECT_EQ(linear_system(model, {}, 40).fastest, 0.0);
}

}  // namespace
}  // namespace floatframe::test

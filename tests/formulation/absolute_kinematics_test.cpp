// The rows of the bodies in natural coordinates, without any inertia: they hold after `settle` and
// `advance`, and their rates, increments and forces belong together.
#include "floatframe/formulation/absolute_kinematics.hpp"

#include <gtest/gtest.h>

#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

TEST(AbsoluteKinematics, RowsOfBodiesHoldAndBelongToTheirForces) {
  RandomSystem s(7);
  for (const char* name : {"a", "b"}) s.add_body(name, 3);
  s.add_joint("first", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("second", JointType::spherical, "a", 1, "b", 0);
  const Model model = build_model(s.d);
  ConstraintSet set(model, std::vector<int>{0, 1});
  AbsoluteKinematics k(model, set);
  const AbsoluteBody& last = k.bodies().back();
  const int own = last.row + last.rows();
  ASSERT_EQ(last.points, 1);
  EXPECT_EQ(k.size(), last.offset + last.size());
  EXPECT_EQ(set.offset(0), own);
  EXPECT_EQ(k.coordinate_owner(last.point(0)), "outer point 1 of body 'b'");

  VecX q = s.random.vector(k.size(), 0.1), x = VecX::Zero(k.size()), phi = VecX::Zero(set.count());
  for (const AbsoluteBody& b : k.bodies())
    for (int c = 0; c < 3; ++c) q[b.axis(c) + c] += 1.0;
  const VecX v = s.random.vector(k.size(), 1.0), w = s.random.vector(own, 1.0);
  const auto violation = [&](const VecX& at) {
    k.positions(at);
    k.velocities(v, phi);
    return largest(phi.head(own));
  };
  EXPECT_GT(violation(q), 1e-2);
  k.settle(q, x);
  q += x;
  EXPECT_LT(violation(q), 1e-13);

  VecX rates = phi, increments = phi, forces = VecX::Zero(k.size());
  k.own_rates(rates);
  k.own_increments(v, increments);
  EXPECT_LT(largest(rates - increments), 1e-13);
  for (const AbsoluteBody& b : k.bodies()) k.add_own_forces(b, w, forces);
  EXPECT_NEAR(forces.dot(v), w.dot(rates.head(own)), 1e-12);

  x.setZero();
  k.advance(x, v);
  EXPECT_GT(largest(x), 0.1);
  EXPECT_LT(violation(q + x), 1e-13);
}

}  // namespace
}  // namespace floatframe::test

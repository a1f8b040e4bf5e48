// The equations of motion near a state against closed forms, and what every system must obey.
#include "floatframe/tangents/linearization.hpp"

#include <gtest/gtest.h>

#include "floatframe/tangents/small_motions.hpp"
#include "support/linear_models.hpp"
#include "support/model_text.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

template <class F>
State at(const F& f, const VecX& q, const VecX& v) {
  State s;
  s.q = q;
  s.v = v;
  s.lambda = VecX::Zero(f.constraints());
  return s;
}

TEST(Linearization, PendulumHanging) {
  const Model model = model_of(R"(
bodies: {ball: {position: [0, 0, -1.5], rigid: {mass: 2}}}
joints: {arm: {type: revolute, child: ball, at: [0, 0, 0], axis: y}}
simulation: {step: 0.001, duration: 1}
)");
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  State s;
  f.start(s.q, s.v);
  s.lambda = VecX::Zero(0);
  const SmallMotions l = small_motions(f, s);
  EXPECT_NEAR(l.r[0], 0.0, 1e-14);
  EXPECT_NEAR(l.M(0, 0), 2 * 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(l.K(0, 0), 2 * 1.5 * model.gravity.norm(), 1e-8);
  EXPECT_NEAR(l.C(0, 0), 0.0, 1e-10);
  EXPECT_EQ(l.J.rows(), 0);
}

TEST(Linearization, SlidingMassOnSpringAndDamper) {
  const Model model = model_of(oscillator);
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  VecX q, v;
  f.start(q, v);
  q[0] = 0.25;
  const SmallMotions l = small_motions(f, at(f, q, VecX::Constant(1, 0.5)));
  EXPECT_NEAR(l.r[0], 40 * 0.25 + 7 * 0.5, 1e-12);
  EXPECT_NEAR(l.M(0, 0), 3, 1e-12);
  EXPECT_NEAR(l.K(0, 0), 40, 1e-7);
  EXPECT_NEAR(l.C(0, 0), 7, 1e-9);
}

/// Flexible and rigid bodies on revolute joints; `cut`: a loop.
Model mechanism(bool cut) {
  RandomSystem s(5);
  s.add_body("a", 3);
  s.add_body("b", 0);
  s.add_body("c", 2);
  s.add_joint("first", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("second", JointType::revolute, "a", 1, "b", 0);
  s.add_joint("third", JointType::prismatic, "b", 1, "c", 1);
  if (cut) s.add_joint("loop", JointType::spherical, ground_name, 0, "c", 2).cut = true;
  return build_model(s.d);
}

TEST(Linearization, StiffnessOfATreeIsAHessian) {
  const Model model = mechanism(false);
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  Random random(3);
  VecX q, v;
  random_configuration(f, random, q, v);
  const SmallMotions l = small_motions(f, at(f, q, VecX::Zero(f.velocities())));
  EXPECT_GT(largest(l.K), 1.0);
  EXPECT_LT(largest(l.K - l.K.transpose()), 1e-6 * largest(l.K));
  EXPECT_LT(largest(l.M - l.M.transpose()), 1e-12 * largest(l.M));
}

/// Inertia forces are of second order in the velocities: C v is twice their part of r.
template <class F>
void expect_second_order(F& f, const VecX& q, const VecX& v) {
  const State moving = at(f, q, v), still = at(f, q, VecX::Zero(v.size()));
  const VecX part =
      residual_at(f, 0.0, q, v, moving.lambda) - residual_at(f, 0.0, q, still.v, still.lambda);
  const SmallMotions l = small_motions(f, moving);
  EXPECT_GT(largest(part), 1e-2);
  EXPECT_LT(largest(l.C * v - 2.0 * part), 1e-8 * largest(part));
}

TEST(Linearization, InertiaForcesInBothFormulations) {
  const Model model = mechanism(true);
  RandomPair pair(model, 7);
  auto& [relative, absolute, random, q, v, qa, va] = pair;
  expect_second_order(relative, q, v);
  expect_second_order(absolute, qa, va);
  // The same masses, and rows of the cut joint, seen through the map of velocities.
  const MatX map = velocity_map(relative, absolute, q);
  const SmallMotions r = small_motions(relative, at(relative, q, v));
  const SmallMotions a = small_motions(absolute, at(absolute, qa, va));
  EXPECT_LT(largest(map.transpose() * a.M * map - r.M), 1e-10 * largest(r.M));
  const std::vector<ConstraintPart>& parts = absolute.constraint_set().parts();
  std::size_t loop = parts.size();
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (owner_name(model, parts[k].owner) == "joint 'loop'") loop = k;
  ASSERT_LT(loop, parts.size());
  ASSERT_EQ(r.J.rows(), 3);
  const MatX rows = a.J.middleRows(absolute.constraint_set().offset(loop), 3) * map;
  EXPECT_LT(largest(rows - r.J), 1e-12 * largest(r.J));
}

TEST(Linearization, PredictsTheResidualOfASmallMotion) {
  const Model model = mechanism(true);
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  Random random(9);
  VecX q, v;
  random_configuration(f, random, q, v);
  State s = at(f, q, v);
  s.lambda = random.vector(f.constraints(), 5.0);
  const SmallMotions l = small_motions(f, s);
  const VecX phi = f.constraint_values();
  const int nv = f.velocities();
  const VecX x = random.vector(nv, 1.0), xdot = random.vector(nv, 1.0);
  const VecX dlambda = random.vector(f.constraints(), 1.0);
  VecX errors[2];
  const double sizes[2] = {1e-3, 5e-4};
  for (int k = 0; k < 2; ++k) {
    VecX q1 = q;
    f.retract(q, VecX(sizes[k] * x), q1);
    const VecX r =
        residual_at(f, 0.0, q1, VecX(v + sizes[k] * xdot), VecX(s.lambda + sizes[k] * dlambda));
    VecX all(nv + f.constraints());
    all << r - l.r - sizes[k] * (l.K * x + l.C * xdot + l.J.transpose() * dlambda),
        f.constraint_values() - phi - sizes[k] * (l.J * x);
    errors[k] = all;
  }
  // What is left is of second order.
  EXPECT_LT(largest(errors[0]), 1e-2 * sizes[0] * largest(l.K));
  EXPECT_NEAR(largest(errors[1]) / largest(errors[0]), 0.25, 0.02);
}

/// dg/ds at 0, of sixth order.
template <class G>
VecX slope(const G& g, double h) {
  const auto central = [&](double step) { return VecX((g(step) - g(-step)) / (2.0 * step)); };
  return (64.0 * central(0.25 * h) - 20.0 * central(0.5 * h) + central(h)) / 45.0;
}

/// All derivatives along random directions, in motion, with accelerations and multipliers.
template <class F>
double distance_from_differences(F& f, State s, Random& random) {
  const int nv = f.velocities(), nc = f.constraints();
  s.a = random.vector(nv, 3.0);
  s.lambda = random.vector(nc, 5.0);
  const SmallMotions m = small_motions(f, s);
  const VecX x = random.vector(nv, 1.0);
  const auto terms = [&](const VecX& dx, const VecX& dv, const VecX& da) {
    VecX all(nv + 2 * nc), part(nc), r(nv), q = s.q;
    f.retract(s.q, dx, q);
    f.positions(s.t, q);
    f.velocities(VecX(s.v + dv));
    f.dynamics();
    f.residual(VecX(s.a + da), s.lambda, 0.0, r);
    all.head(nv) = r;
    f.constraint_rates(part);
    all.segment(nv, nc) = part;
    f.constraint_accelerations(VecX(s.a + da), part);
    all.tail(nc) = part;
    return all;
  };
  const VecX zero = VecX::Zero(nv);
  const VecX along = slope([&](double h) { return terms(VecX(h * x), zero, zero); }, 4e-3),
             rate = slope([&](double h) { return terms(zero, VecX(h * x), zero); }, 4e-2),
             acceleration = slope([&](double h) { return terms(zero, zero, VecX(h * x)); }, 1.0);
  const auto off = [&](const VecX& found, const MatX& matrix) {
    const double size = (matrix.cwiseAbs() * x.cwiseAbs()).maxCoeff();
    return size > 0.0 ? largest(found - matrix * x) / size : largest(found);
  };
  return std::max({off(along.head(nv), m.K), off(along.segment(nv, nc), m.G),
                   off(along.tail(nc), m.H), off(rate.head(nv), m.C),
                   off(rate.segment(nv, nc), m.J), off(rate.tail(nc), m.D),
                   off(acceleration.head(nv), m.M), off(acceleration.tail(nc), m.J)});
}

TEST(SmallMotions, DerivativesAgainstCentralDifferences) {
  double worst = 0.0;
  for (const std::uint64_t seed : {11, 12, 13}) {
    const Model model = mechanism(true);
    RandomPair pair(model, seed);
    auto& [relative, absolute, random, q, v, qa, va] = pair;
    worst = std::max({worst, distance_from_differences(relative, at(relative, q, v), random),
                      distance_from_differences(absolute, at(absolute, qa, va), random)});
  }
  std::printf("[ figure ] derivatives_against_differences %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);
}

}  // namespace
}  // namespace floatframe::test

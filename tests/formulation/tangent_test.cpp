// The factorised tangent T = mass M + s (K + alpha Phi_q^T Phi_q), read off dense by unit solves,
// against the mass matrix and finite differences of the residual at rest.
//
// What K holds: modal stiffness, tangent rows of the forces, and the geometric stiffness of forces
// and multipliers of point and distance constraints. That is all of dr/dq for rigid bodies, and for
// constraints on flexible bodies in absolute coordinates. Left out on purpose, because a Newton
// iteration multiplies it with s = h^2/4:
//   - geometric stiffness of direction rows (perpendicular, in_line, drives), but for those that
//     hold a body without mass in absolute coordinates;
//   - second derivatives of a marker's motion with respect to modal amplitudes;
//   - relative: that a force between two bodies turns with the body that carries both.
// In relative coordinates an increment of a ball joint is a rotation vector, and dr/dq is not
// symmetric away from equilibrium: T holds its symmetric part.
#include <gtest/gtest.h>

#include "floatframe/math/dense.hpp"
#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

enum class Closure { none, spherical, revolute, rod, spring_to_ground, spring_between };

Model build_chain(JointType middle, Closure closure, int modes, bool massless = false) {
  RandomSystem s(40 + static_cast<unsigned>(middle));
  s.d.gravity.setZero();
  for (const char* name : {"a", "b", "c"}) s.add_body(name, modes);
  if (massless) s.d.bodies[1].kind = RigidDescription();
  s.add_joint("first", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("middle", middle, "a", 1, "b", 0);
  s.add_joint("last", JointType::revolute, "b", 1, "c", 0);
  SpringDamper spring;
  spring.spring = PiecewisePolynomial::linear(30.0, 0.5);
  spring.a = s.at(closure == Closure::spring_between ? "a" : ground_name, 2);
  spring.b = s.at("c", 2);
  switch (closure) {
    case Closure::none:
      break;
    case Closure::spherical:
      s.add_joint("cut", JointType::spherical, ground_name, 0, "c", 3).cut = true;
      break;
    case Closure::revolute:
      s.add_joint("cut", JointType::revolute, ground_name, 0, "c", 3).cut = true;
      break;
    case Closure::rod:
      s.d.rods = {make_rod("rod", s.at(ground_name, 0), s.at("c", 3), 0.8)};
      break;
    case Closure::spring_to_ground:
    case Closure::spring_between: {
      s.d.forces = {{"spring", spring, {}}};
    }
  }
  return build_model(s.d);
}

struct Tangent {
  double symmetry = 0.0;  ///< of T, relative
  double difference = 0.0, mass = 0.0, stiffness = 0.0;
};

bool has_mass(const Model& model, int marker) {
  const int body = model.markers[marker].body;
  return body < 0 || model.bodies[body].data->invariants.m > 0.0;
}

template <class F>
Tangent compare(F& f, const VecX& q, double s, double alpha) {
  const int n = f.velocities();
  const VecX zero = VecX::Zero(n);
  VecX lambda = Random(3).vector(f.constraints(), 10.0);
  for (std::size_t k = 0; k < f.constraint_set().parts().size(); ++k) {
    const ConstraintPart& part = f.constraint_set().parts()[k];
    if (constraint_kind(part.type).gradients == PartGradients::general &&
        has_mass(f.model(), part.a) && has_mass(f.model(), part.b))
      lambda.segment(f.constraint_set().offset(k), part.rows()).setZero();
  }
  VecX plus(n), minus(n), q1 = q;
  const auto residual_at = [&](const VecX& at, VecX& out) {
    evaluate_at(f, 0.0, at, zero);
    f.dynamics();
    f.residual(zero, lambda, 0.0, out);
  };
  MatX K(n, n), M(n, n), inverse(n, n);
  const double h = 1e-5;
  for (int j = 0; j < n; ++j) {
    f.retract(q, h * VecX::Unit(n, j), q1);
    residual_at(q1, plus);
    f.retract(q, -h * VecX::Unit(n, j), q1);
    residual_at(q1, minus);
    K.col(j) = (plus - minus) / (2 * h);
  }
  residual_at(q, minus);
  for (int j = 0; j < n; ++j) {
    f.residual(VecX::Unit(n, j), lambda, 0.0, plus);
    M.col(j) = plus - minus;
  }
  const MatX J = f.constraint_jacobian();
  EXPECT_EQ(f.factorize(1.0, 0.0, s, alpha), -1);
  for (int j = 0; j < n; ++j) {
    VecX x = VecX::Unit(n, j);
    f.solve(x);
    inverse.col(j) = x;
  }
  // What the formulation holds exactly has no stiffness.
  const MatX Z = free_directions(f);
  const MatX T = lu_solve(MatX(Z.transpose() * inverse * Z), MatX::Identity(Z.cols(), Z.cols()));
  Tangent t;
  t.symmetry = largest(inverse - inverse.transpose()) / largest(inverse);
  const MatX sum = M + s * alpha * J.transpose() * J + 0.5 * s * (K + K.transpose());
  t.difference = largest(T - Z.transpose() * sum * Z);
  t.mass = largest(M);
  t.stiffness = largest(K);
  return t;
}

class TangentOfJoint : public ::testing::TestWithParam<JointType> {
 protected:
  static constexpr Closure closures[] = {
      Closure::none, Closure::spherical,        Closure::revolute,
      Closure::rod,  Closure::spring_to_ground, Closure::spring_between};
};

TEST_P(TangentOfJoint, IsTheDerivativeOfTheResidualForRigidBodies) {
  for (const Closure closure : closures) {
    const Model m = build_chain(GetParam(), closure, 0);
    RandomPair pair(m, 5);
    auto& [relative, absolute, random, q, v, qa, va] = pair;
    const double s = 1e-2;
    if (closure != Closure::spring_between) {
      const Tangent t = compare(relative, q, s, 10.0);
      EXPECT_LT(t.difference, 1e-9 * (t.mass + s * t.stiffness)) << static_cast<int>(closure);
      if (closure != Closure::none) {
        EXPECT_GT(s * t.stiffness, 1e-4 * t.mass);
      }
    }
    const Tangent t = compare(absolute, qa, s, 10.0);
    EXPECT_LT(t.difference, 1e-9 * (t.mass + s * t.stiffness)) << static_cast<int>(closure);
  }
}

TEST_P(TangentOfJoint, AbsoluteConstraintsOnFlexibleBodiesAreExactToo) {
  for (const Closure closure : closures) {
    if (closure == Closure::spring_to_ground || closure == Closure::spring_between) continue;
    const Model m = build_chain(GetParam(), closure, 2);
    RandomPair pair(m, 5);
    auto& [relative, absolute, random, q, v, qa, va] = pair;
    const Tangent t = compare(absolute, qa, 1e-2, 10.0);
    EXPECT_LT(t.difference, 1e-8 * (t.mass + t.stiffness)) << static_cast<int>(closure);
  }
}

TEST_P(TangentOfJoint, TurningOfTheJointsOfABodyWithoutMassIsInIt) {
  const Model m = build_chain(GetParam(), Closure::none, 0, true);
  RandomPair pair(m, 5);
  auto& [relative, absolute, random, q, v, qa, va] = pair;
  const double s = 1e-2;
  const Tangent t = compare(absolute, qa, s, 10.0);
  EXPECT_LT(t.difference, 1e-9 * (t.mass + s * t.stiffness));
}

// What is left out is small beside the mass at a step of a millisecond.
TEST_P(TangentOfJoint, IsCloseForFlexibleBodiesAtSmallSteps) {
  for (const Closure closure : closures) {
    const Model m = build_chain(GetParam(), closure, 3);
    RandomPair pair(m, 6);
    auto& [relative, absolute, random, q, v, qa, va] = pair;
    const double s = 2.5e-7, alpha = 10.0 / s;
    const Tangent r = compare(relative, q, s, alpha);
    EXPECT_LT(r.symmetry, 1e-13);
    EXPECT_LT(r.difference, 1e-5 * r.mass) << static_cast<int>(closure);
    const Tangent a = compare(absolute, qa, s, alpha);
    EXPECT_LT(a.symmetry, 1e-12);
    EXPECT_LT(a.difference, 1e-5 * a.mass) << static_cast<int>(closure);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryJoint, TangentOfJoint, ::testing::ValuesIn(all_joint_types),
                         [](const auto& c) { return std::string(joint_type_name(c.param)); });

/// Links that hang one from the other by ball joints in turn with hinges.
Model build_links(int links, int modes) {
  RandomSystem s(9);
  std::string previous = ground_name;
  for (int k = 0; k < links; ++k) {
    const std::string name = node_name(k);
    s.add_body(name, modes);
    s.add_joint(name, k % 2 ? JointType::spherical : JointType::revolute, previous, 1, name, 0);
    previous = name;
  }
  return build_model(s.d);
}

TEST(TangentOfChain, FortyLinksSolveAsTheDenseFactorisation) {
  for (const int modes : {0, 2}) {
    const Model m = build_links(40, modes);
    RelativeFormulation f(m, InertiaMethod::preprocessing);
    const int n = f.velocities();
    Random random(8);
    VecX q, v;
    random_configuration(f, random, q, v);
    evaluate_at(f, 0.0, q, v);
    f.dynamics();
    VecX zero(n), column(n);
    f.residual(VecX::Zero(n), VecX(), 0.0, zero);
    MatX M(n, n);
    for (int j = 0; j < n; ++j) {
      f.residual(VecX::Unit(n, j), VecX(), 0.0, column);
      M.col(j) = column - zero;
    }
    // d'Alembert: the accelerations of the O(n) recursion satisfy the equations of motion.
    VecX a = -zero;
    ASSERT_EQ(f.factorize(1.0, 0.0, 1e-30, 0.0), -1);
    f.solve(a);
    f.residual(a, VecX(), 0.0, column);
    EXPECT_LT(largest(column), 1e-10 * largest(zero)) << modes;
    const VecX dense = ldlt_solve(M, -zero);
    EXPECT_LT((a - dense).norm(), 1e-9 * dense.norm()) << modes;
  }
}

// Every link is a cluster of its own: four times the links are four times the work, but for the
// first link, which hangs from the ground. A dense factorisation would need 64 times the work.
TEST(TangentOfChain, WorkGrowsInProportionToTheLinks) {
  for (const int modes : {0, 2}) {
    const auto work = [&](int links) {
      const Model model = build_links(links, modes);
      TreeKinematics tree(model);
      std::vector<Cluster> clusters = find_clusters(tree, {});
      number_coordinates(tree, clusters);
      double sum = 0.0;  // multiplications of the elimination, without the assembly of the fronts
      for (const Cluster& c : clusters)
        for (int j = 0; j < c.size; ++j) sum += 0.5 * (c.n - j) * (c.n - j + 1);
      return sum;
    };
    EXPECT_GT(work(40), 0.0);
    EXPECT_NEAR(work(160) / work(40), 4.0, 0.1) << modes;
  }
}

}  // namespace
}  // namespace floatframe::test

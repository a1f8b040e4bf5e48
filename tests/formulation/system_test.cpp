// Random systems of flexible and rigid bodies with every joint type: markers against finite
// differences, the two formulations against each other, energies and the power balance.
#include <gtest/gtest.h>

#include "floatframe/math/dense.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

/// A serial chain through all joint types with a branch from its middle; flexible and rigid bodies
/// in turn. Every second joint and the free one are reversed if asked.
RandomSystem random_tree(unsigned seed, bool reversed) {
  RandomSystem s(seed);
  std::string previous = ground_name;
  int k = 0;
  for (const JointType type : all_joint_types) {
    std::string name("body_");
    name += joint_type_name(type);
    s.add_body(name, k % 3 == 1 ? 0 : 2 + k % 2);
    if (reversed && (k % 2 == 1 || type == JointType::free))
      s.add_joint(joint_type_name(type), type, name, 0, previous, 1);
    else
      s.add_joint(joint_type_name(type), type, previous, 1, name, 0);
    previous = name;
    ++k;
  }
  s.add_body("branch", 2);
  s.add_joint("branch_ball", JointType::spherical, "body_prismatic", 3, "branch", 2);
  s.add_body("twig", 0);
  s.add_joint("twig_hinge", JointType::revolute, "branch", 4, "twig", 0);
  return s;
}

void add_springs(RandomSystem& s) {
  const auto add = [&](const std::string& name, auto kind) {
    ElementDescription f;
    f.name = name;
    f.kind = std::move(kind);
    s.d.forces.push_back(std::move(f));
  };
  SpringDamper spring;
  spring.a = s.at("body_weld", 2);
  spring.b = s.at("branch", 1);
  spring.spring = PiecewisePolynomial::linear(30.0, 0.5);
  add("between", spring);
  spring.a = s.at(ground_name, 0);
  spring.b = s.at("body_universal", 3);
  add("to_ground", spring);
  GuidedSpring guided;
  guided.reference = s.at("body_revolute", 2);
  guided.tip = s.at("body_cylindrical", 4);
  guided.axis = s.random.vec3();
  guided.spring = PiecewisePolynomial::polynomial({0.0, 10.0, 0.0, 3.0});
  add("guided", guided);
  JointSpring joint;
  joint.spring = PiecewisePolynomial::polynomial({0.3, 5.0});
  joint.joint = "revolute";
  add("at_hinge", joint);
  joint.joint = "prismatic";
  add("at_slide", joint);
}

/// Every marker of a flexible body away from its node and turning with it, as no description of
/// today makes them: the markers promise it.
void offset_markers(Model& m, Random& random) {
  for (Marker& k : m.markers)
    if (k.body >= 0 && k.node >= 0) {
      k.X_NM.p = random.vec3(0.2);
      k.rotates = true;
    }
}

class TwoFormulations : public ::testing::TestWithParam<std::tuple<unsigned, bool>> {
 protected:
  static Model build(bool with_loops) {
    RandomSystem s = random_tree(std::get<0>(GetParam()), std::get<1>(GetParam()));
    add_springs(s);
    if (with_loops) {
      s.add_joint("loop_ball", JointType::spherical, "twig", 1, "body_free", 3).cut = true;
      s.add_joint("loop_universal", JointType::universal, ground_name, 1, "body_spherical", 2).cut =
          true;
      s.d.rods = {make_rod("rod", s.at("body_weld", 4), s.at("twig", 4))};
    }
    Model m = build_model(s.d);
    Random random(3);
    offset_markers(m, random);
    return m;
  }
};

template <class F>
void expect_marker_rates(F& f, const VecX& q, const VecX& v, const VecX& a) {
  const double dt = 1e-5;
  const auto markers = static_cast<int>(f.model().markers.size());
  std::vector<MarkerState> minus, plus;
  std::vector<Vec3> r_minus, r_plus;
  VecX q1 = q;
  for (const double h : {-dt, dt}) {
    f.retract(q, h * v + 0.5 * h * h * a, q1);
    evaluate_at(f, 0.0, q1, v + h * a);
    for (int k = 0; k < markers; ++k) {
      (h < 0 ? minus : plus).push_back(f.marker(k));
      (h < 0 ? r_minus : r_plus).push_back(f.motion().place(k));
    }
  }
  evaluate_at(f, 0.0, q, v);
  f.set_accelerations(a);
  const SystemMotion& motion = f.motion({.accelerations = true});
  for (int k = 0; k < markers; ++k) {
    const std::size_t i = k;
    const MarkerState& s = f.marker(k);
    EXPECT_LT((s.v - (r_plus[i] - r_minus[i]) / (2 * dt)).norm(), 1e-7 * (1 + s.v.norm())) << k;
    const Mat3 Rdot = (plus[i].R - minus[i].R) / (2 * dt);
    EXPECT_LT(largest(skew(s.w) * s.R - Rdot), 1e-7 * (1 + s.w.norm())) << k;
    const Vec3& acceleration = motion.marker_accelerations[i];
    EXPECT_LT((acceleration - (plus[i].v - minus[i].v) / (2 * dt)).norm(),
              1e-6 * (1 + acceleration.norm()))
        << k;
  }
}

TEST_P(TwoFormulations, MarkerRatesAgainstFiniteDifferences) {
  const Model m = build(false);
  RelativeFormulation relative(m, InertiaMethod::preprocessing);
  AbsoluteFormulation from(m, InertiaMethod::preprocessing);
  AbsoluteFormulation absolute(m, InertiaMethod::preprocessing);
  Random random(11);
  VecX q, v, qa, va;
  random_configuration(relative, random, q, v);
  const VecX a = random.vector(relative.velocities(), 3.0);
  from.start_from(relative, q, v, qa, va);
  const VecX aa = absolute_accelerations(relative, from, q, v, a);
  expect_marker_rates(relative, q, v, a);
  expect_marker_rates(absolute, qa, va, aa);
  // The same markers in both.
  evaluate_at(relative, 0.0, q, v);
  evaluate_at(absolute, 0.0, qa, va);
  relative.set_accelerations(a);
  absolute.set_accelerations(aa);
  const SystemMotion& in_tree = relative.motion({.accelerations = true});
  const SystemMotion& in_axes = absolute.motion({.accelerations = true});
  for (int k = 0; k < static_cast<int>(m.markers.size()); ++k) {
    const MarkerState &r = relative.marker(k), &s = absolute.marker(k);
    EXPECT_LT((in_tree.place(k) - in_axes.place(k)).norm(), 1e-13) << k;
    EXPECT_LT(largest(r.R - s.R), 1e-13) << k;
    EXPECT_LT((r.v - s.v).norm(), 1e-12 * (1 + s.v.norm())) << k;
    EXPECT_LT((r.w - s.w).norm(), 1e-12 * (1 + s.w.norm())) << k;
    EXPECT_LT((in_tree.marker_accelerations[k] - in_axes.marker_accelerations[k]).norm(), 1e-6)
        << k;
  }
}

template <class F>
MatX mass_columns(F& f) {
  const int n = f.velocities();
  VecX zero(n), column(n);
  const VecX lambda = VecX::Zero(f.constraints());
  f.residual(VecX::Zero(n), lambda, 0.0, zero);
  MatX M(n, n);
  for (int j = 0; j < n; ++j) {
    f.residual(VecX::Unit(n, j), lambda, 0.0, column);
    M.col(j) = column - zero;
  }
  return M;
}

TEST_P(TwoFormulations, MassAndResidualAgree) {
  for (const InertiaMethod method : {InertiaMethod::preprocessing, InertiaMethod::projection}) {
    const Model m = build(true);
    RelativeFormulation relative(m, method);
    AbsoluteFormulation absolute(m, method);
    Random random(12);
    VecX q, v, qa, va;
    random_configuration(relative, random, q, v);
    const VecX a = random.vector(relative.velocities(), 3.0);
    absolute.start_from(relative, q, v, qa, va);
    const VecX aa = absolute_accelerations(relative, absolute, q, v, a);
    const MatX T = velocity_map(relative, absolute, q);
    EXPECT_LT(largest(T * v - va), 1e-12);

    evaluate_at(relative, 0.0, q, v);
    relative.dynamics();
    evaluate_at(absolute, 0.0, qa, va);
    absolute.dynamics();
    const MatX M = mass_columns(relative), M_abs = mass_columns(absolute);
    const double scale = largest(M);
    EXPECT_LT(largest(M - M.transpose()), 1e-13 * scale);
    EXPECT_LT(largest(M_abs - absolute.mass_matrix()), 1e-12 * scale);
    EXPECT_LT(largest(M - T.transpose() * M_abs * T), 1e-13 * scale);
    EXPECT_GT(symmetric_eigenvalues(M).minCoeff(), 0.0);

    // Multipliers: those of the loops and the rod are the same numbers in both; the others of the
    // absolute formulation do no work on the tree's motion.
    ASSERT_GT(relative.constraints(), 0);
    const VecX lambda = random.vector(relative.constraints(), 5.0);
    VecX lambda_abs = random.vector(absolute.constraints(), 5.0);
    for (std::size_t k = 0; k < relative.constraint_set().parts().size(); ++k) {
      const ConstraintPart& p = relative.constraint_set().parts()[k];
      for (std::size_t l = 0; l < absolute.constraint_set().parts().size(); ++l) {
        const ConstraintPart& o = absolute.constraint_set().parts()[l];
        if (o.owner.joint == p.owner.joint && o.owner.element == p.owner.element &&
            o.type == p.type && o.e_a == p.e_a && o.n_b == p.n_b)
          lambda_abs.segment(absolute.constraint_set().offset(l), o.rows()) =
              lambda.segment(relative.constraint_set().offset(k), p.rows());
      }
    }
    const double alpha = 7.0;
    VecX r(relative.velocities()), ra(absolute.velocities());
    relative.residual(a, lambda, alpha, r);
    absolute.residual(aa, lambda_abs, alpha, ra);
    EXPECT_LT(largest(r - T.transpose() * ra), 1e-6 * largest(r));
  }
}

TEST_P(TwoFormulations, EnergiesAgree) {
  const Model m = build(false);
  RandomPair pair(m, 13);
  auto& [relative, absolute, random, q, v, qa, va] = pair;
  evaluate_at(relative, 0.0, q, v);
  evaluate_at(absolute, 0.0, qa, va);
  relative.dynamics();
  absolute.dynamics();
  const auto near = [](double x, double y) { EXPECT_NEAR(x, y, 1e-12 * (1.0 + std::abs(y))); };
  near(absolute.kinetic_energy(va), relative.kinetic_energy(v));
  near(absolute.gravity_energy(), relative.gravity_energy());
  near(elastic_energy(absolute.motion()), elastic_energy(relative.motion()));
  evaluate_at(relative, 0.0, q, v);
  relative.dynamics();
  near(0.5 * v.dot(mass_columns(relative) * v), relative.kinetic_energy(v));
  for (std::size_t k = 0; k < m.elements.size(); ++k) {
    const int i = static_cast<int>(k);
    near(absolute.effort(i).energy, relative.effort(i).energy);
    near(absolute.effort(i).force, relative.effort(i).force);
  }
}

// With the accelerations of the equations of motion nothing is gained or lost:
// d/dt (kinetic + gravity + elastic + springs) = 0.
TEST_P(TwoFormulations, ConservativeTreeKeepsItsEnergy) {
  const Model m = build(false);
  RelativeFormulation f(m, InertiaMethod::preprocessing);
  Random random(14);
  VecX q, v;
  random_configuration(f, random, q, v);
  const int n = f.velocities();
  evaluate_at(f, 0.0, q, v);
  f.dynamics();
  VecX r(n);
  f.residual(VecX::Zero(n), VecX(), 0.0, r);
  const VecX a = ldlt_solve(mass_columns(f), -r);
  const auto energy = [&](double h) {
    VecX q1 = q;
    f.retract(q, h * v + 0.5 * h * h * a, q1);
    evaluate_at(f, 0.0, q1, v + h * a);
    f.forces();
    double e = f.kinetic_energy(v + h * a) + f.gravity_energy() + elastic_energy(f.motion());
    for (std::size_t k = 0; k < m.elements.size(); ++k) e += f.effort(static_cast<int>(k)).energy;
    return e;
  };
  const double dt = 1e-4;
  const double rate = (8 * (energy(dt) - energy(-dt)) - (energy(2 * dt) - energy(-2 * dt))) / 12;
  // Fourth-order difference along a path that is exact to second order; compared with the power of
  // the accelerations, which is of the size of the terms that must cancel.
  evaluate_at(f, 0.0, q, v);
  f.dynamics();
  const double power = std::abs(v.cwiseAbs().dot(mass_columns(f).cwiseAbs() * a.cwiseAbs()));
  EXPECT_LT(std::abs(rate / dt), 1e-5 * power);
}

// Start values go in and come out by `joint_position` and `joint_velocity`, whichever way round
// the tree goes through the joint.
TEST_P(TwoFormulations, StartValuesAreReadBackFromTheMarkers) {
  RandomSystem s = random_tree(std::get<0>(GetParam()), std::get<1>(GetParam()));
  for (JointDescription& j : s.d.joints)
    for (int k = 0; k < joint_velocities(j.type); ++k) {
      j.position.push_back(s.random(-0.9, 0.9));
      j.velocity.push_back(s.random(-2.0, 2.0));
    }
  const Model m = build_model(s.d);
  RelativeFormulation f(m, InertiaMethod::preprocessing);
  VecX q, v;
  f.start(q, v);
  evaluate_at(f, 0.0, q, v);
  for (const Joint& j : m.joints)
    for (int k = 0; k < static_cast<int>(j.position.size()); ++k) {
      const std::size_t i = k;
      EXPECT_NEAR(joint_position(j, f.marker(j.frame_F), f.marker(j.frame_M), k, 0.0),
                  j.position[i], 1e-13)
          << j.name << ' ' << k;
      EXPECT_NEAR(joint_velocity(j, f.marker(j.frame_F), f.marker(j.frame_M), k), j.velocity[i],
                  1e-12)
          << j.name << ' ' << k;
    }
}

INSTANTIATE_TEST_SUITE_P(RandomTrees, TwoFormulations,
                         ::testing::Combine(::testing::Values(1u, 2u, 3u), ::testing::Bool()));

}  // namespace
}  // namespace floatframe::test

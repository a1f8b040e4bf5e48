// Rows of several parts: couplings of joints of the tree, turned round and cut, in both
// formulations. Values against coordinates over several turns; gradients, rates and accelerations
// against differences; tangents against dense matrices.
#include <gtest/gtest.h>

#include "floatframe/model/joint_measure.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

/// Two chains from the ground, a - b - c and d, with a sliding joint between them that is cut.
ModelDescription chains(int modes) {
  RandomSystem s(17);
  s.add_body("a", modes);
  s.add_body("b", 0);
  s.add_body("c", modes);
  s.add_body("d", 0);
  s.add_joint("hinge", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("nut", JointType::cylindrical, "b", 1, "a", 1);
  s.add_joint("plane", JointType::planar, "b", 2, "c", 2);
  s.add_joint("slide", JointType::prismatic, ground_name, 1, "d", 0);
  s.add_joint("loop", JointType::prismatic, "c", 3, "d", 1).cut = true;
  Coupling first{{{"hinge", -1, 1.3}, {"nut", 0, 0.4}, {"nut", 1, -0.7}, {"plane", 1, 0.9}}, {}};
  Coupling second{{{"slide", 0, -1.0}, {"plane", 2, 1.0}, {"loop", -1, 2.0}}, TimeFunction()};
  second.value->sines = {{.amplitude = 0.3, .frequency = 0.5}};
  s.d.couplings = {{"first", first, {}}, {"second", second, {}}};
  return s.d;
}

class CouplingRows : public ::testing::TestWithParam<int> {
 protected:
  static constexpr double time = 0.3;
  Model model_ = build_model(chains(GetParam()));
  RandomPair pair_{model_, 5};

  template <class Test>
  void in_both(const Test& test) {
    auto& [relative, absolute, random, q, v, qa, va] = pair_;
    test(relative, q, v);
    test(absolute, qa, va);
  }
  /// The rows of the couplings, which are the last.
  template <class F>
  static std::vector<Eigen::Index> rows(const F& f) {
    return {f.constraints() - 2, f.constraints() - 1};
  }
};

TEST_P(CouplingRows, AreTheSumOfTheCoordinatesOverTurns) {
  auto& [relative, absolute, random, q, v, qa, va] = pair_;
  const TreeBody& a = relative.tree().body(relative.tree().body_of_joint(0));
  q[a.iq] += 20.0;
  absolute.start_from(relative, q, v, qa, va);
  in_both([&](auto& f, const VecX& at, const VecX& rate) {
    for (int turn = 0; turn < 2; ++turn) {  // turns that were counted stay counted
      evaluate_at(f, time, at, rate);
      const SystemMotion& motion = f.motion();
      for (std::size_t k = 0; k < model_.elements.size(); ++k) {
        const Element& e = model_.elements[k];
        const std::vector<CoordinateTerm>& terms = std::get<Coupling>(*e.keys).terms;
        double sum = -evaluate(e.signals[0].function, time).f;
        for (std::size_t i = 0; i < terms.size(); ++i) {
          const Joint& joint = model_.joints[e.coordinates[i].joint];
          sum += terms[i].factor *
                 joint_position(joint, motion.marker(joint.frame_F), motion.marker(joint.frame_M),
                                e.coordinates[i].component, joint.name == "hinge" ? q[a.iq] : 0.0);
        }
        const std::size_t part = f.constraint_set().part_of_row(static_cast<int>(rows(f)[k]));
        EXPECT_FALSE(f.constraint_set().continues(part));
        EXPECT_EQ(f.constraint_set().owner_of_row(static_cast<int>(rows(f)[k])),
                  "coupling '" + e.name + "'");
        EXPECT_NEAR(f.constraint_values()[rows(f)[k]], f.constraint_set().parts()[part].scale * sum,
                    1e-12);
      }
    }
  });
}

TEST_P(CouplingRows, RatesForcesAndIncrementsAreThoseOfTheJacobian) {
  in_both([&](auto& f, const VecX& q, const VecX& v) {
    evaluate_at(f, 0.0, q, v);
    const MatX J = f.constraint_jacobian();
    EXPECT_GT(J.row(rows(f)[0]).norm(), 0.1);
    VecX rates(f.constraints()), by_time = VecX::Zero(f.constraints());
    f.constraint_rates(rates);
    const Element& e = model_.elements[1];
    by_time[rows(f)[1]] = evaluate(e.signals[0].function, 0.0).df;
    const ConstraintPart& p =
        f.constraint_set().parts()[f.constraint_set().part_of_row(static_cast<int>(rows(f)[1]))];
    EXPECT_LT(largest(rates + p.scale * by_time - J * v), 1e-12);
    const VecX w = Random(9).vector(f.constraints());
    VecX push(f.velocities()), moved(f.constraints());
    f.constraint_forces(w, push);
    EXPECT_LT(largest(push - J.transpose() * w), 1e-12);
    const VecX x = Random(10).vector(f.velocities());
    f.constraint_increments(x, moved);
    EXPECT_LT(largest(moved - J * x), 1e-12);
  });
}

TEST_P(CouplingRows, GradientsAndAccelerationsAgainstDifferences) {
  auto& [relative, absolute, random, q, v, qa, va] = pair_;
  const VecX a = random.vector(relative.velocities(), 3.0);
  const VecX aa = absolute_accelerations(relative, absolute, q, v, a);
  in_both([&](auto& f, const VecX& at, const VecX& rate) {
    constexpr double h = 1e-5;
    const bool tree = f.coordinates() == Coordinates::relative;
    const VecX& acceleration = tree ? a : aa;
    VecX plus(f.constraints()), minus(f.constraints()), exact(f.constraints()), moved = at;
    const auto go = [&](double dt, bool values, VecX& out) {
      f.retract(at, dt * rate + 0.5 * dt * dt * acceleration, moved);
      evaluate_at(f, time + dt, moved, rate + dt * acceleration);
      values ? void(out = f.constraint_values()) : f.constraint_rates(out);
    };
    for (const bool values : {true, false}) {
      go(h, values, plus);
      go(-h, values, minus);
      evaluate_at(f, time, at, rate);
      values ? f.constraint_rates(exact) : f.constraint_accelerations(acceleration, exact);
      for (const Eigen::Index i : rows(f))
        EXPECT_NEAR(exact[i], (plus[i] - minus[i]) / (2.0 * h), 1e-6 * (1.0 + std::abs(exact[i])));
    }
  });
}

TEST_P(CouplingRows, TangentTiesAllBodies) {
  in_both([&](auto& f, const VecX& q, const VecX&) {
    constexpr double penalty = 7.0;
    const VecX zero = VecX::Zero(f.velocities()), none = VecX::Zero(f.constraints());
    evaluate_at(f, time, q, zero);
    f.dynamics();
    VecX rest(f.velocities()), inertia(f.velocities()), x = Random(4).vector(f.velocities());
    const VecX b = x;
    f.residual(zero, none, 0.0, rest);
    ASSERT_EQ(f.factorize_metric(0.0, penalty, 1), -1);
    f.solve(x, 1);
    f.residual(x, none, 0.0, inertia);
    const MatX J = f.constraint_jacobian(), Z = free_directions(f);
    VecX held = J * x;
    if constexpr (!std::is_same_v<std::remove_reference_t<decltype(f)>, RelativeFormulation>) {
      int own = 0;
      for (const AbsoluteBody& body : f.kinematics().bodies()) own += body.rows();
      EXPECT_LT(largest(held.head(own)), 1e-11);
      held.head(own).setZero();
    }
    EXPECT_LT(largest(Z.transpose() * (inertia - rest + penalty * J.transpose() * held - b)),
              1e-10 * (1.0 + largest(b)));
  });
}

INSTANTIATE_TEST_SUITE_P(RigidAndFlexible, CouplingRows, ::testing::Values(0, 3),
                         [](const auto& c) { return c.param == 0 ? "rigid" : "flexible"; });

// From the root of a chain to its end and back: every body on the way is in one cluster.
TEST(CouplingClusters, HoldAllBodiesBetweenTheJoints) {
  RandomSystem s(3);
  std::string previous = ground_name;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    s.add_body(name, 0);
    s.add_joint(name, JointType::revolute, previous, 0, name, 0);
    previous = name;
  }
  s.d.couplings = {{"ends", Coupling{{{"b"}, {"d", -1, 2.0}}, {}}, {}}};
  const Model model = build_model(s.d);
  const TreeKinematics tree(model);
  const std::vector<std::vector<int>> ties{model.elements[0].markers};
  std::vector<std::size_t> sizes;
  for (const Cluster& c : find_clusters(tree, ties)) sizes.push_back(c.bodies.size());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 3, 1}));  // a; b, c, d; e
}

}  // namespace
}  // namespace floatframe::test

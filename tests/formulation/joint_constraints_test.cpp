// Constraint parts of every joint type, in both formulations: gradients, rates and accelerations
// against finite differences, and the motion of a tree joint against the constraints of the same
// joint. A joint type is covered by being in `all_joint_types`.
#include <gtest/gtest.h>

#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

enum class Place { tree, cut, reversed };

struct Case {
  JointType type;
  Place place;
  bool flexible;
  std::string name() const {
    const char* places[] = {"tree", "cut", "reversed"};
    return std::string(joint_type_name(type)) + "_" + places[static_cast<int>(place)] + "_" +
           (flexible ? "flexible" : "rigid");
  }
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const JointType type : all_joint_types)
    for (const Place place : {Place::tree, Place::cut, Place::reversed})
      for (const bool flexible : {true, false}) cases.push_back({type, place, flexible});
  return cases;
}

/// ground - revolute - near - (joint under test) - far. A cut weld and a rod from `far` to the
/// ground see all of its motion; they need not be closed.
Model build_case(const Case& c) {
  RandomSystem s(100 + static_cast<unsigned>(c.type));
  const int modes = c.flexible ? 3 : 0;
  s.add_body("near", modes);
  s.add_body("far", modes == 0 ? 0 : modes - 1);
  s.add_joint("hinge", JointType::revolute, ground_name, 0, "near", 0);
  const bool reversed = c.place == Place::reversed;
  s.add_joint("tested", c.type, reversed ? "far" : "near", 1, reversed ? "near" : "far", 2).cut =
      c.place == Place::cut;
  s.add_joint("probe", JointType::weld, ground_name, 0, "far", 3).cut = true;
  s.d.rods = {make_rod("rod", s.at("near", 4), s.at("far", 5), 0.8)};
  return build_model(s.d);
}

class JointConstraints : public ::testing::TestWithParam<Case> {
 protected:
  JointConstraints()
      : model_(build_case(GetParam())),
        relative_(model_, InertiaMethod::preprocessing),
        absolute_(model_, InertiaMethod::preprocessing) {
    random_configuration(relative_, random_, q_, v_);
    a_ = random_.vector(relative_.velocities(), 3.0);
    absolute_.start_from(relative_, q_, v_, qa_, va_);
    aa_ = absolute_accelerations(relative_, absolute_, q_, v_, a_);
  }

  /// Directions in which the absolute coordinates may move: every body freely (its axes stay
  /// orthonormal) and every outer point on its own. Columns.
  MatX absolute_directions() {
    std::vector<VecX> columns;
    const int n = absolute_.velocities();
    int offset = 0;
    for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        columns.push_back(VecX::Unit(n, offset + k));
        VecX turn = VecX::Zero(n);
        for (int c = 0; c < 3; ++c)
          turn.segment<3>(offset + 3 + 3 * c) =
              Vec3::Unit(k).cross(Vec3(qa_.segment<3>(offset + 3 + 3 * c)));
        columns.push_back(turn);
      }
      offset += 12;
      const std::string own = "body '" + model_.bodies[i].name + "'";
      while (offset < n && absolute_.coordinate_owner(offset).find(own) != std::string::npos)
        columns.push_back(VecX::Unit(n, offset++));
    }
    MatX d(n, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
      d.col(static_cast<Eigen::Index>(k)) = columns[k];
    return d;
  }

  template <class F>
  void expect_gradient(F& f, const VecX& q, const VecX& v, const MatX& directions) {
    evaluate_at(f, 0.0, q, v);
    const MatX J = f.constraint_jacobian() * directions;
    MatX numeric(J.rows(), J.cols());
    VecX q1 = q;
    const double h = 1e-5;
    for (Eigen::Index k = 0; k < directions.cols(); ++k) {
      f.retract(q, h * directions.col(k), q1);
      evaluate_at(f, 0.0, q1, v);
      const VecX plus = f.constraint_values();
      f.retract(q, -h * directions.col(k), q1);
      evaluate_at(f, 0.0, q1, v);
      numeric.col(k) = (plus - f.constraint_values()) / (2.0 * h);
    }
    EXPECT_LT(largest(J - numeric), 1e-8);
    EXPECT_GT(largest(J), 0.1);
  }

  template <class F>
  void expect_rates(F& f, const VecX& q, const VecX& v) {
    evaluate_at(f, 0.0, q, v);
    VecX rates(f.constraints());
    f.constraint_rates(rates);
    EXPECT_LT(largest(rates - f.constraint_jacobian() * v), 1e-12);
  }

  template <class F>
  void expect_forces(F& f, const VecX& q, const VecX& v) {
    evaluate_at(f, 0.0, q, v);
    const VecX w = Random(9).vector(f.constraints());
    VecX push(f.velocities());
    f.constraint_forces(w, push);
    EXPECT_LT(largest(push - f.constraint_jacobian().transpose() * w), 1e-12);
  }

  template <class F>
  void expect_accelerations(F& f, const VecX& q, const VecX& v, const VecX& a) {
    const double dt = 1e-5;
    VecX q1 = q, plus(f.constraints()), minus(f.constraints()), exact(f.constraints());
    f.retract(q, dt * v + 0.5 * dt * dt * a, q1);
    evaluate_at(f, 0.0, q1, v + dt * a);
    f.constraint_rates(plus);
    f.retract(q, -dt * v + 0.5 * dt * dt * a, q1);
    evaluate_at(f, 0.0, q1, v - dt * a);
    f.constraint_rates(minus);
    evaluate_at(f, 0.0, q, v);
    f.constraint_accelerations(a, exact);
    EXPECT_LT(largest(exact - (plus - minus) / (2.0 * dt)), 1e-6 * (1.0 + largest(exact)));
  }

  Random random_{77};
  Model model_;
  RelativeFormulation relative_;
  AbsoluteFormulation absolute_;
  VecX q_, v_, a_, qa_, va_, aa_;
};

TEST_P(JointConstraints, TreeIsThatOfTheCase) {
  const Topology& t = relative_.tree().topology();
  const bool is_cut = std::find(t.cut_joints.begin(), t.cut_joints.end(), 1) != t.cut_joints.end();
  const bool constrains = GetParam().type != JointType::free;
  EXPECT_EQ(is_cut, GetParam().place == Place::cut && constrains);
  for (const Topology::Link& link : t.links)
    if (link.joint == 1) {
      EXPECT_EQ(link.reversed, GetParam().place == Place::reversed);
    }
}

TEST_P(JointConstraints, GradientsAgainstFiniteDifferences) {
  const int n = relative_.velocities();
  expect_gradient(relative_, q_, v_, MatX::Identity(n, n));
  expect_gradient(absolute_, qa_, va_, absolute_directions());
}

TEST_P(JointConstraints, RatesAreGradientTimesVelocity) {
  expect_rates(relative_, q_, v_);
  expect_rates(absolute_, qa_, va_);
}

TEST_P(JointConstraints, ForcesAreTransposedGradientTimesMultipliers) {
  expect_forces(relative_, q_, v_);
  expect_forces(absolute_, qa_, va_);
}

TEST_P(JointConstraints, AccelerationsAgainstFiniteDifferences) {
  expect_accelerations(relative_, q_, v_, a_);
  expect_accelerations(absolute_, qa_, va_, aa_);
}

// A joint in the tree moves along its motion subspace; the absolute formulation's constraints of
// the same joint (and its bodies) must not feel that: Phi = 0, Phi_q v = 0, Phi_q a = gamma.
TEST_P(JointConstraints, JacobianAnnihilatesTheMotionSubspace) {
  evaluate_at(absolute_, 0.0, qa_, va_);
  VecX rates(absolute_.constraints()), accelerations(absolute_.constraints());
  absolute_.constraint_rates(rates);
  absolute_.constraint_accelerations(aa_, accelerations);
  int checked = 0;
  for (int i = 0; i < absolute_.constraints(); ++i) {
    std::size_t k = absolute_.constraint_set().parts().size();
    while (k > 0 && absolute_.constraint_set().offset(k - 1) > i) --k;
    if (k > 0) {
      const ConstraintOwner& owner = absolute_.constraint_set().parts()[k - 1].owner;
      const bool in_tree = owner.joint >= 0 && relative_.tree().body_of_joint(owner.joint) >= 0;
      if (!in_tree) continue;
    }
    ++checked;
    EXPECT_LT(std::abs(absolute_.constraint_values()[i]), 1e-13) << "row " << i;
    EXPECT_LT(std::abs(rates[i]), 1e-12) << "row " << i;
    EXPECT_LT(std::abs(accelerations[i]), 1e-7) << "row " << i;
  }
  EXPECT_GE(checked, 12 + 5);
}

INSTANTIATE_TEST_SUITE_P(EveryJoint, JointConstraints, ::testing::ValuesIn(all_cases()),
                         [](const auto& c) { return c.param.name(); });

}  // namespace
}  // namespace floatframe::test

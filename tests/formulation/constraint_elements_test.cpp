// Constraints between markers of any bodies, in trees and loops, rigid and flexible, in both
// formulations: gradients, rates and accelerations against differences, what they push against
// their rows, and the same motion in absolute as in relative coordinates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <set>

#include "floatframe/model/element_kind.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

constexpr double time_of_rows = 0.3;

/// Along e1 and e2, from the place of the curve: a formula of each component.
void give_curve(const Vec3& e1, const Vec3& e2, const char* first, const char* second,
                const std::array<std::optional<SharedFormula>*, 3>& xyz) {
  for (int k = 0; k < 3; ++k)
    *xyz.at(k) =
        formula(fmt::format("({:.17g}) * ({}) + ({:.17g}) * ({})", e1[k], first, e2[k], second));
}

/// A body d that slides in a plane, with a circle that is far off a parabola of the ground.
CurveOnCurve touching_curves(RandomSystem& s) {
  s.add_body("d", 0);
  const Vec3 k = s.add_joint("plane", JointType::planar, ground_name, 0, "d", 0).axis.normalized();
  Vec3 e1, e2;
  orthonormal_complement(k, e1, e2);
  CurveOnCurve touch;
  touch.a = s.at(ground_name, 0);
  touch.b = s.at("d", 0);
  touch.axis = k;
  give_curve(e1, e2, "u", "12 + 0.02 * u^2", {&touch.x, &touch.y, &touch.z});
  touch.range = MatX{{-60.0, 60.0}};
  give_curve(e1, e2, "0.4 * cos(u)", "0.3 * sin(u)", {&touch.x_2, &touch.y_2, &touch.z_2});
  touch.range_2 = MatX{{0.0, 2.0 * std::numbers::pi}};
  touch.closed_2 = true;
  return touch;
}

/// A chain a - b from the ground, a free body c and d in a plane, with one constraint of each type.
ModelDescription held_chain(int modes) {
  RandomSystem s(23);
  s.add_body("a", modes);
  s.add_body("b", 0);
  s.add_body("c", modes);
  s.add_joint("root", JointType::spherical, ground_name, 0, "a", 0);
  s.add_joint("pin", JointType::universal, "a", 1, "b", 1);
  const auto held = [&](auto keys, const char* from, const char* to, int node) {
    keys.a = s.at(from, node);
    keys.b = s.at(to, node + 1);
    keys.axis = s.random.vec3();
    return keys;
  };
  Perpendicular square = held(Perpendicular(), "c", "a", 2);
  square.axis_2 = s.random.vec3();
  ConstantVelocity shafts = held(ConstantVelocity(), "a", "c", 3);
  shafts.axis_2 = shafts.axis + 0.3 * s.random.vec3();
  ConstantVelocity sliding = held(ConstantVelocity{{}, Vec3::UnitZ(), true}, "b", "c", 1);
  sliding.axis_2 = sliding.axis;
  PointOnCurve groove;
  groove.a = s.at(ground_name, 0);
  groove.b = s.at("c", 3);
  give_curve(Vec3::UnitX(), Vec3::UnitY(), "u", "6 + 0.05 * u^2",
             {&groove.x, &groove.y, &groove.z});
  groove.range = MatX{{-30.0, 30.0}};
  SlideAlong path;  // of a rigid body; slide_rows_test.cpp has those of flexible ones
  path.a = s.at(ground_name, 0);
  path.b = s.at("c", 2);
  path.points = MatX{{-60.0, -6.0, 0.0}, {0.0, -7.0, 0.0}, {60.0, -6.0, 0.0}};
  s.d.constraints = {{"line", held(InLine(), "a", "c", 2), {}},
                     {"plane", held(InPlane(), "c", "b", 4), {}},
                     {"parallel", held(Parallel(), "b", ground_name, 0), {}},
                     {"square", square, {}},
                     {"shafts", shafts, {}},
                     {"sliding", sliding, {}},
                     {"groove", groove, {}},
                     {"path", path, {}},
                     {"touch", touching_curves(s), {}}};
  return s.d;
}

class ConstraintElements : public ::testing::TestWithParam<int> {
 protected:
  Model model_ = build_model(held_chain(GetParam()));
  RandomPair pair_{model_, 5};

  template <class Test>
  void in_both(const Test& test) {
    auto& [relative, absolute, random, q, v, qa, va] = pair_;
    test(relative, q, v);
    test(absolute, qa, va);
  }
  /// Rows of the constraints: the last ones.
  static constexpr int rows = 2 + 1 + 2 + 1 + 4 + 1 + 2 + 2 + 1;
};

TEST_P(ConstraintElements, AreOfEveryType) {
  std::set<ElementType> types;
  for (const Element& e : model_.elements) types.insert(e.type);
  for (const ElementType type : types_of(ElementList::constraints))
    EXPECT_TRUE(types.contains(type)) << element_type_name(type);
}

TEST_P(ConstraintElements, HaveTheRowsOfTheirTypes) {
  in_both([&](auto& f, const VecX&, const VecX&) {
    const int first = f.constraints() - rows;
    EXPECT_EQ(f.constraint_set().owner_of_row(first), "in_line 'line'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 2), "in_plane 'plane'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 4), "parallel 'parallel'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 5), "perpendicular 'square'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 9), "constant_velocity 'shafts'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 10), "constant_velocity 'sliding'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 11), "point_on_curve 'groove'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 13), "slide_along 'path'");
    EXPECT_EQ(f.constraint_set().owner_of_row(first + 15), "curve_on_curve 'touch'");
  });
}

TEST_P(ConstraintElements, AreThoseOfTheMarkersInBothFormulations) {
  auto& [relative, absolute, random, q, v, qa, va] = pair_;
  evaluate_at(relative, time_of_rows, q, v);
  evaluate_at(absolute, time_of_rows, qa, va);
  EXPECT_LT(
      largest(relative.constraint_values().tail(rows) - absolute.constraint_values().tail(rows)),
      1e-11);
  VecX a(relative.constraints()), b(absolute.constraints());
  relative.constraint_rates(a);
  absolute.constraint_rates(b);
  EXPECT_LT(largest(a.tail(rows) - b.tail(rows)), 1e-11);
}

TEST_P(ConstraintElements, RatesAndForcesAreThoseOfTheJacobian) {
  in_both([&](auto& f, const VecX& q, const VecX& v) {
    evaluate_at(f, 0.0, q, v);
    const MatX J = f.constraint_jacobian();
    for (int k = 1; k <= rows; ++k) EXPECT_GT(J.row(J.rows() - k).norm(), 0.01) << k;
    VecX rates(f.constraints());
    f.constraint_rates(rates);
    EXPECT_LT(largest(rates - J * v), 1e-11);
    const VecX w = Random(9).vector(f.constraints());
    VecX push(f.velocities());
    f.constraint_forces(w, push);
    EXPECT_LT(largest(push - J.transpose() * w), 1e-11);
  });
}

TEST_P(ConstraintElements, GradientsAndAccelerationsAgainstDifferences) {
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
      evaluate_at(f, time_of_rows + dt, moved, rate + dt * acceleration);
      values ? void(out = f.constraint_values()) : f.constraint_rates(out);
    };
    for (const bool values : {true, false}) {
      go(h, values, plus);
      go(-h, values, minus);
      evaluate_at(f, time_of_rows, at, rate);
      values ? f.constraint_rates(exact) : f.constraint_accelerations(acceleration, exact);
      for (Eigen::Index i = f.constraints() - rows; i < f.constraints(); ++i)
        EXPECT_NEAR(exact[i], (plus[i] - minus[i]) / (2.0 * h), 1e-6 * (1.0 + std::abs(exact[i])));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(RigidAndFlexible, ConstraintElements, ::testing::Values(0, 3),
                         [](const auto& c) { return c.param == 0 ? "rigid" : "flexible"; });

}  // namespace
}  // namespace floatframe::test

// Every registered kind of constraint part, and every joint of the list of joints as the parts it
// is made of: gradient, velocity term, time derivatives and curvature against differences.
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/cam_profile.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/curve_contact.hpp"
#include "floatframe/model/example_numbers.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/space_curve.hpp"
#include "support/exact_tangents.hpp"
#include "support/marker_motion.hpp"

namespace floatframe::test {
namespace {

constexpr int samples = 30;

#define FLOATFRAME_WORD(name) #name,
constexpr const char* part_words[] = {FLOATFRAME_CONSTRAINTS(FLOATFRAME_WORD)};
#undef FLOATFRAME_WORD

struct Case {
  std::string name;
  std::vector<ConstraintPart> parts;
};

const TimeFunction& motion() {
  static const TimeFunction f{PiecewisePolynomial::polynomial({0.1, 0.3, -0.2}), {{0.2, 1.5, 0.4}}};
  return f;
}

const CamProfile& lift() {
  static const CamProfile p = [] {
    CamProfile f;
    f.spline = true;
    f.pieces = PiecewisePolynomial::polynomial({0.1, 0.6, -0.2, 0.05});
    return f;
  }();
  return p;
}

/// A parabola in a plane, whose convex side the markers are on.
const SpaceCurve& curve() {
  static const SpaceCurve c = [] {
    PointOnCurve keys;
    keys.x = formula("u");
    keys.y = formula("3 + 0.05 * u^2");
    keys.z = formula("0.2 * u");
    keys.range = MatX{{-20.0, 20.0}};
    return SpaceCurve(keys);
  }();
  return c;
}

/// The parabola without its slope, and a circle around the other marker.
const CurveContact& curves() {
  static const CurveContact c = [] {
    PointOnCurve line, circle;
    line.x = formula("u");
    line.y = formula("3 + 0.05 * u^2");
    line.range = MatX{{-20.0, 20.0}};
    circle.x = formula("0.4 * cos(u)");
    circle.y = formula("0.3 * sin(u)");
    circle.range = MatX{{0.0, 2.0 * std::numbers::pi}};
    circle.closed = true;
    return CurveContact(SpaceCurve(line), SpaceCurve(circle), Vec3::UnitZ(), false);
  }();
  return c;
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  ExampleNumbers numbers(5);
  for (const ConstraintType type : constraint_types) {
    ConstraintPart p;
    p.type = type;
    p.a = 0;
    p.b = 1;
    p.e_a = numbers.direction();
    p.n_b = numbers.direction();
    p.c = numbers(-0.5, 0.5);
    p.scale = numbers(0.5, 1.5);
    p.motion = &motion();
    p.lift = &lift();
    p.curve = &curve();
    p.curves = &curves();
    all.push_back({std::string("part_") + part_words[index_of(type)], {p}});
  }
  for (const JointType type : joint_types) {
    Model model;
    model.bodies.resize(1);
    model.bodies[0].length = 0.7;
    Joint joint;
    joint.type = type;
    joint.child = 0;
    joint.frame_F = 0;
    joint.frame_M = 1;
    joint.axis_2 = numbers.direction();
    model.joints.push_back(joint);
    Case c{std::string("joint_") + joint_type_name(type), {}};
    append_joint_parts(model, 0, c.parts);
    int rows = 0;
    for (const ConstraintPart& p : c.parts) rows += p.rows();
    EXPECT_EQ(rows, 6 - joint_velocities(type)) << joint_type_name(type);
    all.push_back(c);
  }
  return all;
}

class Constraint : public ::testing::TestWithParam<Case> {
 protected:
  MarkerPair pair(const ConstraintPart& part) {
    MarkerPair p;
    p.a = numbers_.marker();
    const bool on_axis = constraint_kind(part.type).on_axis;
    p.b = on_axis ? numbers_.marker_on_axis(p.a) : numbers_.marker();
    return p;
  }
  static std::vector<ConstraintRow> rows(const ConstraintPart& part, const MarkerPair& p,
                                         double t = 0.3) {
    std::vector<ConstraintRow> r(part.rows());
    evaluate_constraint(part, p.a, p.b, t, r.data());
    return r;
  }
  static VecX values(const ConstraintPart& part, const MarkerPair& p, double t = 0.3) {
    const auto r = rows(part, p, t);
    VecX phi(part.rows());
    for (int k = 0; k < part.rows(); ++k) phi[k] = r[k].phi;
    return phi;
  }
  static Vec12 push(const ConstraintPart& part, const MarkerPair& p, const VecX& lambda) {
    const auto r = rows(part, p);
    Vec12 sum = Vec12::Zero();
    for (int k = 0; k < part.rows(); ++k) sum += lambda[k] * stacked(r[k].gradient);
    return sum;
  }
  ExampleNumbers numbers_{3};
};

TEST_P(Constraint, GradientAgainstFiniteDifferences) {
  double worst = 0.0;
  for (const ConstraintPart& part : GetParam().parts)
    for (int k = 0; k < samples; ++k) {
      const MarkerPair p = pair(part);
      const MatX numeric = jacobian([&](const Vec12& x) { return values(part, moved(p, x)); });
      const auto r = rows(part, p);
      for (int i = 0; i < part.rows(); ++i) {
        const Vec12 g = stacked(r[i].gradient);
        worst = std::max(worst, (g - numeric.row(i).transpose()).cwiseAbs().maxCoeff());
        EXPECT_GT(g.norm(), 1e-3);
      }
    }
  EXPECT_LT(worst, 1e-9);
  std::printf("[ figure ] gradient_error_%s %.1e\n", GetParam().name.c_str(), worst);
}

TEST_P(Constraint, CurvatureAgainstFiniteDifferences) {
  double worst = 0.0;
  for (const ConstraintPart& part : GetParam().parts)
    for (int k = 0; k < samples; ++k) {
      const MarkerPair p = pair(part);
      VecX lambda(part.rows());
      for (int i = 0; i < part.rows(); ++i) lambda[i] = numbers_(-3.0, 3.0);
      const Mat12 K = exact_curvature(part, p.a, p.b, lambda.data());
      const MatX numeric =
          jacobian([&](const Vec12& x) { return push(part, moved(p, x), lambda); });
      worst = std::max(worst,
                       (K - numeric).cwiseAbs().maxCoeff() / (1.0 + numeric.cwiseAbs().maxCoeff()));
    }
  EXPECT_LT(worst, 1e-9);
  std::printf("[ figure ] curvature_error_%s %.1e\n", GetParam().name.c_str(), worst);
}

// quad is the rate of Phi_q V for velocities V that stay; by the chain rule V^T (dg/dx) V.
TEST_P(Constraint, VelocityTermAgainstFiniteDifferencesAndCurvature) {
  for (const ConstraintPart& part : GetParam().parts)
    for (int k = 0; k < samples; ++k) {
      const MarkerPair p = pair(part);
      const Vec12 v = velocity(p);
      const auto r = rows(part, p);
      for (int i = 0; i < part.rows(); ++i) {
        const VecX unit = VecX::Unit(part.rows(), i);
        const VecX rate = derivative([&](double h) {
          return VecX::Constant(1, push(part, moved(p, h * v), unit).dot(v)).eval();
        });
        const double quad = r[i].quad;
        EXPECT_NEAR(quad, rate[0], 1e-8 * (1.0 + std::abs(quad)));
        const Mat12 K = exact_curvature(part, p.a, p.b, unit.data());
        EXPECT_NEAR(quad, v.dot(K * v), 1e-12 * (1.0 + v.squaredNorm()));
      }
    }
}

TEST_P(Constraint, TimeDerivativesAgainstFiniteDifferences) {
  for (const ConstraintPart& part : GetParam().parts) {
    const MarkerPair p = pair(part);
    const auto r = rows(part, p);
    const VecX first = derivative([&](double h) { return values(part, p, 0.3 + h); });
    const VecX second = derivative([&](double h) {
      VecX rate(part.rows());
      const auto at = rows(part, p, 0.3 + h);
      for (int i = 0; i < part.rows(); ++i) rate[i] = at[i].phi_t;
      return rate;
    });
    for (int i = 0; i < part.rows(); ++i) {
      EXPECT_NEAR(r[i].phi_t, first[i], 1e-9);
      EXPECT_NEAR(r[i].phi_tt, second[i], 1e-8);
    }
  }
}

// What formulations take from the facts of a kind instead of its rows.
TEST_P(Constraint, FactsAreThoseOfTheGradients) {
  for (const ConstraintPart& part : GetParam().parts) {
    const ConstraintKind& kind = constraint_kind(part.type);
    const MarkerPair p = pair(part);
    const auto r = rows(part, p);
    ASSERT_EQ(static_cast<int>(r.size()), kind.rows);
    double forces = 0.0;
    for (const ConstraintRow& row : r) forces += row.gradient.a.F.norm() + row.gradient.b.F.norm();
    EXPECT_EQ(forces > 0.0, kind.points);
    if (kind.gradients == PartGradients::unit) {
      ASSERT_EQ(kind.rows, 3);
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(stacked(r[k].gradient),
                  stacked({-Vec3::Unit(k), Vec3::Zero(), Vec3::Unit(k), Vec3::Zero()}));
    } else if (kind.gradients == PartGradients::line) {
      ASSERT_EQ(kind.rows, 1);
      const Vec3 n = (p.b.r - p.a.r) / part.scale;
      EXPECT_EQ(stacked(r[0].gradient), stacked({-n, Vec3::Zero(), n, Vec3::Zero()}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, Constraint, ::testing::ValuesIn(all_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace floatframe::test

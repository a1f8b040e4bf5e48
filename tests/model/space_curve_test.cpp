// Curves in space: foot points, smooth normals with their derivatives, and the exact curvature of
// the rows where the point is on the curve.
#include "floatframe/model/space_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/example_numbers.hpp"
#include "support/exact_tangents.hpp"
#include "support/marker_motion.hpp"

namespace floatframe::test {
namespace {

SpaceCurve helix() {
  PointOnCurve keys;
  keys.x = formula("2 * cos(u)");
  keys.y = formula("2 * sin(u)");
  keys.z = formula("0.3 * u + 0.02 * u^2");
  keys.range = MatX{{-3.0, 9.0}};
  return SpaceCurve(keys);
}

/// A closed curve in space, through points.
SpaceCurve ring() {
  PointOnCurve keys;
  keys.closed = true;
  keys.points.resize(24, 3);
  for (Eigen::Index k = 0; k < 24; ++k) {
    const double u = 2.0 * std::numbers::pi * static_cast<double>(k) / 24.0;
    keys.points.row(k) << std::cos(u), 0.8 * std::sin(u), 0.2 * std::cos(2.0 * u);
  }
  return SpaceCurve(keys);
}

TEST(SpaceCurves, FootPointsAreNormal) {
  for (const SpaceCurve& curve : {helix(), ring()})
    for (double u = 0.05; u < 4.0; u += 0.17) {
      const SpaceCurve::Foot at = curve.foot(curve.at(u).c);
      EXPECT_LT(at.e.norm(), 1e-12);
      const Vec3 p = curve.at(u).c + 0.1 * at.n[0] - 0.07 * at.n[1];
      const SpaceCurve::Foot f = curve.foot(p);
      EXPECT_LT((curve.at(f.u).c - curve.at(u).c).norm(), 1e-10) << u;
      EXPECT_NEAR(f.n[0].dot(f.e), 0.1, 1e-10);
      EXPECT_NEAR(f.n[1].dot(f.e), -0.07, 1e-10);
    }
}

TEST(SpaceCurves, NormalsAreSmoothAlongTheCurve) {
  const SpaceCurve curve = helix();
  constexpr double h = 1e-5;
  for (double u = -2.5; u < 8.0; u += 0.13) {
    const auto at = [&](double v) { return curve.foot(curve.at(v).c); };
    const SpaceCurve::Foot f = at(u), plus = at(u + h), minus = at(u - h);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(f.n[i].norm(), 1.0, 1e-14);
      EXPECT_NEAR(f.n[i].dot(f.t), 0.0, 1e-14);
      EXPECT_LT((f.n_u[i] - (plus.n[i] - minus.n[i]) / (2.0 * h)).norm(), 1e-8);
    }
    EXPECT_NEAR(f.n[0].cross(f.n[1]).dot(f.t), 1.0, 1e-13);
  }
}

TEST(SpaceCurves, RowsOfAPointOnThemAreExact) {
  ExampleNumbers numbers(7);
  const SpaceCurve curve = helix();
  ConstraintPart part;
  part.type = ConstraintType::on_curve;
  part.a = 0;
  part.b = 1;
  part.curve = &curve;
  double worst = 0.0;
  for (int k = 0; k < 30; ++k) {
    MarkerPair p{numbers.marker(), numbers.marker()};
    p.b.r = p.a.r + p.a.R * curve.at(numbers(-2.5, 8.0)).c;
    const auto rows = [&](const MarkerPair& m) {
      std::vector<ConstraintRow> r(2);
      evaluate_constraint(part, m.a, m.b, 0.0, r.data());
      return r;
    };
    const double lambda[] = {numbers(-2.0, 2.0), numbers(-2.0, 2.0)};
    const auto push = [&](const MarkerPair& m) {
      const auto r = rows(m);
      return VecX(lambda[0] * stacked(r[0].gradient) + lambda[1] * stacked(r[1].gradient));
    };
    const auto values = [&](const MarkerPair& m) {
      const auto r = rows(m);
      return VecX(VecX{{r[0].phi, r[1].phi}});
    };
    const auto r = rows(p);
    const MatX J = jacobian([&](const VecX& x) { return values(moved(p, Vec12(x))); });
    const MatX K = jacobian([&](const VecX& x) { return push(moved(p, Vec12(x))); });
    for (int i = 0; i < 2; ++i) {
      const Vec12 g = stacked(r[i].gradient), v = velocity(p);
      worst = std::max(worst, (g - J.row(i).transpose()).cwiseAbs().maxCoeff());
      const VecX unit = VecX::Unit(2, i);
      EXPECT_NEAR(r[i].quad, v.dot(exact_curvature(part, p.a, p.b, unit.data()) * v),
                  1e-11 * (1.0 + v.squaredNorm()));
    }
    const Mat12 exact = exact_curvature(part, p.a, p.b, lambda);
    worst = std::max(worst, (exact - K).cwiseAbs().maxCoeff() / (1.0 + K.cwiseAbs().maxCoeff()));
  }
  EXPECT_LT(worst, 1e-9);
  std::printf("[ figure ] rows_of_a_curve %.1e\n", worst);
}

}  // namespace
}  // namespace floatframe::test

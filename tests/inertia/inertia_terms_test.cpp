// Inertia terms as a program asks for them: both methods and both coordinate sets of one body.
#include "floatframe/inertia/inertia_terms.hpp"

#include <gtest/gtest.h>

#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/error_of.hpp"
#include "support/iltis_parts.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

BodyMotion random_motion(int modes) {
  Random random(7);
  BodyMotion m;
  m.r0 = random.matrix(3, 1);
  m.A = rotation_exp(random.matrix(3, 1));
  m.omega = random.matrix(3, 1);
  m.y = 1e-2 * random.matrix(modes, 1);
  m.ydot = random.matrix(modes, 1);
  return m;
}

TEST(InertiaTerms, BothMethodsAgree) {
  const FlexibleBody body = reduce(build_bar_frame(a_arm_frame(10)), a_arm_options());
  const BodyMotion m = random_motion(body.modes());
  const auto expect_equal = [](const InertiaTerms& a, const InertiaTerms& b) {
    EXPECT_LT((a.M - b.M).norm(), 1e-12 * a.M.norm());
    EXPECT_LT((a.Qv - b.Qv).norm(), 1e-12 * a.Qv.norm());
  };
  expect_equal(relative_preprocessing(body, m), relative_projection(body, m));
  expect_equal(absolute_preprocessing(body, m), absolute_projection(body, m));
}

TEST(InertiaTerms, RigidBodyAtRest) {
  FlexibleBody body;
  body.invariants = InertiaInvariants::rigid(2.0, {0.1, 0, 0}, 0.01 * Mat3::Identity());
  const InertiaTerms t = relative_preprocessing(body, {});
  ASSERT_EQ(t.M.rows(), 6);
  EXPECT_NEAR(t.M(0, 0), 2.0, 1e-15);
  EXPECT_NEAR(t.M(3, 3), 0.01, 1e-15);
  EXPECT_NEAR(t.M(4, 4), 0.01 + 2.0 * 0.01, 1e-15);
  EXPECT_EQ(t.Qv, VecX::Zero(6));
}

TEST(InertiaTerms, WhatDoesNotFitIsRefused) {
  FlexibleBody body;
  body.invariants = InertiaInvariants::rigid(2.0, Vec3::Zero(), Mat3::Identity());
  BodyMotion m;
  m.y = VecX::Zero(2);
  EXPECT_EQ(error_of([&] { relative_preprocessing(body, m); }), "wrong_count");
  EXPECT_EQ(error_of([&] { absolute_projection(body, {}); }), "missing");
}

TEST(InertiaTerms, SizesThatDoNotFit) {
  FlexibleBody body = reduce(build_bar_frame(a_arm_frame(5)), a_arm_options());
  const FlexibleBody good = body;
  body.invariants.Si[1].resize(3, 1);
  EXPECT_EQ(error_of([&] { relative_preprocessing(body, {}); }).substr(0, 34), "wrong_count");
  body = good;
  body.invariants.Sij[0][2].resize(0, 0);
  EXPECT_EQ(error_of([&] { absolute_preprocessing(body, {}); }).substr(0, 35), "wrong_count");
  body = good;
  ProjectionData data = *good.projection;
  data.X.conservativeResize(3, data.X.cols());
  body.projection = std::make_shared<ProjectionData>(data);
  EXPECT_EQ(error_of([&] { relative_projection(body, {}); }).substr(0, 29), "wrong_count");
  data = *good.projection;
  data.M_s.resize(1, 1);
  body.projection = std::make_shared<ProjectionData>(data);
  EXPECT_NE(error_of([&] { absolute_projection(body, {}); }), "no error");
}

}  // namespace
}  // namespace floatframe::test

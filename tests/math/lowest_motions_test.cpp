// The slowest motions of large systems against all eigenvalues of the same, and closed forms.
#include "floatframe/math/lowest_motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "floatframe/math/dense.hpp"

namespace floatframe::test {
namespace {

struct System {
  MatX M, C, K;
};

/// Masses in a row with springs of random stiffness; `held`: the first and the last to the ground.
System random_chain(int n, bool held) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  System s{MatX::Zero(n, n), MatX::Zero(n, n), MatX::Zero(n, n)};
  for (int i = 0; i < n; ++i) s.M(i, i) = std::exp(normal(generator));
  for (int i = 0; i <= n; ++i) {
    const double k = 1e4 * std::exp(2.0 * normal(generator));
    if (!held && (i == 0 || i == n)) continue;
    if (i > 0) s.K(i - 1, i - 1) += k;
    if (i < n) s.K(i, i) += k;
    if (i > 0 && i < n) s.K(i - 1, i) -= k, s.K(i, i - 1) -= k;
  }
  return s;
}

std::vector<std::complex<double>> sorted_values(const MatX& A) {
  const GeneralEigen e = general_eigen(A);
  std::vector<std::complex<double>> values;
  for (const auto& v : e.values)
    if (v.imag() >= 0.0) values.push_back(v);
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return values;
}

std::vector<std::complex<double>> all_values(const System& s) {
  const Eigen::Index n = s.M.rows();
  MatX A = MatX::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -lu_solve(s.M, s.K);
  A.bottomRightCorner(n, n) = -lu_solve(s.M, s.C);
  return sorted_values(A);
}

/// What is left of M x'' + C x' + K x, a part of its terms, and of x' = rate.
double equation_error(const System& s, const LowestMotions& m) {
  const MatX inertia = s.M * m.rate * m.A, damping = s.C * m.rate, spring = s.K * m.X;
  const double size = inertia.norm() + damping.norm() + spring.norm();
  return std::max((inertia + damping + spring).norm() / size,
                  (m.X * m.A - m.rate).norm() / (m.rate.norm() + 1e-300));
}

void expect_the_slowest(const System& s, int count) {
  const LowestMotions m = lowest_motions(s.M, s.C, s.K, count);
  ASSERT_TRUE(m.converged);
  EXPECT_EQ(m.found, count);
  EXPECT_LT(equation_error(s, m), 1e-8);
  const auto found = sorted_values(m.A), all = all_values(s);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_LT(std::abs(found[k] - all[k]), 1e-8 * std::abs(all[k])) << k;
  const double fastest = std::sqrt(generalised_eigenvalues(s.K, s.M).values.maxCoeff());
  EXPECT_NEAR(m.fastest, fastest, 0.1 * fastest);
}

TEST(LowestMotions, Undamped) { expect_the_slowest(random_chain(150, true), 20); }

TEST(LowestMotions, Damped) {
  System s = random_chain(150, true);
  s.C = 1e-4 * s.K + 0.3 * s.M;
  expect_the_slowest(s, 20);
}

TEST(LowestMotions, SlowDecaysOfHeavyDamping) {
  System s = random_chain(150, true);
  s.C.diagonal() = 1e3 * s.M.diagonal();
  expect_the_slowest(s, 20);
}

TEST(LowestMotions, Gyroscopic) {
  System s = random_chain(150, true);
  for (int i = 0; i + 1 < 150; i += 2) s.C(i, i + 1) = 30.0, s.C(i + 1, i) = -30.0;
  s.C.diagonal() += 0.1 * s.M.diagonal();
  expect_the_slowest(s, 20);
}

TEST(LowestMotions, EveryOneOfMotionsWithTheSameValue) {
  const int n = 240, copies = 25;
  System s{MatX::Identity(n, n), MatX::Zero(n, n), MatX::Zero(n, n)};
  for (int i = 0; i < n; ++i) s.K(i, i) = 100.0 * (1 + i / copies);
  const LowestMotions m = lowest_motions(s.M, s.C, s.K, 60);
  ASSERT_TRUE(m.converged);
  const auto found = sorted_values(m.A);
  ASSERT_EQ(found.size(), 60u);
  for (int k = 0; k < 60; ++k)
    EXPECT_NEAR(found[static_cast<std::size_t>(k)].imag(), 10.0 * std::sqrt(1.0 + k / copies), 1e-9)
        << k;
  EXPECT_GE(pivoted_rank(m.X, 1e-6), 60);
}

TEST(LowestMotions, FreeBodyHasAPlaceAndASpeed) {
  const System s = random_chain(150, false);
  const LowestMotions m = lowest_motions(s.M, s.C, s.K, 20);
  ASSERT_TRUE(m.converged);
  EXPECT_LT(equation_error(s, m), 1e-6);
  // All go together in one motion, and A has the Jordan block that lets them go on.
  const VecX x = m.X.col(0), u = m.X.col(1);
  const VecX ones = VecX::Ones(150);
  EXPECT_EQ(pivoted_rank(m.X.leftCols(2), 1e-6), 1);
  for (const VecX& shape : {x, u})
    EXPECT_LT((shape - shape.mean() * ones).norm(), 1e-7 * m.X.leftCols(2).norm());
  EXPECT_EQ(pivoted_rank(m.rate.leftCols(2), 1e-6), 1);
  EXPECT_LT((m.A.topLeftCorner(2, 2) * m.A.topLeftCorner(2, 2)).norm(),
            1e-6 * m.A.topLeftCorner(2, 2).squaredNorm());
  const VecX w2 = generalised_eigenvalues(s.K, s.M).values;
  const double last = sorted_values(m.A).back().imag();
  EXPECT_NEAR(last, std::sqrt(w2[(m.A.rows() - 2) / 2]), 1e-8 * last);
}

TEST(LowestMotions, WhatHasNoMassFollows) {
  System s = random_chain(150, true);
  std::vector<int> light, heavy;
  for (int i = 0; i < 150; ++i) (i % 5 == 0 ? light : heavy).push_back(i);
  for (const int i : light) s.M(i, i) = 0.0;
  const LowestMotions m = lowest_motions(s.M, s.C, s.K, 20);
  ASSERT_TRUE(m.converged);
  EXPECT_LT(equation_error(s, m), 1e-8);
  const MatX follows = -lu_solve(s.K(light, light), s.K(light, heavy));
  const MatX K = s.K(heavy, heavy) + s.K(heavy, light) * follows;
  const VecX w2 = generalised_eigenvalues(K, MatX(s.M(heavy, heavy))).values;
  const auto found = sorted_values(m.A);
  ASSERT_EQ(found.size(), 20u);
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(found[static_cast<std::size_t>(k)].imag(), std::sqrt(w2[k]),
                1e-8 * std::sqrt(w2[k]))
        << k;
  // With a damper instead some decay.
  for (const int i : light) s.C(i, i) = 100.0;
  const LowestMotions damped = lowest_motions(s.M, s.C, s.K, 20);
  ASSERT_TRUE(damped.converged);
  EXPECT_LT(equation_error(s, damped), 1e-8);
}

TEST(LowestMotions, NothingHoldsAnyOfThem) {
  const int n = 120;
  const MatX none = MatX::Zero(n, n);
  const LowestMotions m = lowest_motions(MatX::Identity(n, n), none, none, 20);
  ASSERT_TRUE(m.converged);
  EXPECT_GE(m.found, 20);
  for (const auto& lambda : sorted_values(m.A))
    EXPECT_LT(std::abs(lambda), zero_part * m.fastest) << lambda;
}

TEST(LowestMotions, NothingToFind) {
  System s = random_chain(150, true);
  s.M.row(7).setZero(), s.M.col(7).setZero(), s.K.row(7).setZero(), s.K.col(7).setZero();
  EXPECT_TRUE(lowest_motions(s.M, s.C, s.K, 20).singular);
  s.K(7, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lowest_motions(s.M, s.C, s.K, 20).converged);
  EXPECT_FALSE(lowest_motions(MatX(0, 0), MatX(0, 0), MatX(0, 0), 5).converged);
}

TEST(LowestMotions, MoreThanThereAre) {
  const System s = random_chain(30, true);
  const LowestMotions m = lowest_motions(s.M, s.C, s.K, 100);
  ASSERT_TRUE(m.converged);
  EXPECT_EQ(m.found, 30);
  EXPECT_LT(equation_error(s, m), 1e-5);
}

}  // namespace
}  // namespace floatframe::test

#include "floatframe/math/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace floatframe {
namespace {

MatX matrix(std::initializer_list<std::initializer_list<double>> rows) {
  MatX A(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    Eigen::Index j = 0;
    for (const double x : row) A(i, j++) = x;
    ++i;
  }
  return A;
}

TEST(Dense, EigenvaluesOfASymmetricMatrix) {
  const MatX A = matrix({{2.0, 1.0}, {1.0, 2.0}});
  const SymmetricEigen e = symmetric_eigen(A);
  ASSERT_TRUE(e.found);
  EXPECT_NEAR(e.values[0], 1.0, 1e-15);
  EXPECT_NEAR(e.values[1], 3.0, 1e-15);
  EXPECT_LT((A * e.vectors - e.vectors * e.values.asDiagonal()).norm(), 1e-15);
  EXPECT_LT((symmetric_eigenvalues(A) - e.values).norm(), 1e-15);
}

// Two masses of 1 and 4 kg between three springs of 1 N/m: det(K - w2 M) = 4 w2^2 - 10 w2 + 3.
TEST(Dense, GeneralisedEigenvaluesWithVectorsOfUnitMass) {
  const MatX K = matrix({{2.0, -1.0}, {-1.0, 2.0}}), M = matrix({{1.0, 0.0}, {0.0, 4.0}});
  const SymmetricEigen e = generalised_eigen(K, M);
  ASSERT_TRUE(e.found);
  EXPECT_NEAR(e.values[0], (10.0 - std::sqrt(52.0)) / 8.0, 1e-15);
  EXPECT_NEAR(e.values[1], (10.0 + std::sqrt(52.0)) / 8.0, 1e-15);
  EXPECT_LT((e.vectors.transpose() * M * e.vectors - MatX::Identity(2, 2)).norm(), 1e-15);
  EXPECT_LT((generalised_eigenvalues(K, M).values - e.values).norm(), 1e-15);
}

TEST(Dense, WithoutADefiniteMatrixNothingIsFound) {
  const MatX K = matrix({{2.0, -1.0}, {-1.0, 2.0}}), M = matrix({{1.0, 2.0}, {2.0, 1.0}});
  EXPECT_FALSE(is_positive_definite(M));
  EXPECT_TRUE(is_positive_definite(K));
  for (const SymmetricEigen& e : {generalised_eigen(K, M), generalised_eigenvalues(K, M)}) {
    EXPECT_FALSE(e.found);
    ASSERT_EQ(e.values.size(), 2);
    EXPECT_TRUE(e.values.array().isNaN().all());
  }
}

TEST(Dense, PivotedQrSpansTheColumnsFirst) {
  const MatX A = matrix({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}});
  const PivotedQr qr = pivoted_qr(A, 1e-12);
  EXPECT_EQ(qr.rank, 2);
  EXPECT_EQ(pivoted_rank(A, 1e-12), 2);
  EXPECT_EQ(pivoted_rank(MatX(0, 3)), 0);
  ASSERT_EQ(qr.Q.rows(), 4);
  ASSERT_EQ(qr.Q.cols(), 4);
  EXPECT_LT((A.transpose() * qr.Q.rightCols(2)).norm(), 1e-14);
  EXPECT_EQ(qr.pivots[0], 2);
  EXPECT_NEAR(std::abs(qr.diagonal[0]), std::sqrt(20.0), 1e-14);
  // What counts as zero is given relative to the largest entry.
  const MatX nearly = matrix({{1.0, 0.0}, {0.0, 1e-6}});
  EXPECT_EQ(pivoted_rank(nearly, 1e-5), 1);
  EXPECT_EQ(pivoted_rank(nearly, 1e-7), 2);
}

// x + y = 2 has its solution of least norm at (1, 1); a second, contradicting equation x + y = 4
// moves it.
TEST(Dense, LeastNorm) {
  const LeastNorm one(matrix({{1.0, 1.0}}));
  EXPECT_LT((one.solve(VecX(VecX::Constant(1, 2.0))) - VecX::Ones(2)).norm(), 1e-15);
  const LeastNorm two(matrix({{1.0, 1.0}, {1.0, 1.0}}), 1e-12);
  EXPECT_LT((two.solve(VecX(Eigen::Vector2d(2.0, 4.0))) - VecX::Constant(2, 1.5)).norm(), 1e-14);
  EXPECT_LT((two.pseudo_inverse() - MatX::Constant(2, 2, 0.25)).norm(), 1e-15);
}

TEST(Dense, LeastNormOfNothingIsZero) {
  for (const auto& [rows, cols] : {std::pair{0, 3}, std::pair{2, 0}, std::pair{0, 0}}) {
    const LeastNorm none(MatX(rows, cols), 1e-12);
    EXPECT_EQ(none.solve(VecX(VecX::Ones(rows))), VecX::Zero(cols));
    EXPECT_EQ(none.solve(MatX(MatX::Ones(rows, 2))), MatX::Zero(cols, 2));
    EXPECT_EQ(none.pseudo_inverse(), MatX::Zero(cols, rows));
  }
}

TEST(Dense, SingularValues) {
  const Singular s = singular_values(matrix({{3.0, 0.0, 0.0}, {0.0, 0.0, 4.0}}));
  ASSERT_EQ(s.values.size(), 2);
  EXPECT_NEAR(s.values[0], 4.0, 1e-15);
  EXPECT_NEAR(s.values[1], 3.0, 1e-15);
  ASSERT_EQ(s.V.cols(), 3);
  EXPECT_NEAR(std::abs(s.V(1, 2)), 1.0, 1e-15);  // what neither row sees
}

TEST(Dense, Solutions) {
  const MatX A = matrix({{4.0, 1.0}, {1.0, 3.0}}), X = matrix({{1.0, -2.0}, {0.5, 3.0}});
  EXPECT_LT((lu_solve(A, A * X) - X).norm(), 1e-14);
  EXPECT_LT((ldlt_solve(A, A * X) - X).norm(), 1e-14);
  EXPECT_LT((qr_solve(A, A * X) - X).norm(), 1e-14);
}

}  // namespace
}  // namespace floatframe

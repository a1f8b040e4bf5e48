// (s I - A)^-1 B for matrices of unlike units, against the product.
#include "floatframe/math/resolvent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floatframe {
namespace {

TEST(Resolvent, SolvesWhateverTheUnits) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const Eigen::Index n : {0, 1, 2, 3, 7, 30}) {
    MatX A(n, n), B(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j)
        A(i, j) = number(engine) * std::pow(10.0, static_cast<double>((i * 7 + j * 5) % 9 - 4));
      for (Eigen::Index j = 0; j < 2; ++j) B(i, j) = number(engine);
    }
    const Resolvent resolvent(A);
    for (const std::complex<double> s : {std::complex<double>(0.0, 3.0), {0.0, 4e3}, {-0.7, 0.2}}) {
      Eigen::MatrixXcd X;
      ASSERT_TRUE(resolvent.solve(s, B.cast<std::complex<double>>(), X));
      ASSERT_EQ(X.rows(), n);
      // Row by row, against the sum of what is added up.
      const Eigen::MatrixXcd left = s * X - A * X;
      const MatX size = std::abs(s) * X.cwiseAbs() + A.cwiseAbs() * X.cwiseAbs() + B.cwiseAbs();
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < 2; ++j)
          EXPECT_LT(std::abs(left(i, j) - B(i, j)), 1e-9 * size(i, j)) << n << " at " << s;
    }
  }
}

TEST(Resolvent, SingularShiftsAreReported) {
  MatX A(2, 2);
  A << 0, 1, -4, 0;
  const Resolvent resolvent(A);
  Eigen::MatrixXcd X;
  const Eigen::MatrixXcd B = Eigen::MatrixXcd::Ones(2, 1);
  EXPECT_FALSE(resolvent.solve({0.0, 2.0}, B, X));
  EXPECT_TRUE(resolvent.solve({0.0, 1.9}, B, X));
}

}  // namespace
}  // namespace floatframe

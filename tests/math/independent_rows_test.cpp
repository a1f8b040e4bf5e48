// Sparse rows in their order: which repeat those before them, and solutions of least norm, against
// dense linear algebra.
#include "floatframe/math/independent_rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "floatframe/math/dense.hpp"

namespace floatframe::test {
namespace {

/// Rows of a band; each of `repeats` is a combination of the two rows before it.
MatX banded(int rows, int columns, const std::vector<int>& repeats) {
  std::mt19937 numbers(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  MatX A = MatX::Zero(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 6; ++j) A(i, std::min(columns - 1, i + j)) += 100.0 * number(numbers);
  for (const int i : repeats) A.row(i) = 3.0 * A.row(i - 1) - 1e-3 * A.row(i - 2);
  return A;
}

TEST(IndependentRows, NamesTheRowsThatRepeatThoseBeforeThem) {
  const std::vector<int> repeats{4, 9, 30};
  const IndependentRows rows(banded(40, 45, repeats).sparseView(), 1e-9);
  EXPECT_EQ(rows.rank(), 37);
  EXPECT_EQ(rows.dependent(), repeats);
}

TEST(IndependentRows, SolvesWithTheLeastNorm) {
  const MatX A = banded(40, 60, {4, 9, 30});
  const VecX b = A * VecX::LinSpaced(60, -1.0, 2.0);
  const VecX x = IndependentRows(A.sparseView(), 1e-9).least_norm(b);
  const VecX dense = LeastNorm(A, 1e-11).solve(b);
  EXPECT_LT((x - dense).norm(), 1e-10 * dense.norm());
}

TEST(IndependentRows, TakesEmptyRowsAndNone) {
  MatX A = MatX::Zero(3, 4);
  A(1, 2) = 2.0;
  const IndependentRows rows(A.sparseView(), 1e-9);
  EXPECT_EQ(rows.rank(), 1);
  EXPECT_EQ(rows.dependent(), (std::vector<int>{0, 2}));
  EXPECT_LT((rows.least_norm(Vec3(0, 3, 0)) - VecX(VecX::Unit(4, 2) * 1.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace floatframe::test

// The yardstick of the benchmarks.
#include "floatframe/math/dense_factorization.hpp"

#include <gtest/gtest.h>

namespace floatframe {
namespace {

TEST(DenseFactorization, GrowsWithTheMatrix) {
  const double small = dense_factorization_seconds(20), large = dense_factorization_seconds(98);
  EXPECT_GT(small, 0.0);
  EXPECT_GT(large, small);
}

}  // namespace
}  // namespace floatframe

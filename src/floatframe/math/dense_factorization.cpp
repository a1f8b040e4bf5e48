#include "floatframe/math/dense_factorization.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <limits>
#include <random>

#include "floatframe/math/types.hpp"

namespace floatframe {

double dense_factorization_seconds(int n) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MatX B(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) B(i, j) = uniform(generator);
  }
  MatX A = B * B.transpose();
  A.diagonal().array() += n;  // well conditioned

  using Clock = std::chrono::steady_clock;
  Eigen::LLT<MatX> llt(n);
  double least = std::numeric_limits<double>::infinity();
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(300);
  for (int repetition = 0; repetition < 200 || Clock::now() < end; ++repetition) {
    const Clock::time_point start = Clock::now();
    llt.compute(A);
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
    // The result is used, so that no repetition can be optimised away.
    A(0, 0) += llt.info() == Eigen::Success ? 1e-12 * llt.matrixLLT()(n - 1, n - 1) : 1.0;
  }
  return least;
}

}  // namespace floatframe

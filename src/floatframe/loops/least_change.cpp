#include "floatframe/loops/least_change.hpp"

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Up to this size dense linear algebra is as fast, and takes the rows in the best order.
constexpr int few_rows = 200;

}  // namespace

VecX least_change(const SparseRowMatrix& J, const VecX& weights, const VecX& b) {
  if (J.cols() == 0) return VecX();
  const VecX roots = weights.cwiseSqrt();
  const SparseRowMatrix Jw = J * roots.asDiagonal();
  if (J.rows() > few_rows) return roots.cwiseProduct(IndependentRows(Jw, 1e-11).least_norm(b));
  return roots.cwiseProduct(LeastNorm(MatX(Jw), 1e-11).solve(b));
}

}  // namespace floatframe

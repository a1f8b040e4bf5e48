#pragma once
// Sums of squares of fields in all pairs of modes, for many cases at once:
//   K(pair, case) = sum over points sum_i g_i s(case) g_i^T
// g_i: three rows of a field, one column per mode; s: a symmetric 3 x 3 matrix of each case. The
// products of a batch of points in the columns of P and the s of all cases in S give one dense
// product K += P S^T.
#include "floatframe/math/types.hpp"

namespace floatframe {

class PairProducts {
 public:
  PairProducts(Eigen::Index modes, Eigen::Index cases);
  /// g: rows 3 i .. 3 i + 2 are those of g_i; s: 6 x cases (xx, yy, zz, xy, yz, zx).
  void add(const MatX& g, const MatX& s);
  /// One column per case: the lower half of the sum, row by row. Ends it.
  MatX take();

 private:
  void flush();

  MatX K_, P_, S_;
  Eigen::Index filled_ = 0;
};

/// A column of the sum as a matrix.
MatX symmetric_of(const Eigen::Ref<const VecX>& packed);

}  // namespace floatframe

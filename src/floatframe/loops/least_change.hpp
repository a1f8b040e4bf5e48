#pragma once
// The least change of coordinates that closes gaps, in weights: min x^T W^-1 x with J x = b. Load
// time.
#include "floatframe/math/independent_rows.hpp"

namespace floatframe {

/// `weights`: of the coordinates; one of zero does not change. Dependent rows of J are allowed.
VecX least_change(const SparseRowMatrix& J, const VecX& weights, const VecX& b);

}  // namespace floatframe

#pragma once
// Modal damping: a matrix D with which every mode of (K, M_ff) has the same ratio of critical
// damping.
#include "floatframe/math/types.hpp"

namespace floatframe {

/// With M x = mu K x, x^T K x = 1, w = 1/sqrt(mu): D = sum 2 ratio sqrt(mu) (K x)(K x)^T; massless
/// modes (mu = 0) get none. Throws InputError unless K > 0.
MatX modal_damping(const MatX& K, const MatX& M, double ratio);

}  // namespace floatframe

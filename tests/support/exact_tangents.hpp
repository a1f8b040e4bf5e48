#pragma once
// The exact derivatives of constraint parts, by their list: each kind defines its own next to its
// rows. Steps use shorter ways, which tests compare with these.
#include "floatframe/model/constraint_part.hpp"

namespace floatframe::test {

/// d(sum lambda_r gradient_r)/d(motion)
inline Mat12 exact_curvature(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                             const double* lambda) {
  Mat12 K = Mat12::Zero();
  add_constraint_curvature(part, a, b, lambda, K);
  return K;
}

}  // namespace floatframe::test

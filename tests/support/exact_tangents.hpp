#pragma once
// The exact derivatives of elements, by their lists: each kind of force and of constraint part
// defines its own beside its law. Steps use shorter ways, which tests hold to these.
#include <iterator>

#include "floatframe/model/force_kind.hpp"

namespace floatframe::test {

inline ForceTangent exact_tangent(const ForceInput& in) {
  ForceTangent out;
  out.K.setZero();
  out.C.setZero();
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((in.force.type == force_types[I] ? force_tangent_of<force_types[I]>(in, out) : void()), ...);
  }
  (std::make_index_sequence<std::size(force_types)>{});
  return out;
}

/// d(sum lambda_r gradient_r)/d(motion)
inline Mat12 exact_curvature(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                             const double* lambda) {
  Mat12 K = Mat12::Zero();
  add_constraint_curvature(part, a, b, lambda, K);
  return K;
}

}  // namespace floatframe::test

#pragma once
// Lowest modes of K x = w^2 M x for sparse symmetric K > 0 and M >= 0 (M may be singular: massless
// dofs).
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct Eigenmodes {
  VecX omega;   ///< [rad/s], ascending
  MatX shapes;  ///< columns, x^T M x = 1, largest component positive
};

/// The `count` lowest modes; fewer if M has a smaller rank. Small problems: dense, in the form M x
/// = (1/w^2) K x; large ones: subspace iteration with the sparse factors of K.
Eigenmodes lowest_modes(const SparseMatrix& K, const SparseMatrix& M, int count);

/// Number of modes with omega below a limit [rad/s] (Sylvester's law of inertia).
int count_modes_below(const SparseMatrix& K, const SparseMatrix& M, double omega);

}  // namespace floatframe

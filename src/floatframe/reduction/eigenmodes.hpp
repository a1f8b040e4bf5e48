#pragma once
// Lowest modes of K x = w^2 M x for sparse symmetric K and M >= 0 (M may be singular: massless
// dofs, reduced integration). With A = K - sigma M > 0,
//   M x = mu A x,   w^2 = sigma + 1/mu.
// Small problems are solved densely in this form; large ones by implicitly restarted Lanczos
// iteration on A^-1 M (Spectra), then one block step of inverse iteration with a Rayleigh-Ritz
// projection, which cleans the shapes of massless parts and separates multiple modes. The initial
// vector is fixed: results are reproducible.
#include <functional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/sparse_factors.hpp"

namespace floatframe {

struct Eigenmodes {
  VecX omega;   ///< [rad/s], ascending
  MatX shapes;  ///< columns, x^T M x = 1, largest component positive
  VecX frequencies() const { return omega.unaryExpr(&hertz); }
};

/// The iteration for the modes of a large problem fails: equal parts have equal frequencies, and
/// massless directions leave no vector to distinguish their modes.
class EigenIterationError : public InputError {
 public:
  using InputError::InputError;
};

/// -1 if the largest component of x is negative, else 1. Among components that are equal up to
/// rounding the first decides, so that no sign depends on rounding.
double sign_of_largest(const VecX& x);

/// The `count` lowest modes, K > 0; fewer if M has a smaller rank.
Eigenmodes lowest_modes(const SparseMatrix& K, const SparseMatrix& M, int count);
/// The same with the factors of K given.
Eigenmodes lowest_modes(const SparseMatrix& K, const SparseFactors& factors, const SparseMatrix& M,
                        int count);

/// The same with K^-1 b given by a function, for many dofs and few modes.
Eigenmodes lowest_modes(const std::function<MatX(const MatX&)>& solve, const SparseMatrix& M,
                        int count);

struct Eigenpairs {
  VecX lambda;  ///< w^2, ascending; about zero for rigid motions
  MatX shapes;  ///< as in Eigenmodes
};

/// The `count` lowest modes; A = K - sigma M with sigma below all of them, and its factors.
Eigenpairs lowest_eigenpairs(const SparseMatrix& A, const SparseFactors& factors, double sigma,
                             const SparseMatrix& M, int count);

/// Number of modes with omega below a limit [rad/s] (Sylvester's law of inertia).
int count_modes_below(const SparseMatrix& K, const SparseMatrix& M, double omega,
                      SparseSolver solver = SparseSolver::automatic);

}  // namespace floatframe

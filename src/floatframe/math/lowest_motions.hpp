#pragma once
// The slowest of the motions M x'' + C x' + K x = 0 of a large dense system, without computing all
// of its eigenvalues, at a cost of 25 (2 n)^3 and more.
//
// Near a shift sigma > 0, with Q = K + sigma C + sigma^2 M and w = x' / sigma,
//   (x, w) -> (y, y + x),  y = -Q^-1 ((sigma C + sigma^2 M) x + sigma^2 M w)
// has the eigenvalues nu = sigma / (lambda - sigma): the slowest motions have the largest. Blocks
// of this map span a subspace of x (block Krylov of second order, without restarts), which contains
// them to rounding before it is complete. The projected problem is again of second order and keeps
// its properties: symmetric, definite, undamped. Massless directions need no special treatment. A
// random block after convergence finds further motions with the same lambda.
//
// Z. Bai, Y. Su (2005), SOAR: A second-order Arnoldi method for the solution of the quadratic
// eigenvalue problem, SIAM J. Matrix Anal. Appl. 26(3).
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Below this fraction of the fastest one a lambda is zero.
inline constexpr double zero_part = 1e-7;

/// The slowest motions: zdot = A z, x = X z, xdot = rate z. Unrestrained motions come first, with
/// all vectors of their Jordan blocks; then blocks [a b; -b a] of the pairs lambda = a + i b and
/// real ones, ascending by |lambda|.
struct LowestMotions {
  MatX A;         ///< nz x nz [1/s]
  MatX X, rate;   ///< n x nz
  int found = 0;  ///< motions, a pair once
  double fastest =
      0.0;  ///< the largest frequency without damping, about [1/s]; 1 without stiffness
  bool converged = false;  ///< false: fewer than requested, or none
  bool singular = false;   ///< a direction without mass, damping and stiffness
};

/// `count` of them, pairs once, and all unrestrained ones as long as those are fewer. Allocates;
/// the same on each run.
LowestMotions lowest_motions(const MatX& M, const MatX& C, const MatX& K, int count);

}  // namespace floatframe

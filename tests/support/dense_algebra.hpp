#pragma once
// Decompositions of small dense matrices, compiled once: they take a compiler longer than the rest
// of a test.
#include "floatframe/math/types.hpp"

namespace floatframe::test {

/// In ascending order.
VecX eigenvalues(const MatX& symmetric);
/// Of K x = lambda M x, in ascending order.
VecX eigenvalues(const MatX& K, const MatX& M);
/// The vector of the lowest eigenvalue of K x = lambda M x.
VecX lowest_eigenvector(const MatX& K, const MatX& M);
/// x with the least |A x - b|.
MatX least_squares(const MatX& A, const MatX& b);
/// In descending order.
VecX singular_values(const MatX& A);

}  // namespace floatframe::test

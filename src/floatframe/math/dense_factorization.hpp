#pragma once
// A machine-independent reference for step times: one dense Cholesky factorisation.

namespace floatframe {

/// Least wall-clock time [s] of `Eigen::LLT<MatrixXd>::compute` of a random symmetric positive
/// definite n x n matrix, storage allocated beforehand, over many repetitions. Compiled with the
/// flags of the library.
double dense_factorization_seconds(int n);

}  // namespace floatframe

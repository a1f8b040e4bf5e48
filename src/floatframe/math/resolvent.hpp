#pragma once
// (s I - A)^-1 B for many complex s: A = Q H Q^T once, with an upper Hessenberg matrix H of the
// balanced A; then each s costs n^2 operations a column, by elimination of the subdiagonal with
// row exchanges.
#include <complex>

#include "floatframe/math/types.hpp"

namespace floatframe {

class Resolvent {
 public:
  explicit Resolvent(const MatX& A);

  /// False, with X unchanged, if s is an eigenvalue of A to rounding.
  bool solve(std::complex<double> s, const Eigen::MatrixXcd& B, Eigen::MatrixXcd& X) const;

 private:
  VecX scales_;
  MatX Q_, H_;
};

}  // namespace floatframe

#pragma once
// The subspaces used by lowest_motions.hpp for slow motions: blocks of its map near a shift.
#include <memory>
#include <random>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// M, C, K in coordinates of similar magnitude, and the map of lowest_motions.hpp.
class ShiftedMap {
 public:
  ShiftedMap(MatX M, MatX C, MatX K);
  ~ShiftedMap();

  /// False if Q is singular.
  bool factorise(double shift);
  MatX solve(const MatX& force) const;   ///< Q^-1 force
  MatX operator()(const MatX& z) const;  ///< columns z = (x, w), 2 n
  MatX M, C, K;
  double sigma = 0.0;  ///< the shift

 private:
  struct Factors;
  MatX damped_;  ///< sigma C + sigma^2 M
  std::unique_ptr<Factors> factors_;
};

/// Orthonormal columns U of x, which grow block by block, with their products with M, C, K.
class SecondOrderSubspace {
 public:
  /// Columns of a block: this number of motions with equal lambda is found at once.
  static constexpr Eigen::Index block = 8;

  /// With one random block.
  explicit SecondOrderSubspace(const ShiftedMap& map);

  Eigen::Index size() const { return size_; }
  bool complete() const { return size_ == rows_; }
  auto U() const { return U_.leftCols(size_); }

  /// Extends it by the image of the last block, or by random directions if that adds nothing.
  /// False: there are no more, or they are not finite.
  bool grow() { return append(map_(last_)) || append_random(); }
  bool append_random();
  /// The map in the subspace, 2 size x 2 size.
  MatX projected() const;
  /// Q^-1 (lambda^2 M + lambda C + K) x of x = U s, a column each.
  Eigen::MatrixXcd corrections(const Eigen::MatrixXcd& s, const Eigen::VectorXcd& lambda) const;

 private:
  bool append(const MatX& z);
  bool extend(const MatX& x);

  const ShiftedMap& map_;
  Eigen::Index rows_, size_ = 0, steps_ = 0;
  MatX U_, M_, C_, K_;  ///< of M_, C_, K_ column k is that matrix times the one of U_
  MatX Z_, last_;       ///< directions of (x, w), orthonormal, and the last block of them
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

}  // namespace floatframe

#include "floatframe/math/second_order_subspace.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Writes columns to a growing matrix.
void put(MatX& all, Eigen::Index at, const MatX& columns) {
  if (all.cols() < at + columns.cols())
    all.conservativeResize(columns.rows(), std::max(at + columns.cols(), 2 * all.cols()));
  all.middleCols(at, columns.cols()) = columns;
}

/// An orthonormal basis of the part of `z` outside of the first `size` columns of `all`; empty if
/// there is none or it is not finite.
MatX new_directions(const MatX& all, Eigen::Index size, MatX z) {
  constexpr double dependent = 1e-12;  // relative to the initial norm
  const auto known = all.leftCols(size);
  const VecX before = z.colwise().norm().cwiseMax(1e-300);
  for (int twice = 0; twice < 2 && size > 0; ++twice) z -= known * (known.transpose() * z);
  const Eigen::ColPivHouseholderQR<MatX> qr(z * before.cwiseInverse().asDiagonal());
  Eigen::Index count = 0;
  const Eigen::Index most = std::min(z.cols(), z.rows() - size);
  while (count < most && std::abs(qr.matrixR()(count, count)) > dependent) ++count;
  MatX fresh = qr.householderQ() * MatX::Identity(z.rows(), count);
  if (size == 0 || count == 0) return fresh;
  // Directions that were nearly dependent lost their orthogonality.
  fresh -= known * (known.transpose() * fresh);
  return Eigen::HouseholderQR<MatX>(fresh).householderQ() * MatX::Identity(z.rows(), count);
}

/// A real matrix times a complex one.
Eigen::MatrixXcd product(const MatX& A, const Eigen::MatrixXcd& x) {
  Eigen::MatrixXcd out(A.rows(), x.cols());
  out.real() = A * MatX(x.real());
  out.imag() = A * MatX(x.imag());
  return out;
}

}  // namespace

struct ShiftedMap::Factors {
  Eigen::PartialPivLU<MatX> lu;
};

ShiftedMap::ShiftedMap(MatX M, MatX C, MatX K)
    : M(std::move(M)), C(std::move(C)), K(std::move(K)), factors_(std::make_unique<Factors>()) {}
ShiftedMap::~ShiftedMap() = default;

bool ShiftedMap::factorise(double shift) {
  sigma = shift;
  damped_ = sigma * C + sigma * sigma * M;
  factors_->lu.compute(K + damped_);
  // Eigen's condition estimate is meaningless if a pivot is zero.
  const VecX pivots = factors_->lu.matrixLU().diagonal().cwiseAbs();
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  return pivots.minCoeff() > rounding * rounding * pivots.maxCoeff() &&
         factors_->lu.rcond() > rounding;
}

MatX ShiftedMap::solve(const MatX& force) const { return factors_->lu.solve(force); }

MatX ShiftedMap::operator()(const MatX& z) const {
  const Eigen::Index n = M.rows();
  MatX out(2 * n, z.cols());
  out.topRows(n) = -solve(damped_ * z.topRows(n) + sigma * sigma * (M * z.bottomRows(n)));
  out.bottomRows(n) = out.topRows(n) + z.topRows(n);
  return out;
}

SecondOrderSubspace::SecondOrderSubspace(const ShiftedMap& map) : map_(map), rows_(map.M.rows()) {
  append_random();
}

bool SecondOrderSubspace::append_random() {
  MatX z(2 * rows_, block);
  for (double& x : z.reshaped()) x = uniform_(generator_);
  return append(z);
}

bool SecondOrderSubspace::append(const MatX& z) {
  last_ = new_directions(Z_, steps_, z);
  if (last_.cols() == 0) return false;
  put(Z_, steps_, last_);
  steps_ += last_.cols();
  // w is y + x, already in the span, except for random directions.
  const bool by_x = extend(last_.topRows(rows_)), by_w = extend(last_.bottomRows(rows_));
  return by_x || by_w;
}

bool SecondOrderSubspace::extend(const MatX& x) {
  if (complete()) return false;
  const MatX fresh = new_directions(U_, size_, x);
  if (fresh.cols() == 0) return false;
  put(U_, size_, fresh);
  put(M_, size_, map_.M * fresh);
  put(C_, size_, map_.C * fresh);
  put(K_, size_, map_.K * fresh);
  size_ += fresh.cols();
  return true;
}

MatX SecondOrderSubspace::projected() const {
  const Eigen::Index m = size_;
  const double sigma = map_.sigma;
  const MatX Ut = U().transpose();
  const MatX mass = sigma * sigma * (Ut * M_.leftCols(m));
  const MatX damped = sigma * (Ut * C_.leftCols(m)) + mass;
  const MatX Q = Ut * K_.leftCols(m) + damped;
  MatX H(2 * m, 2 * m);
  H.topRows(m) << damped, mass;
  H.topRows(m) = -lu_solve(Q, H.topRows(m));
  H.bottomRows(m) = H.topRows(m);
  H.bottomLeftCorner(m, m).diagonal().array() += 1.0;
  return H;
}

Eigen::MatrixXcd SecondOrderSubspace::corrections(const Eigen::MatrixXcd& s,
                                                  const Eigen::VectorXcd& lambda) const {
  const Eigen::MatrixXcd rate = s * lambda.asDiagonal(), acceleration = rate * lambda.asDiagonal();
  const Eigen::MatrixXcd r = product(M_.leftCols(size_), acceleration) +
                             product(C_.leftCols(size_), rate) + product(K_.leftCols(size_), s);
  Eigen::MatrixXcd out(r.rows(), r.cols());
  out.real() = map_.solve(r.real());
  out.imag() = map_.solve(r.imag());
  return out;
}

}  // namespace floatframe

#include "floatframe/reduction/fixed_interface.hpp"

#include <fmt/format.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/frequency.hpp"

namespace floatframe {
namespace {

/// Rows and columns of A that have a number.
SparseMatrix select(const SparseMatrix& A, const std::vector<int>& row_of, std::size_t rows,
                    const std::vector<int>& columns) {
  SparseMatrix out(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns.size()));
  Eigen::Index entries = 0;
  for (const int j : columns) entries += A.col(j).nonZeros();
  out.reserve(entries);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    out.startVec(static_cast<Eigen::Index>(c));
    for (SparseMatrix::InnerIterator it(A, columns[c]); it; ++it) {
      const int r = row_of[it.row()];
      if (r >= 0) out.insertBack(r, static_cast<Eigen::Index>(c)) = it.value();
    }
  }
  out.finalize();
  return out;
}

}  // namespace

SparseMatrix pick(const SparseMatrix& A, const std::vector<int>& rows,
                  const std::vector<int>& columns) {
  std::vector<int> place(A.rows(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (SparseMatrix::InnerIterator it(A, columns[c]); it; ++it)
      if (const int r = place[it.row()]; r >= 0)
        entries.emplace_back(r, static_cast<int>(c), it.value());
  SparseMatrix out(static_cast<Eigen::Index>(rows.size()),
                   static_cast<Eigen::Index>(columns.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

FixedInterface::FixedInterface(const SparseMatrix& K, const SparseMatrix& M,
                               const std::vector<int>& boundary, const std::vector<int>& zero,
                               const std::function<std::string(int)>& label, SparseSolver solver)
    : size_(static_cast<int>(K.rows())),
      solver_(solver),
      boundary_(boundary),
      factors_(SparseMatrix(0, 0)) {
  const std::size_t n = size_;
  std::vector<int> inner_of(n, 0);
  for (const int row : zero) inner_of[row] = -1;
  for (const int row : boundary) inner_of[row] = -1;
  for (std::size_t i = 0; i < n; ++i) {
    if (inner_of[i] < 0) continue;
    inner_of[i] = static_cast<int>(inner_.size());
    inner_.push_back(static_cast<int>(i));
  }
  Kii_ = select(K, inner_of, inner_.size(), inner_);
  Mii_ = select(M, inner_of, inner_.size(), inner_);
  Kib_ = select(K, inner_of, inner_.size(), boundary_);
  Kbb_ = pick(K, boundary, boundary);
  factors_ = SparseFactors(Kii_, solver);
  const int row = factors_.singular();
  if (row >= 0 || factors_.negative_pivots() > 0) {
    if (row < 0)
      throw InputError(ErrorCode::singular,
                       "the stiffness is not positive: an element or a matrix has negative energy");
    throw InputError(ErrorCode::singular,
                     fmt::format("the stiffness is singular: {} can move without resistance (a "
                                 "part that is not connected, or a mechanism)",
                                 label(inner_[row])));
  }
}

MatX FixedInterface::with_all_rows(const MatX& inner) const {
  MatX X = MatX::Zero(size_, inner.cols());
  X(inner_, Eigen::all) = inner;
  return X;
}

MatX FixedInterface::constraint_modes() const {
  MatX X = with_all_rows(factors_.solve(MatX(-Kib_)));
  for (std::size_t b = 0; b < boundary_.size(); ++b)
    X(boundary_[b], static_cast<Eigen::Index>(b)) = 1.0;
  return X;
}

MatX FixedInterface::guyan_stiffness(const MatX& X) const {
  const MatX inner = X(inner_, Eigen::all);
  const MatX K = MatX(Kbb_) + Kib_.transpose() * inner;
  return 0.5 * (K + K.transpose());
}

MatX FixedInterface::inner_response(const MatX& forces) const {
  return with_all_rows(factors_.solve(forces(inner_, Eigen::all)));
}

Eigenmodes inner_modes(int count, int inner, const std::function<Eigenmodes(int)>& solve,
                       bool at_most) {
  if (count < 0)
    throw InputError(ErrorCode::out_of_range, "the number of normal modes must not be negative");
  if (at_most) count = std::min(count, inner);
  if (count > inner) {
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("{} normal modes are requested, but only {} degrees of freedom "
                                 "are left inside the interface",
                                 count, inner));
  }
  Eigenmodes modes = solve(count);
  if (modes.omega.size() < count && !at_most) {
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format(
            "{} normal modes are requested, but the mass inside the interface allows only {}",
            count, modes.omega.size()));
  }
  return modes;
}

Eigenmodes FixedInterface::normal_modes(int count, bool at_most) const {
  Eigenmodes modes = inner_modes(
      count, inner(), [&](int n) { return lowest_modes(Kii_, factors_, Mii_, n); }, at_most);
  modes.shapes = with_all_rows(modes.shapes);
  return modes;
}

int FixedInterface::count_below(double frequency) const {
  return count_modes_below(Kii_, Mii_, omega_of(frequency), solver_);
}

}  // namespace floatframe

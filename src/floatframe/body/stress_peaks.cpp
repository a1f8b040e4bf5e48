#include "floatframe/body/stress_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {
namespace {

using Five = Eigen::Matrix<double, 5, Eigen::Dynamic>;

/// Instants at once: a row of them with its columns stays in the nearest cache.
constexpr Eigen::Index instants_of_a_block = 64;

/// (1) of columns of stress.
Five deviator_rows(const Eigen::Ref<const MatX>& s) {
  Five out(5, s.cols());
  out.row(0) = s.row(0) - 0.5 * (s.row(1) + s.row(2));
  out.row(1) = 0.5 * std::sqrt(3.0) * (s.row(1) - s.row(2));
  out.bottomRows<3>() = std::sqrt(3.0) * s.bottomRows<3>();
  return out;
}

/// An orthonormal basis of the columns, by Gram and Schmidt from the longest to the shortest. Each
/// column counts by its size beside `largest`; those of zero size do not.
Eigen::Matrix<double, 5, 5> basis_of(Five columns, const VecX& largest, int& rank) {
  constexpr double negligible = 1e-9;
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    columns.col(k) *= largest[k] > 0.0 ? 1.0 / largest[k] : 0.0;
  Eigen::Matrix<double, 5, 5> basis;
  for (rank = 0; rank < 5; ++rank) {
    Eigen::Index longest = 0;
    const double length = std::sqrt(columns.colwise().squaredNorm().maxCoeff(&longest));
    if (!(length > negligible)) break;
    Eigen::Vector<double, 5> q = columns.col(longest) / length;
    for (int j = 0; j < rank; ++j) q -= basis.col(j).dot(q) * basis.col(j);
    basis.col(rank) = q.normalized();
    const Eigen::RowVectorXd along = basis.col(rank).transpose() * columns;
    columns.noalias() -= basis.col(rank) * along;
  }
  return basis;
}

void raise(StressPeaks::Peak& peak, const VecX& squares, Eigen::Index before) {
  if (!(squares.maxCoeff() > peak.square)) return;
  Eigen::Index at = 0;
  peak.square = squares.maxCoeff(&at);
  peak.instant = before + at;
}

}  // namespace

StressPeaks::StressPeaks(const BodyStress& stress, const std::vector<int>& places, bool loads)
    : modes_(stress.modes.cols()), load_columns_(loads ? body_load_cases : 0) {
  const Eigen::Index n = modes_ + load_columns_;
  const auto five_of = [&](int place) {
    MatX both(6, n);
    both.leftCols(modes_) = stress.modes.middleRows<6>(6 * Eigen::Index{place});
    if (loads)
      both.rightCols(load_columns_) =
          stress.loads.block<6, body_load_cases>(6 * Eigen::Index{place}, 0);
    return deviator_rows(both);
  };
  VecX largest = VecX::Zero(n);
  for (const int place : places)
    largest = largest.cwiseMax(five_of(place).colwise().norm().transpose());
  rows_.resize(n, 5 * std::ssize(places));
  first_.push_back(0);
  for (const int place : places) add_place(five_of(place), largest);
  of_modes_.resize(places.size());
  if (loads) of_all_.resize(places.size());
}

void StressPeaks::add_place(const Five& columns, const VecX& largest) {
  int rank = 0;
  const Eigen::Matrix<double, 5, 5> basis = basis_of(columns, largest, rank);
  rows_.middleCols(first_.back(), rank).noalias() = columns.transpose() * basis.leftCols(rank);
  first_.push_back(first_.back() + rank);
}

void StressPeaks::add(const MatX& amplitudes, const MatX& coefficients) {
  MatX y, c, values;
  VecX squares;
  for (Eigen::Index from = 0; from < amplitudes.rows(); from += instants_of_a_block) {
    const Eigen::Index count = std::min(instants_of_a_block, amplitudes.rows() - from);
    y = amplitudes.middleRows(from, count);
    if (load_columns_ > 0) c = coefficients.middleRows(from, count);
    values.resize(count, 5);
    for (std::size_t p = 0; p < of_modes_.size(); ++p) {
      const int rank = first_[p + 1] - first_[p];
      if (rank == 0) continue;
      squares.setZero(count);
      for (int r = 0; r < rank; ++r) {
        values.col(r).noalias() = y * rows_.col(first_[p] + r).head(modes_);
        squares += values.col(r).cwiseAbs2();
      }
      raise(of_modes_[p], squares, instants_ + from);
      if (load_columns_ == 0) continue;
      squares.setZero();
      for (int r = 0; r < rank; ++r) {
        values.col(r).noalias() += c * rows_.col(first_[p] + r).tail(load_columns_);
        squares += values.col(r).cwiseAbs2();
      }
      raise(of_all_[p], squares, instants_ + from);
    }
  }
  instants_ += amplitudes.rows();
}

}  // namespace floatframe

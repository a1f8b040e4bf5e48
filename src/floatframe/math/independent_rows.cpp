#include "floatframe/math/independent_rows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <queue>

namespace floatframe {

class IndependentRows::Elimination {
 public:
  Elimination(IndependentRows& result, const SparseRowMatrix& A)
      : done_(result),
        A_(A),
        x_(VecX::Zero(A.cols())),
        met_(A.cols(), false),
        pivot_of_(A.cols(), -1),
        last_row_(A.cols(), -1),
        reached_by_(A.cols()) {
    for (int i = 0; i < A.rows(); ++i) {
      double square = 0.0;
      for (SparseRowMatrix::InnerIterator it(A, i); it; ++it) {
        last_row_[it.col()] = i;
        square += it.value() * it.value();
      }
      longest_ = std::max(longest_, std::sqrt(square));
    }
  }

  void take(int row, double threshold) {
    assert(row >= 0 && row < A_.rows() && threshold >= 0.0);
    const double length = A_.cols() > 0 ? A_.row(row).norm() : 0.0;
    if (!(length > nothing * longest_)) {
      done_.dependent_.push_back(row);
      return;
    }
    for (SparseRowMatrix::InnerIterator it(A_, row); it; ++it) {
      meet(it.col(), -1);
      x_[it.col()] = it.value() / length;
    }
    while (!waiting_.empty()) {
      const int k = waiting_.top();
      waiting_.pop();
      if (k != applied_) apply(k);
    }
    Column c{row, -1, 1.0 / length, 0.0, 0.0, {}, {}};
    double left = 0.0;
    for (const int i : touched_) {
      const int k = pivot_of_[i];
      if (std::abs(x_[i]) < rounding) continue;
      (k >= 0 ? c.R : c.v).push_back({k >= 0 ? k : i, x_[i]});
      if (k < 0) left += x_[i] * x_[i];
    }
    left = std::sqrt(left);
    if (left > threshold)
      keep(std::move(c), left);
    else
      done_.dependent_.push_back(row);
    forget();
  }

 private:
  /// Entries below it are negligible in rows of length 1.
  static constexpr double rounding = 1e-17;
  /// Rounding error of rows of zeros, relative to rows of length 1 or longer.
  static constexpr double nothing = 1e-14;

  /// An entry that was zero until reflection k: all later ones that affect it must be applied.
  void meet(int i, int k) {
    if (met_[i]) return;
    met_[i] = true;
    touched_.push_back(i);
    const std::vector<int>& all = reached_by_[i];
    for (auto it = all.rbegin(); it != all.rend() && *it > k; ++it) waiting_.push(*it);
  }

  void apply(int k) {
    assert(k > applied_ && k < done_.rank());
    const Column& c = done_.columns_[k];
    double product = 0.0;
    for (const Entry& e : c.v) product += e.value * x_[e.at];
    for (const Entry& e : c.v) {
      meet(e.at, k);
      x_[e.at] -= c.factor * product * e.value;
    }
    applied_ = k;
  }

  void keep(Column c, double left) {
    assert(left > 0.0 && !c.v.empty());
    std::size_t best = 0;
    const auto last = [&](const Entry& e) { return last_row_[e.at]; };
    for (std::size_t k = 1; k < c.v.size(); ++k)
      if (last(c.v[k]) < last(c.v[best])) best = k;
    Entry& pivot = c.v[best];
    c.pivot = pivot.at;
    c.diagonal = pivot.value > 0.0 ? -left : left;
    pivot.value -= c.diagonal;
    c.factor = 1.0 / (left * std::abs(pivot.value));  // 2 / v.v
    const int k = done_.columns_.size();
    for (const Entry& e : c.v) reached_by_[e.at].push_back(k);
    pivot_of_[c.pivot] = k;
    done_.columns_.push_back(std::move(c));
  }

  void forget() {
    for (const int i : touched_) {
      x_[i] = 0.0;
      met_[i] = false;
    }
    touched_.clear();
    applied_ = -1;
  }

  IndependentRows& done_;
  const SparseRowMatrix& A_;
  VecX x_;                                    ///< the row in work
  std::vector<bool> met_;                     ///< its nonzero entries
  std::vector<int> touched_;                  ///< the same as a list
  std::vector<int> pivot_of_;                 ///< for each unknown its column, -1 if it has none
  std::vector<int> last_row_;                 ///< that uses an unknown
  std::vector<std::vector<int>> reached_by_;  ///< for each unknown the reflections, ascending
  std::priority_queue<int, std::vector<int>, std::greater<>> waiting_;
  int applied_ = -1;
  double longest_ = 1.0;  ///< length of a row
};

IndependentRows::IndependentRows(const SparseRowMatrix& A, double threshold) : unknowns_(A.cols()) {
  Elimination elimination(*this, A);
  for (int i = 0; i < A.rows(); ++i) elimination.take(i, threshold);
}

VecX IndependentRows::least_norm(const VecX& b) const {
  assert(rank() == 0 || b.size() > columns_.back().row);
  // With Q = H_1 ... H_r: A^T P = Q R, so R^T z = P^T b and x = Q z.
  VecX z(rank()), x = VecX::Zero(unknowns_);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Column& c = columns_[k];
    double sum = b[c.row] * c.inverse_length;
    for (const Entry& e : c.R) sum -= e.value * z[e.at];
    z[k] = sum / c.diagonal;
    x[c.pivot] = z[k];
  }
  for (auto c = columns_.rbegin(); c != columns_.rend(); ++c) {
    double product = 0.0;
    for (const Entry& e : c->v) product += e.value * x[e.at];
    for (const Entry& e : c->v) x[e.at] -= c->factor * product * e.value;
  }
  return x;
}

}  // namespace floatframe

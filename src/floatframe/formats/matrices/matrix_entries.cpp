#include <algorithm>
#include <cmath>
#include <numeric>

#include "floatframe/formats/matrices/matrix_model.hpp"

namespace floatframe {
namespace {

// Supports of other programs: a spring of 1e30 or more in place of a fixed degree of freedom.
constexpr double penalty = 1e30;
// Halves of a symmetric matrix that were written with few digits.
constexpr double half_tolerance = 1e-9;

}  // namespace

void SymmetricEntries::add(int row, int column, double value, const FeSource& at) {
  file_ = at.file;
  last_ = std::max({last_, row, column});
  const bool upper = row <= column;
  entries_.push_back(
      {std::min(row, column), std::max(row, column), value, upper ? at.line : -at.line});
}

/// Ascending order; the second of two halves goes.
bool SymmetricEntries::check(const std::vector<std::string>& labels) {
  const auto before = [](const Entry& a, const Entry& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  };
  if (!std::is_sorted(entries_.begin(), entries_.end(), before))
    std::stable_sort(entries_.begin(), entries_.end(), before);
  double largest = 0.0;
  for (const Entry& e : entries_) largest = std::max(largest, std::abs(e.value));
  const std::size_t errors = source_.errors();
  const auto error = [&](ErrorCode code, const Entry& e, const std::string& text) {
    source_.error(code, {file_, std::abs(e.line)}, "the {} entry ({}, {}) {}", what_, labels[e.row],
                  labels[e.column], text);
  };
  std::size_t kept = 0;
  for (std::size_t k = 0; k < entries_.size();) {
    const Entry e = entries_[k++];
    for (int more = 0; k < entries_.size() && !before(e, entries_[k]); ++more, ++k) {
      const Entry& other = entries_[k];
      if (more > 0 || (e.line > 0) == (other.line > 0))
        error(ErrorCode::duplicate, other,
              fmt::format("is there already (line {})", std::abs(e.line)));
      else if (!(std::abs(e.value - other.value) <= half_tolerance * largest))
        error(ErrorCode::contradiction, other,
              fmt::format(
                  "is {:g}, but {:g} in the other half (line {}): the matrix is not symmetric",
                  other.value, e.value, std::abs(e.line)));
    }
    if (e.row == e.column && e.value < 0.0)
      error(ErrorCode::out_of_range, e,
            fmt::format("on the diagonal is {:g}, expected no negative value", e.value));
    if (e.row == e.column && e.value >= penalty)
      error(ErrorCode::unsupported, e,
            fmt::format("on the diagonal is {:g}, the penalty of a support: write the matrices "
                        "without supports",
                        e.value));
    entries_[kept++] = e;
  }
  entries_.resize(kept);
  return source_.errors() == errors;
}

SparseMatrix SymmetricEntries::finish(int n, const std::vector<std::string>& labels,
                                      bool whole_diagonal) {
  std::vector<int> all(whole_diagonal ? static_cast<std::size_t>(n) : 0);
  std::iota(all.begin(), all.end(), 0);
  return finish(n, labels, all);
}

SparseMatrix SymmetricEntries::finish(int n, const std::vector<std::string>& labels,
                                      const std::vector<int>& with_diagonal) {
  SparseMatrix full(n, n);
  if (!check(labels) || n == 0) return full;  // Eigen's compression reads beyond a matrix of size 0
  std::vector<char> there(n, 0);
  for (const Entry& e : entries_)
    if (e.row == e.column) there[e.row] = 1;
  const auto lacks = [&](int row) { return there[row] == 0; };
  const auto missing = std::ranges::find_if(with_diagonal, lacks);
  if (missing != with_diagonal.end()) {
    source_.error(ErrorCode::damaged,
                  "the {} ends without a diagonal entry for {} and {} more: the file is "
                  "truncated or does not belong to these degrees of freedom",
                  what_, labels[*missing], std::ranges::count_if(with_diagonal, lacks) - 1);
    return full;
  }
  Eigen::VectorXi count = Eigen::VectorXi::Zero(n);
  for (const Entry& e : entries_) {
    if (e.value == 0.0) continue;
    ++count[e.column];
    if (e.row != e.column) ++count[e.row];
  }
  full.reserve(count);
  // Column by column, rows ascending: the upper half of a column comes before its lower half.
  for (const Entry& e : entries_)
    if (e.value != 0.0) full.insert(e.row, e.column) = e.value;
  for (const Entry& e : entries_)
    if (e.value != 0.0 && e.row != e.column) full.insert(e.column, e.row) = e.value;
  full.makeCompressed();
  std::vector<Entry>().swap(entries_);
  return full;
}

}  // namespace floatframe

#pragma once
// Rows of numbers that begin with their time, all or the last ones (a ring), of a recording.
#include <algorithm>
#include <cstddef>
#include <vector>

namespace floatframe {

class RowStore {
 public:
  /// `keep`: number of rows at most; 0: all.
  RowStore(std::size_t columns, std::size_t keep) : columns_(columns), keep_(keep) {}

  std::size_t size() const noexcept { return size_; }
  const double* row(std::size_t k) const noexcept { return data_.data() + columns_ * place(k); }
  double last_time() const noexcept { return *row(size_ - 1); }

  /// The next row to be written; null: memory ran out. Allocates while it grows, and a ring until
  /// it is full.
  double* next() noexcept {
    if (keep_ > 0 && size_ == keep_) {
      first_ = (first_ + 1) % keep_;
    } else if (columns_ * (size_ + 1) > data_.size() && !grow()) {
      return nullptr;
    } else {
      ++size_;
    }
    return data_.data() + columns_ * place(size_ - 1);
  }

  void drop_after(double t) noexcept {
    while (size_ > 0 && last_time() > t) --size_;
  }
  void clear() noexcept { first_ = size_ = 0; }

  /// One after the other, in the order of time.
  std::vector<double> numbers() const {
    std::vector<double> all;
    all.reserve(size_ * columns_);
    for (std::size_t k = 0; k < size_; ++k) all.insert(all.end(), row(k), row(k) + columns_);
    return all;
  }

 private:
  static constexpr std::size_t first_rows = 64;

  std::size_t place(std::size_t k) const noexcept { return keep_ > 0 ? (first_ + k) % keep_ : k; }
  bool grow() noexcept {
    std::size_t rows = std::max(first_rows, 2 * size_);
    if (keep_ > 0) rows = std::min(rows, keep_);
    try {
      data_.resize(rows * columns_);
    } catch (...) {
      return false;
    }
    return true;
  }

  std::size_t columns_, keep_, first_ = 0, size_ = 0;
  std::vector<double> data_;
};

}  // namespace floatframe

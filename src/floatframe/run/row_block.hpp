#pragma once
// Output buffer for rows of a run: a small block of rows, which is handed over when it is full or
// old.
#include <algorithm>
#include <chrono>
#include <functional>
#include <span>
#include <vector>

#include "floatframe/run/result_table.hpp"

namespace floatframe {

class RowBlock {
 public:
  using Clock = std::chrono::steady_clock;
  using Sink = std::function<void(const std::vector<Column>&, std::span<const double>)>;

  RowBlock(const std::vector<Column>& columns, const Sink& sink)
      : columns_(columns), sink_(sink), rows_(std::max<std::size_t>(1, numbers / columns.size())) {
    data_.resize(rows_ * columns.size());
  }

  /// Position of the next row. Does not allocate.
  double* next() noexcept { return data_.data() + columns_.size() * used_++; }

  /// Removes the last row.
  void take_back() noexcept { --used_; }

  /// Between steps: true if the rows should be handed over now. The next steps are expected to take
  /// as long as the last one.
  bool due() noexcept {
    const Clock::time_point now = Clock::now();
    const Clock::duration step = now - looked_;
    looked_ = now;
    return used_ == rows_ || (used_ > 0 && now - handed_ + step >= oldest);
  }
  /// Throws the exceptions of the sink.
  void hand_over() {
    const std::size_t rows = used_;
    used_ = 0;
    handed_ = Clock::now();
    sink_(columns_, std::span<const double>(data_).first(rows * columns_.size()));
  }

 private:
  static constexpr std::size_t numbers = 8192;
  static constexpr std::chrono::milliseconds oldest{500};

  const std::vector<Column>& columns_;
  const Sink& sink_;
  std::size_t rows_, used_ = 0;
  std::vector<double> data_;
  Clock::time_point handed_ = Clock::now(), looked_ = handed_;
};

}  // namespace floatframe

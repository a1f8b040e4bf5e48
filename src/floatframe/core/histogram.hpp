#pragma once
// Counts of durations in bins of equal ratio, filled without allocation in a step. Each octave is
// divided into 32 equal parts: a bin is at most 1/32 (3 %) of its value wide; below 32 ns a bin is
// one nanosecond. Smallest, largest and mean value are exact.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "floatframe/core/thread_clock.hpp"

namespace floatframe {

class Histogram {
 public:
  static constexpr int part_bits = 5, parts = 1 << part_bits;
  static constexpr int octaves = 36;  ///< up to 2^40 ns, 18 minutes; longer ones go to the last bin
  static constexpr std::size_t bins = static_cast<std::size_t>(parts) * octaves;

  /// Negative durations count as zero.
  void add(Nanoseconds duration) noexcept {
    const std::uint64_t x = duration > 0 ? static_cast<std::uint64_t>(duration) : 0;
    ++counts_[bin_of(x)];
    if (count_ == 0 || x < smallest_) smallest_ = x;
    if (x > largest_) largest_ = x;
    sum_ += static_cast<double>(x);
    ++count_;
  }

  std::uint64_t count() const noexcept { return count_; }
  double min() const noexcept { return 1e-9 * static_cast<double>(smallest_); }  ///< [s]
  double max() const noexcept { return 1e-9 * static_cast<double>(largest_); }   ///< [s]
  double mean() const noexcept {                                                 ///< [s]
    return count_ > 0 ? 1e-9 * sum_ / static_cast<double>(count_) : 0.0;
  }

  /// Duration [s] that `fraction` (0 to 1) of all values do not exceed: the upper end of its bin,
  /// never above the largest value. 0 without values.
  double percentile(double fraction) const noexcept {
    if (count_ == 0) return 0.0;
    const double wanted = fraction * static_cast<double>(count_);
    std::uint64_t seen = 0;
    for (std::size_t k = 0; k < bins; ++k) {
      seen += counts_[k];
      if (seen > 0 && static_cast<double>(seen) >= wanted) return std::min(upper(k), max());
    }
    return max();
  }

  /// Number of values in bins entirely above `seconds`.
  std::uint64_t count_above(double seconds) const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t k = bins; k-- > 0 && lower(k) >= seconds;) sum += counts_[k];
    return sum;
  }

  std::uint64_t count(std::size_t bin) const noexcept { return counts_[bin]; }
  /// Ends of a bin [s]: it holds lower <= x < upper.
  static double lower(std::size_t bin) noexcept { return 1e-9 * static_cast<double>(start(bin)); }
  static double upper(std::size_t bin) noexcept {
    return 1e-9 * static_cast<double>(start(bin + 1));
  }

  /// Writes or reads the state; `holds` tells whether data read back is valid.
  template <class Stream>
  void serialize(Stream& s) {
    for (std::uint64_t& n : counts_) s(n);
    for (std::uint64_t* n : {&count_, &smallest_, &largest_}) s(*n);
    s(sum_);
  }
  bool holds(std::uint64_t values) const noexcept {
    std::uint64_t all = 0;
    for (const std::uint64_t n : counts_) {
      if (n > values) return false;
      all += n;
    }
    return all == values && count_ == values && smallest_ <= largest_ && sum_ >= 0.0 &&
           sum_ <= 1.001 * static_cast<double>(largest_) * static_cast<double>(values);
  }

  static std::size_t bin_of(std::uint64_t x) noexcept {
    if (x < parts) return x;
    const int shift = static_cast<int>(std::bit_width(x)) - 1 - part_bits;
    const std::size_t part = static_cast<std::size_t>(x >> shift) - parts;
    const std::size_t bin = static_cast<std::size_t>(shift + 1) * parts + part;
    return bin < bins ? bin : bins - 1;
  }

 private:
  static std::uint64_t start(std::size_t bin) noexcept {
    if (bin < parts) return bin;
    const std::size_t shift = bin / parts - 1;
    return (static_cast<std::uint64_t>(parts) + bin % parts) << shift;
  }

  std::array<std::uint64_t, bins> counts_{};
  std::uint64_t count_ = 0, smallest_ = 0, largest_ = 0;
  double sum_ = 0.0;
};

}  // namespace floatframe

#pragma once
// Differences of two results per channel, read row by row with memory for a few rows only.
#include <limits>
#include <string>
#include <vector>

#include "floatframe/results/results_reader.hpp"

namespace floatframe {

/// Two values agree if |a - b| <= absolute + relative * (largest magnitude of the channel in A).
struct ComparisonTolerance {
  double relative = 0.0;
  double absolute = 0.0;  ///< in the unit of each channel
};

struct ChannelDifference {
  std::string name, unit;
  double largest = 0.0;  ///< |a - b|; infinite where only one of them is a number
  double at = 0.0;       ///< instant of the largest difference [s]
  double rms = 0.0;      ///< over the instants at which both are numbers
  double size = 0.0;     ///< largest magnitude in A
  /// largest / size; zero if both are zero
  double relative() const noexcept {
    if (largest == 0.0) return 0.0;
    return size > 0.0 ? largest / size : std::numeric_limits<double>::infinity();
  }
};

struct ResultsComparison {
  std::vector<ChannelDifference> channels;  ///< in the order of A
  /// Names present in one result only, or with different units ("z [m] and z [mm]").
  std::vector<std::string> only_a, only_b, other_units;
  /// Common instants: if one result has all instants of the other in the common span, these; else
  /// all of A, with B interpolated linearly.
  std::size_t instants = 0;
  bool interpolated = false;
  double from = 0.0, to = 0.0;  ///< common span [s]
  double start_a = 0.0, start_b = 0.0, end_a = 0.0, end_b = 0.0;
  bool torn_a = false, torn_b = false;  ///< the last line is incomplete

  /// True if start or end differ by more than rounding.
  bool spans_differ() const noexcept;
  bool same_channels() const noexcept {
    return only_a.empty() && only_b.empty() && other_units.empty();
  }
};

bool agrees(const ChannelDifference& d, const ComparisonTolerance& tolerance) noexcept;

/// `names`: the channels to compare; empty: all. Throws InputError if a file cannot be read to its
/// end, has no rows, lacks a channel in `names`, or if the spans do not overlap.
ResultsComparison compare_results(ResultsReader& a, ResultsReader& b,
                                  const std::vector<std::string>& names = {});

}  // namespace floatframe

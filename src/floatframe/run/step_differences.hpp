#pragma once
// Differences of runs at the steps h, h/2 and h/4. For each output x:
//   D1 = max |x_h - x_h/2|,  D2 = max |x_h/2 - x_h/4|,  order p = log2(D1 / D2),
//   error of the run at h: e = D1 2^p / (2^p - 1)    (Richardson's extrapolation, x_h - x = C h^p)
// D1 and D2 of the order are over the instants common to all three runs, D1 of the error over those
// of the first two. A time of a crossing is not a number before, and one run may cross between two
// rows of the other: such outputs are compared where both have one, and in the last row. Source:
// P. J. Roache, Verification and Validation in Computational Science, 1998, chapter 5.
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "floatframe/run/results.hpp"

namespace floatframe {

/// The time of the next row of a run and its outputs; null at the end.
using NextRow = std::function<const double*()>;

/// The rows of a table.
NextRow rows_of(const ResultTable& table);

/// Differences of the outputs of three runs, accumulated row by row.
class StepDifferences {
 public:
  /// `run`: the rows of the run, `half`: those at half its step. Equal instants differ by less than
  /// `close` [s]. `latched`: of each output whether it is nan up to its only number; empty: none.
  StepDifferences(NextRow run, const ResultTable& half, double close,
                  std::vector<char> latched = {});
  /// Rows at a quarter of the step.
  void take(std::span<const double> rows);
  /// After the last row.
  Verification result();

 private:
  struct Gathered {
    double largest = 0.0, at = 0.0;    ///< D1 over the instants of two runs
    double first = 0.0, second = 0.0;  ///< D1 and D2 over those of three
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool latched = false;
    double missing = no_time, missing_second = no_time;  ///< since then one run has no number
  };
  static constexpr double no_time = std::numeric_limits<double>::infinity();
  void row(const double* quarter);
  static double difference(bool latched, double a, double b, double t, double& missing) noexcept;
  bool before(double a, double b) const noexcept { return a < b - close_; }

  NextRow run_;
  const ResultTable& half_;
  double close_;
  const double* now_;                        ///< row of the run
  std::size_t half_row_ = 0, of_three_ = 0;  ///< the latter: common instants
  std::vector<Gathered> outputs_;
  Verification found_;
};

/// Order and error of an output whose differences are known. `noise`: differences up to here are
/// rounding.
void estimate(VerifiedOutput& output, double noise) noexcept;

}  // namespace floatframe

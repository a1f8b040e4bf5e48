#pragma once
// Differences of runs at the steps h, h/2 and h/4. For each output x:
//   D1 = max |x_h - x_h/2|,  D2 = max |x_h/2 - x_h/4|,  order p = log2(D1 / D2),
//   error of the run at h: e = D1 2^p / (2^p - 1)    (Richardson's extrapolation, x_h - x = C h^p)
// D1 and D2 of the order are over the instants common to all three runs, D1 of the error over those
// of the first two. Source: P. J. Roache, Verification and Validation in Computational Science,
// 1998, chapter 5.
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
  /// `close` [s].
  StepDifferences(NextRow run, const ResultTable& half, double close);
  /// Rows at a quarter of the step.
  void take(std::span<const double> rows);
  /// After the last row.
  Verification result();

 private:
  struct Gathered {
    double largest = 0.0, at = 0.0;    ///< D1 over the instants of two runs
    double first = 0.0, second = 0.0;  ///< D1 and D2 over those of three
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };
  void row(const double* quarter);
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

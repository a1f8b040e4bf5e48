#pragma once
// One row of the table of a study: titles and values as text, so that a row read back from the
// journal is identical to the byte.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/run/results.hpp"
#include "floatframe/sweep/sweep_measure.hpp"

namespace floatframe {

struct SweepRow {
  std::string status;                                       ///< "completed" or "failed"
  std::string message;                                      ///< reason of the failure
  std::vector<std::pair<std::string, std::string>> fields;  ///< column title, value
  /// Range warnings of the run; not in the table.
  std::vector<RangeWarning> warnings = {};
};

/// Summary figures of a run, and of the outputs in `measures` (all if empty): last, smallest and
/// largest sample and their times, and the root of the mean square over time (trapezoidal rule
/// between samples). Excludes processor times.
SweepRow sweep_row(const RunResult& result, const std::vector<SweepMeasure>& measures);

/// Marks a run with warnings that count as errors as failed; its figures are complete.
void make_strict(SweepRow& row);

/// Row of a run that could not start.
SweepRow failed_row(const std::string& message);

/// The table as CSV: run (from 1), varied parameters, status, message, then all titles that occur
/// in any row, in order of first appearance; empty where a row has no such figure.
std::string sweep_csv(const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& values,
                      const std::vector<SweepRow>& rows);

}  // namespace floatframe

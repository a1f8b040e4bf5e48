#pragma once
// One row of the table of a study: titles and values as text, so that a row read back from the
// journal is the same to the byte.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/simulation/results.hpp"
#include "floatframe/sweep/sweep_measure.hpp"

namespace floatframe {

struct SweepRow {
  std::string status;                                       ///< "completed" or "failed"
  std::string message;                                      ///< why it failed
  std::vector<std::pair<std::string, std::string>> fields;  ///< column title, value
  /// Where the run left the range of the method; not in the table.
  std::vector<RangeWarning> warnings = {};
};

/// Summary figures of a run, and of its outputs those measured (all if `measures` is empty): last,
/// smallest and largest sample and their times, and the root of the mean square over time
/// (trapezoidal rule between samples). Holds no processor times.
SweepRow sweep_row(const RunResult& result, const std::vector<SweepMeasure>& measures);

/// A run whose warnings count as errors has failed; its figures are complete.
void make_strict(SweepRow& row);

/// A run that could not start.
SweepRow failed_row(const std::string& message);

/// The table as CSV: run (from 1), varied parameters, status, message, then all titles that occur
/// in any row, in the order of their first appearance; empty where a row has no such figure.
std::string sweep_csv(const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& values,
                      const std::vector<SweepRow>& rows);

}  // namespace floatframe

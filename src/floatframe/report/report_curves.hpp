#pragma once
// What a report shows of the rows of a run: some points of each curve, smallest and largest values.
// It needs memory for the points it shows, not for the rows, which may be read from a file as long
// as the run was.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "floatframe/simulation/result_table.hpp"

namespace floatframe {

class ResultsReader;

struct CurvePoint {
  double time = 0.0, value = 0.0;
};

struct ColumnExtremes {
  CurvePoint smallest, largest, last;
  /// Of the finite values; low > high: there are none.
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

struct ReportCurves {
  std::vector<Column> columns;
  std::size_t rows = 0;
  std::vector<ColumnExtremes> extremes;  ///< of every column
  /// Of every column but time: all rows, or if those are too many the first, the last, and of equal
  /// stretches of rows the smallest and the largest value, so that peaks survive. Values that are
  /// not finite count as neither.
  std::vector<std::vector<CurvePoint>> points;
};

inline constexpr std::size_t max_points_per_curve = 2000;

ReportCurves report_curves(const ResultTable& table);

/// The same of the first rows of a file that `results_csv` or ResultsFile has written: equal to the
/// bit. Throws OutputError if they are not there.
ReportCurves report_curves(const std::string& file, const std::vector<Column>& columns,
                           std::size_t rows);

/// The same of the next rows of a file; there must be as many. Throws InputError.
ReportCurves report_curves(ResultsReader& in, std::size_t rows);

}  // namespace floatframe

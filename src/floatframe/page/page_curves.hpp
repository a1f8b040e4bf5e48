#pragma once
// The curves of a page: all rows of all columns at common instants, or if those are too many the
// smallest and the largest value of each column in equal stretches of rows, so that peaks are kept.
// Memory use depends on the curves shown, not on the number of rows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/page/page_writer.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

class ResultsReader;

/// Subject of a column, for the grouping of curves.
struct ChannelSubject {
  std::string body;  ///< name of a body, joint, rod or force; empty: none
  std::string kind;  ///< "position", "joint_force", ...
};

struct PageCurves {
  std::vector<Column> columns;              ///< the first is the time
  std::size_t rows = 0;                     ///< of the results
  std::vector<double> time;                 ///< of the instants shown [s]
  std::vector<std::vector<double>> values;  ///< of every column but the time, at these instants
  bool thinned() const noexcept { return time.size() < rows; }
};

/// From the smallest to the largest finite value.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool known() const noexcept { return low <= high; }
  double range() const noexcept { return high > low ? high - low : 0.0; }
  /// 0: there is none.
  double size() const noexcept { return known() ? std::max(std::abs(low), std::abs(high)) : 0.0; }
  bool constant() const noexcept { return known() && range() <= 1e-9 * size(); }
};
Extent extent_of(const std::vector<double>& values);

/// Limit of numbers on a page.
inline constexpr std::size_t most_numbers_of_curves = 1'000'000;
/// Limit of instants of a curve, even for few curves: ten per pixel of a wide screen.
inline constexpr std::size_t most_instants_of_curves = 50'000;

/// Of rows that `read` writes in sequence, time first.
PageCurves page_curves(const std::vector<Column>& columns, std::size_t rows,
                       std::size_t most_numbers,
                       const std::function<void(std::size_t row, double* out)>& read);
PageCurves page_curves(const ResultTable& table);
/// Of the next rows of a file, which must have that many. Throws InputError.
PageCurves page_curves(ResultsReader& in, std::size_t rows);

/// The "curves" of a page: {"time", "channels": [...]}. Columns that are constant, or rounding
/// noise compared with others of the same unit, are marked. `subjects`: for each column but the
/// time, or empty.
nlohmann::ordered_json curves_json(const PageCurves& curves,
                                   const std::vector<ChannelSubject>& subjects, PageBuffer& buffer);

}  // namespace floatframe

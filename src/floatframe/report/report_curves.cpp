#include "floatframe/report/report_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "floatframe/core/output_error.hpp"
#include "floatframe/report/results_reader.hpp"

namespace floatframe {
namespace {

/// Takes the rows one after the other.
class CurveCollector {
 public:
  CurveCollector(const std::vector<Column>& columns, std::size_t rows)
      : stretches_(rows <= max_points_per_curve ? 0 : (max_points_per_curve - 2) / 2),
        end_(end_of(0, rows)),
        extremes_of_stretch_(columns.size()) {
    out_.columns = columns;
    out_.rows = rows;
    out_.extremes.resize(columns.size());
    out_.points.resize(columns.size());
    for (std::size_t c = 1; c < columns.size(); ++c)
      out_.points[c].reserve(std::min(rows, max_points_per_curve));
  }

  void add(const double* row) {
    const bool inner = stretches_ > 0 && row_ > 0 && row_ + 1 < out_.rows;
    for (std::size_t c = 0; c < out_.columns.size(); ++c) {
      const CurvePoint p{row[0], row[c]};
      extend(out_.extremes[c], p);
      if (c == 0) continue;
      if (inner)
        draw(c, p);
      else
        out_.points[c].push_back(p);
    }
    ++row_;
    if (!inner || row_ < end_) return;
    begin_ = end_;
    end_ = end_of(++stretch_, out_.rows);
  }

  ReportCurves take() { return std::move(out_); }

 private:
  struct Extremes {
    CurvePoint smallest, largest;
    std::size_t smallest_row = 0, largest_row = 0;
  };

  /// One row behind the last of a stretch; the first and the last row are in none.
  std::size_t end_of(std::size_t stretch, std::size_t rows) const noexcept {
    return stretches_ > 0 ? 1 + (stretch + 1) * (rows - 2) / stretches_ : 0;
  }

  void extend(ColumnExtremes& e, const CurvePoint& p) const {
    if (row_ == 0) e.smallest = e.largest = p;
    e.last = p;
    if (!std::isfinite(p.value)) return;
    if (!(e.smallest.value <= p.value)) e.smallest = p;
    if (!(e.largest.value >= p.value)) e.largest = p;
    e.low = std::min(e.low, p.value);
    e.high = std::max(e.high, p.value);
  }

  void draw(std::size_t c, const CurvePoint& p) {
    Extremes& e = extremes_of_stretch_[c];
    if (row_ == begin_) e = {p, p, row_, row_};
    if (std::isfinite(p.value)) {
      if (!(e.smallest.value <= p.value)) {
        e.smallest = p;
        e.smallest_row = row_;
      }
      if (!(e.largest.value >= p.value)) {
        e.largest = p;
        e.largest_row = row_;
      }
    }
    if (row_ + 1 < end_) return;
    const bool falls = e.largest_row < e.smallest_row;
    std::vector<CurvePoint>& points = out_.points[c];
    points.push_back(falls ? e.largest : e.smallest);
    if (e.smallest_row != e.largest_row) points.push_back(falls ? e.smallest : e.largest);
  }

  ReportCurves out_;
  std::size_t stretches_, row_ = 0;
  /// Of the present stretch: the rows it goes over, its number.
  std::size_t begin_ = 1, end_, stretch_ = 0;
  std::vector<Extremes> extremes_of_stretch_;
};

}  // namespace

ReportCurves report_curves(const ResultTable& table) {
  CurveCollector collector(table.columns, table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row)
    collector.add(table.data.data() + row * table.columns.size());
  return collector.take();
}

ReportCurves report_curves(const std::string& file, const std::vector<Column>& columns,
                           std::size_t rows) {
  CurveCollector collector(columns, rows);
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::vector<double> row(columns.size());
  static_cast<void>(std::getline(in, line));  // the header
  std::size_t column = 0, at = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!std::getline(in, line) || !read_numbers(line, row, column, at))
      throw OutputError(fmt::format(
          "the file '{}' cannot be read back: row {} is not as it was written", file, k + 1));
    collector.add(row.data());
  }
  return collector.take();
}

ReportCurves report_curves(ResultsReader& in, std::size_t rows) {
  CurveCollector collector(in.columns(), rows);
  for (std::size_t k = 0; k < rows && in.next(); ++k) collector.add(in.row().data());
  return collector.take();
}

}  // namespace floatframe

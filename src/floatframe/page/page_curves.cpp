#include "floatframe/page/page_curves.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "floatframe/results/results_reader.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

/// Collects the rows in sequence.
class Collector {
 public:
  Collector(const std::vector<Column>& columns, std::size_t rows,
            std::size_t most_numbers = most_numbers_of_curves) {
    out_.columns = columns;
    out_.rows = rows;
    const std::size_t channels = columns.empty() ? 0 : columns.size() - 1;
    const std::size_t most = std::clamp<std::size_t>(
        most_numbers / std::max<std::size_t>(channels, 1), 200, most_instants_of_curves);
    stretches_ = rows <= most ? 0 : (most - 2) / 2;
    out_.values.resize(channels);
    for (auto& v : out_.values) v.reserve(std::min(rows, most));
    low_.resize(channels);
    high_.resize(channels);
    end_ = end_of(0);
  }

  void add(const double* row) {
    const bool inner = stretches_ > 0 && row_ > 0 && row_ + 1 < out_.rows;
    if (inner) {
      gather(row);
    } else {
      out_.time.push_back(row[0]);
      for (std::size_t c = 0; c < out_.values.size(); ++c) out_.values[c].push_back(row[c + 1]);
    }
    ++row_;
    if (!inner || row_ < end_) return;
    write_stretch(row[0]);
    begin_ = end_;
    end_ = end_of(++stretch_);
  }

  PageCurves take() { return std::move(out_); }

 private:
  struct Extreme {
    double value = 0.0;
    std::size_t row = 0;
  };

  /// One row past the last of a stretch; the first and the last row are in none.
  std::size_t end_of(std::size_t stretch) const noexcept {
    return stretches_ > 0 ? 1 + (stretch + 1) * (out_.rows - 2) / stretches_ : 0;
  }

  void gather(const double* row) noexcept {
    if (row_ == begin_) first_time_ = row[0];
    for (std::size_t c = 0; c < out_.values.size(); ++c) {
      const double v = row[c + 1];
      if (row_ == begin_) low_[c] = high_[c] = {v, row_};
      if (!std::isfinite(v)) continue;
      if (!(low_[c].value <= v)) low_[c] = {v, row_};
      if (!(high_[c].value >= v)) high_[c] = {v, row_};
    }
  }

  /// Two instants, at a quarter and three quarters of the stretch.
  void write_stretch(double last_time) {
    for (const double part : {0.25, 0.75})
      out_.time.push_back(first_time_ + part * (last_time - first_time_));
    for (std::size_t c = 0; c < out_.values.size(); ++c) {
      const bool falls = high_[c].row < low_[c].row;
      out_.values[c].push_back(falls ? high_[c].value : low_[c].value);
      out_.values[c].push_back(falls ? low_[c].value : high_[c].value);
    }
  }

  PageCurves out_;
  std::size_t stretches_ = 0, row_ = 0, begin_ = 1, end_ = 0, stretch_ = 0;
  double first_time_ = 0.0;
  std::vector<Extreme> low_, high_;
};

}  // namespace

Extent extent_of(const std::vector<double>& values) {
  Extent e;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    e.low = std::min(e.low, v);
    e.high = std::max(e.high, v);
  }
  return e;
}

PageCurves page_curves(const std::vector<Column>& columns, std::size_t rows,
                       std::size_t most_numbers,
                       const std::function<void(std::size_t, double*)>& read) {
  Collector collector(columns, rows, most_numbers);
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < rows; ++k) {
    read(k, row.data());
    collector.add(row.data());
  }
  return collector.take();
}

PageCurves page_curves(const ResultTable& table) {
  Collector collector(table.columns, table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row)
    collector.add(table.data.data() + row * table.columns.size());
  return collector.take();
}

PageCurves page_curves(ResultsReader& in, std::size_t rows) {
  Collector collector(in.columns(), rows);
  for (std::size_t k = 0; k < rows && in.next(); ++k) collector.add(in.row().data());
  return collector.take();
}

Json curves_json(const PageCurves& curves, const std::vector<ChannelSubject>& subjects,
                 PageBuffer& buffer) {
  // Rounding level of a run, relative to the largest values of the same unit.
  constexpr double rounding = 1e-8;
  std::vector<Extent> extents;
  std::map<std::string, double> largest;  // by unit
  for (std::size_t c = 0; c < curves.values.size(); ++c) {
    extents.push_back(extent_of(curves.values[c]));
    double& size = largest[curves.columns[c + 1].unit];
    size = std::max(size, extents.back().size());
  }
  Json channels = Json::array();
  std::vector<float> shifted;
  for (std::size_t c = 0; c < curves.values.size(); ++c) {
    const Column& column = curves.columns[c + 1];
    const Extent& e = extents[c];
    const double offset = e.known() ? 0.5 * (e.low + e.high) : 0.0;
    shifted.clear();
    for (const double v : curves.values[c]) shifted.push_back(static_cast<float>(v - offset));
    channels.push_back(
        {{"name", column.name},
         {"label", column.name},
         {"unit", column.unit},
         {"body",
          c < subjects.size() && !subjects[c].body.empty() ? Json(subjects[c].body) : Json()},
         {"kind", c < subjects.size() ? Json(subjects[c].kind) : Json()},
         {"data", buffer.add(std::span<const float>(shifted), {shifted.size()})},
         {"offset", offset},
         {"constant", e.constant()},
         {"noise", e.size() > 0.0 && e.size() <= rounding * largest[column.unit]}});
  }
  return {{"time", buffer.add(std::span<const double>(curves.time), {curves.time.size()})},
          {"rows", curves.rows},
          {"thinned", curves.thinned()},
          {"channels", channels}};
}

}  // namespace floatframe

#include "floatframe/sweep/sweep_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

std::string all_digits(double x) { return fmt::format("{:.17g}", x); }

struct Figures {
  double last = 0, min = 0, time_of_min = 0, max = 0, time_of_max = 0, rms = 0;
};

Figures figures_of(const ResultTable& table, std::size_t column) {
  Figures f;
  double integral = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.at(row, 0), x = table.at(row, column);
    if (row == 0 || x < f.min || std::isnan(f.min)) f.min = x, f.time_of_min = t;
    if (row == 0 || x > f.max || std::isnan(f.max)) f.max = x, f.time_of_max = t;
    if (row > 0) {
      const double before = table.at(row - 1, column);
      integral += 0.5 * (t - table.at(row - 1, 0)) * (before * before + x * x);
    }
    f.last = x;
  }
  const double span = table.rows() > 1 ? table.at(table.rows() - 1, 0) - table.at(0, 0) : 0.0;
  f.rms = span > 0.0 ? std::sqrt(integral / span) : std::abs(f.last);
  return f;
}

bool wanted(const std::vector<SweepMeasure>& measures, const std::string& output,
            const std::string& statistic) {
  if (measures.empty()) return true;
  return std::any_of(measures.begin(), measures.end(), [&](const SweepMeasure& m) {
    return m.output == output && (m.statistic.empty() || m.statistic == statistic);
  });
}

}  // namespace

SweepMeasure sweep_measure(const std::string& text, const std::string& option) {
  const std::size_t colon = text.rfind(':');
  SweepMeasure m{text.substr(0, colon), ""};
  if (colon != std::string::npos) m.statistic = text.substr(colon + 1);
  const bool known = colon == std::string::npos ||
                     std::find(sweep_statistics.begin(), sweep_statistics.end(), m.statistic) !=
                         sweep_statistics.end();
  if (!known || m.output.empty())
    throw InputError(
        ErrorCode::wrong_value,
        fmt::format("{}: found '{}', expected the name of an output, or name:statistic with {}{}",
                    option, text, fmt::join(sweep_statistics, ", "),
                    known ? "" : did_you_mean(m.statistic, sweep_statistics)));
  return m;
}

SweepRanking sweep_ranking(const std::string& option, const std::string& text, bool largest) {
  SweepRanking ranking{sweep_measure(text, option), largest};
  if (ranking.measure.statistic.empty())
    throw InputError(ErrorCode::missing,
                     fmt::format("{}: found '{}' without a statistic, expected one of {}", option,
                                 text, fmt::join(sweep_statistics, ", ")));
  return ranking;
}

SweepRow sweep_row(const RunResult& result, const std::vector<SweepMeasure>& measures) {
  const RunSummary& s = result.summary;
  SweepRow row{s.status, s.message, {}, s.warnings};
  const auto add = [&](std::string title, std::string value) {
    row.fields.emplace_back(std::move(title), std::move(value));
  };
  add("time reached [s]", all_digits(s.duration));
  add("steps", std::to_string(s.steps));
  add("substeps", std::to_string(s.substeps));
  add("iterations", std::to_string(s.iterations));
  add("factorizations", std::to_string(s.factorizations));
  add("max position violation [m]", all_digits(s.max_position_violation));
  add("max velocity violation [m/s]", all_digits(s.max_velocity_violation));
  const EnergySummary& e = s.energy;
  add("kinetic start [J]", all_digits(e.kinetic_start));
  add("potential start [J]", all_digits(e.potential_start));
  add("elastic start [J]", all_digits(e.elastic_start));
  add("total start [J]", all_digits(e.total_start));
  add("kinetic end [J]", all_digits(e.kinetic_end));
  add("potential end [J]", all_digits(e.potential_end));
  add("elastic end [J]", all_digits(e.elastic_end));
  add("total end [J]", all_digits(e.total_end));
  for (std::size_t c = 1; c < result.table.columns.size(); ++c) {
    const Column& column = result.table.columns[c];
    if (result.table.rows() == 0) continue;
    const Figures f = figures_of(result.table, c);
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    const auto add_figure = [&](const char* statistic, const char* words, double value,
                                const std::string& its_unit) {
      if (wanted(measures, column.name, statistic))
        add(column.name + " " + words + its_unit, all_digits(value));
    };
    add_figure("final", "final", f.last, unit);
    add_figure("min", "min", f.min, unit);
    add_figure("time_of_min", "time of min", f.time_of_min, " [s]");
    add_figure("max", "max", f.max, unit);
    add_figure("time_of_max", "time of max", f.time_of_max, " [s]");
    add_figure("rms", "rms", f.rms, unit);
  }
  return row;
}

void make_strict(SweepRow& row) {
  if (row.status != "completed" || row.warnings.empty()) return;
  row.status = "failed";
  row.message = row.warnings.front().sentence;
  if (row.warnings.size() > 1)
    row.message += fmt::format(" (and {} more)", row.warnings.size() - 1);
}

SweepRow failed_row(const std::string& message) { return {"failed", message, {}}; }

std::string sweep_csv(const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& values,
                      const std::vector<SweepRow>& rows) {
  std::vector<std::string> titles;
  std::map<std::string, std::size_t> column;
  for (const SweepRow& row : rows)
    for (const auto& [title, value] : row.fields)
      if (column.emplace(title, titles.size()).second) titles.push_back(title);
  std::string text = "run";
  for (const std::string& name : names) text += ',' + csv_field(name);
  text += ",status,message";
  for (const std::string& title : titles) text += ',' + csv_field(title);
  text += '\n';
  std::vector<const std::string*> cells(titles.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += std::to_string(r + 1);
    for (const std::string& value : values[r]) text += ',' + csv_field(value);
    text += ',' + csv_field(rows[r].status) + ',' + csv_field(rows[r].message);
    std::fill(cells.begin(), cells.end(), nullptr);
    for (const auto& [title, value] : rows[r].fields) cells[column.at(title)] = &value;
    for (const std::string* cell : cells) {
      text += ',';
      if (cell) text += *cell;
    }
    text += '\n';
  }
  return text;
}

}  // namespace floatframe

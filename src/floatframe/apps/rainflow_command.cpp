// floatframe rainflow: range pairs of channels of a run, and the damage-equivalent ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "floatframe/apps/commands.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/math/rainflow.hpp"
#include "floatframe/results/results_reader.hpp"

namespace floatframe {
namespace {

struct RainflowArguments {
  std::string result, out;
  bool overwrite = false;
  std::vector<std::string> channels;
  double slope = 5.0, cycles = 2e6;
  int bins = 64;
};

struct CountedChannel {
  Column column;
  std::vector<double> values;
  std::vector<RainflowCycle> cycles;
};

/// Indices of the selected columns; all but the time if none is selected.
std::vector<std::size_t> chosen(const ResultsReader& reader,
                                const std::vector<std::string>& channels) {
  std::vector<std::size_t> out;
  std::vector<std::string> names;
  for (std::size_t k = 1; k < reader.columns().size(); ++k) {
    names.push_back(reader.columns()[k].name);
    if (channels.empty()) out.push_back(k);
  }
  for (const std::string& channel : channels) {
    const auto it = std::find(names.begin(), names.end(), channel);
    if (it == names.end())
      throw InputError(ErrorCode::not_found, {reader.file(), 0, 0},
                       "unknown channel '" + channel + "'" + did_you_mean(channel, names));
    out.push_back(1 + static_cast<std::size_t>(it - names.begin()));
  }
  return out;
}

std::string cycles_csv(const CountedChannel& c, const std::vector<double>& time) {
  const std::string& unit = c.column.unit;
  std::string text = fmt::format("range [{0}],mean [{0}],count [-],begin [s],end [s]\n",
                                 unit.empty() ? "-" : unit);
  for (const RainflowCycle& cycle : c.cycles)
    text += fmt::format("{},{},{},{},{}\n", cycle.range, cycle.mean, cycle.count, time[cycle.begin],
                        time[cycle.end]);
  return text;
}

/// Counts of ranges in equal classes.
std::string ranges_csv(const CountedChannel& c, int bins) {
  double largest = 0.0;
  for (const RainflowCycle& cycle : c.cycles) largest = std::max(largest, cycle.range);
  std::vector<double> counts(static_cast<std::size_t>(bins), 0.0);
  for (const RainflowCycle& cycle : c.cycles) {
    const auto bin = static_cast<std::size_t>(cycle.range / largest * bins);
    counts[std::min(bin, counts.size() - 1)] += cycle.count;
  }
  const std::string unit = c.column.unit.empty() ? "-" : c.column.unit;
  std::string text = fmt::format("range from [{0}],range to [{0}],count [-]\n", unit);
  for (std::size_t k = 0; k < counts.size(); ++k)
    text += fmt::format("{},{},{}\n", largest * static_cast<double>(k) / bins,
                        largest * static_cast<double>(k + 1) / bins, counts[k]);
  return text;
}

std::string history_csv(const CountedChannel& c, const std::vector<double>& time) {
  std::string text = fmt::format("time [s],{}\n", csv_title(c.column.name, c.column.unit));
  for (std::size_t k = 0; k < time.size(); ++k)
    text += fmt::format("{},{}\n", time[k], c.values[k]);
  return text;
}

double cycles_in(const CountedChannel& c) {
  double sum = 0.0;
  for (const RainflowCycle& cycle : c.cycles) sum += cycle.count;
  return sum;
}

double largest_range(const CountedChannel& c) {
  double out = 0.0;
  for (const RainflowCycle& cycle : c.cycles) out = std::max(out, cycle.range);
  return out;
}

/// Checks that files of different channels have different names.
std::vector<std::string> file_names(const std::vector<CountedChannel>& channels) {
  std::vector<std::string> out;
  std::map<std::string, int> taken;
  for (const CountedChannel& c : channels) {
    std::string name = file_name_from(c.column.name);
    const int before = taken[name]++;
    out.push_back(before == 0 ? name : fmt::format("{}_{}", name, before + 1));
  }
  return out;
}

void write_files(const RainflowArguments& a, const std::vector<CountedChannel>& channels,
                 const std::vector<double>& time) {
  require_folder(a.out);
  const std::filesystem::path folder = a.out;
  const std::vector<std::string> names = file_names(channels);
  std::vector<OutputFile> outputs{{"--out", (folder / "equivalent.csv").string()}};
  for (const std::string& name : names)
    for (const char* kind : {".cycles.csv", ".ranges.csv", ".history.csv"})
      outputs.push_back({"--out", (folder / (name + kind)).string()});
  require_writable(outputs, {results_file(a.result)}, a.overwrite);
  std::string equivalent =
      "channel,unit,turning points,cycles,largest range,slope,reference cycles,equivalent range\n";
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const CountedChannel& c = channels[k];
    write_file((folder / (names[k] + ".cycles.csv")).string(), cycles_csv(c, time));
    write_file((folder / (names[k] + ".ranges.csv")).string(), ranges_csv(c, a.bins));
    write_file((folder / (names[k] + ".history.csv")).string(), history_csv(c, time));
    equivalent +=
        fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(c.column.name), csv_field(c.column.unit),
                    turning_points(c.values).size(), cycles_in(c), largest_range(c), a.slope,
                    a.cycles, equivalent_range(c.cycles, a.slope, a.cycles));
  }
  write_file((folder / "equivalent.csv").string(), equivalent);
}

int rainflow_of(const RainflowArguments& a) {
  const std::string file = results_file(a.result);
  ResultsReader reader(file);
  std::vector<CountedChannel> channels;
  if (reader.columns().size() < 2)
    throw InputError(ErrorCode::missing, {file, 1, 0},
                     "found no channel but the time, expected one to count");
  const std::vector<std::size_t> columns = chosen(reader, a.channels);
  for (const std::size_t k : columns) channels.push_back({reader.columns()[k], {}, {}});
  std::vector<double> time;
  while (reader.next()) {
    time.push_back(reader.time());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double value = reader.row()[columns[k]];
      if (!std::isfinite(value))
        throw InputError(ErrorCode::not_finite, {file, static_cast<int>(reader.rows()) + 1, 0},
                         fmt::format("channel '{}': found {} at {} s, expected a finite number",
                                     channels[k].column.name, value, reader.time()));
      channels[k].values.push_back(value);
    }
  }
  if (time.empty())
    throw InputError(ErrorCode::missing, {file, 0, 0},
                     "found no rows, expected a history to count");
  TextTable table({"channel", "unit", "cycles", "largest range", "equivalent range"});
  for (CountedChannel& c : channels) {
    c.cycles = rainflow(c.values);
    table.add({c.column.name, c.column.unit, fmt::format("{:g}", cycles_in(c)),
               fmt::format("{:.6g}", largest_range(c)),
               fmt::format("{:.6g}", equivalent_range(c.cycles, a.slope, a.cycles))});
  }
  if (!a.out.empty()) write_files(a, channels, time);
  print(fmt::format("{}: {} s, {} rows; equivalent range of {:g} cycles with slope {:g}\n\n{}",
                    file, time.back() - time.front(), time.size(), a.cycles, a.slope,
                    table.text(2)));
  return exit_code::done;
}

}  // namespace

Command rainflow_command() {
  const auto a = std::make_shared<RainflowArguments>();
  return {
      .name = "rainflow",
      .help = "Count the range pairs of channels of a run (ASTM E1049), for fatigue",
      .options = {file_position("RESULT", a->result,
                                "results.csv of a run, or the folder that holds it"),
                  repeated_option("--channel", a->channels, "NAME",
                                  "Count this channel only (repeatable); default: all"),
                  number_option("--slope", a->slope, 1.0, 50.0, "M",
                                "Slope of the S-N curve that the equivalent range is for"),
                  number_option("--cycles", a->cycles, 1.0, 1e15, "N",
                                "Cycles of the equivalent range"),
                  whole_option("--bins", a->bins, 1, 100000, "Classes of the ranges in the files"),
                  text_option("--out", a->out, "DIR",
                              "Folder for CSV files: of each channel its cycles, its classes and "
                              "its history, and the equivalent ranges"),
                  overwrite_option(a->overwrite)},
      .footer =
          "Damage: (sum n_i range_i^M / N)^(1/M) over cycles and half cycles. Gauges are outputs "
          "of\n"
          "the model (stress, strain); floatframe outputs finds them from the states of a run.\n"
          "Exit codes: 0 done, 2 bad input.",
      .run = [a] { return rainflow_of(*a); }};
}

}  // namespace floatframe

#pragma once
// The runs of a parameter study: names, and for each run one value per name, as text that is
// checked later by the model file's rules for values.
#include <cstddef>
#include <string>
#include <vector>

namespace floatframe {

/// A value for all runs or for one: of a parameter of the model file or, if the file has none of
/// that name (or the name is written "simulation.step"), of a simulation option.
struct SweepSetting {
  std::string name, value;
};

struct SweepPlan {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> runs;  ///< one value per name
  /// Origin of the values, for messages: "--vary" or "runs.csv:3" (one entry per run, or empty).
  std::vector<std::string> origins;
};

inline constexpr std::size_t most_sweep_runs = 1000000;

/// All combinations of the variations; the last one changes fastest. A variation is
///   name=lo:hi:n       n values from lo to hi, both included, at equal distances
///   name=lo:hi:n:log   the same at equal ratios (lo and hi of one sign)
///   name=a,b,c         the values listed: numbers, true, false or texts
/// Throws InputError.
SweepPlan grid_plan(const std::vector<std::string>& variations);

/// One run per row of a CSV file whose first line contains the names. Fields in double quotes may
/// contain commas; empty lines are ignored. Throws InputError with file, line and column.
SweepPlan table_plan(const std::string& file);

}  // namespace floatframe

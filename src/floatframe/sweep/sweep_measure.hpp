#pragma once
#include <string>
#include <vector>

namespace floatframe {

/// An output and the statistics of it that are columns of the table.
struct SweepMeasure {
  std::string output;     ///< name of an output column
  std::string statistic;  ///< empty: all; else one of sweep_statistics
};
inline const std::vector<std::string> sweep_statistics{"final", "min",         "time_of_min",
                                                       "max",   "time_of_max", "rms"};

/// "tip.x" or "tip.x:max"; `option` is named in errors. Throws InputError.
SweepMeasure sweep_measure(const std::string& text, const std::string& option = "--measure");

/// What makes a run the best of a study: a figure that is smallest there, or largest.
struct SweepRanking {
  SweepMeasure measure;  ///< with its statistic
  bool largest = false;
};

/// "tip.x:max", the statistic included; `option` is named in errors. Throws InputError.
SweepRanking sweep_ranking(const std::string& option, const std::string& text, bool largest);

}  // namespace floatframe

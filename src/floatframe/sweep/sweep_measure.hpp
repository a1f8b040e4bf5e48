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

/// "tip.x" or "tip.x:max". Throws InputError.
SweepMeasure sweep_measure(const std::string& text);

}  // namespace floatframe

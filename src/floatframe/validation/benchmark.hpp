#pragma once
// A benchmark: a model file with reference values of its outputs and vibrations, as a file beside
// it describes them, `benchmark.yaml` or `NAME.benchmark.yaml` (docs/validation.md, "Benchmarks of
// your own").
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

/// Reference values of one output over the time, or the frequency of one vibration.
struct BenchmarkCheck {
  std::string quantity;               ///< heading of reports; checks may share it
  std::string output;                 ///< column of the results; empty: a vibration
  int vibration = 0;                  ///< its number as `floatframe modes` counts them, from 1
  std::vector<TablePoint> reference;  ///< (time [s], value); of a vibration (0, frequency [Hz])
  double absolute = 0.0;              ///< tolerance, in the unit of the output
  double relative = 0.0;  ///< added to it: a part of the largest magnitude of the reference
  SourceMark mark;
  std::string path;  ///< "checks[3]"
  /// [unit of the output]
  double tolerance() const noexcept;
  /// The largest magnitude of the reference.
  double size() const noexcept;
};

struct Benchmark {
  std::string file, name;  ///< the name is that of its folder, and NAME
  std::string title, source;
  std::string model;  ///< path of the model file
  std::vector<Coordinates> coordinates;
  std::vector<std::string> settings;  ///< NAME=VALUE
  SourceMark settings_mark;
  /// Compared is what the results at the step of the model file and at half of it extrapolate to by
  /// the second order of the method, (4 x_half - x) / 3.
  bool extrapolate = false;
  std::vector<BenchmarkCheck> checks;
};

/// Throws InputError with all errors found, each with its place.
Benchmark read_benchmark(const std::string& file);

}  // namespace floatframe

#pragma once
// Runs of benchmarks, and how far their results are from the references.
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/result_table.hpp"
#include "floatframe/validation/benchmark.hpp"

namespace floatframe {

/// One check in one formulation.
struct CheckResult {
  std::string unit;
  /// The largest difference from the reference, and when [s]; infinite if there is no result.
  double error = 0.0, at = 0.0;
  double value = 0.0, reference = 0.0;  ///< there
  double tolerance = 0.0;
  bool passed() const noexcept { return error <= tolerance; }
  /// The error in parts of the tolerance.
  double part() const noexcept;
};

/// One benchmark in one formulation.
struct BenchmarkResult {
  Coordinates coordinates{};
  std::vector<CheckResult> checks;  ///< in the order of the benchmark; all, even after a failure
  std::string failure;              ///< why there are no results; empty: none
  std::vector<std::string> warnings;
  double seconds = 0.0;                           ///< of a processor, of all its runs and analyses
  ResultTable table;                              ///< empty without a run
  std::shared_ptr<const SystemState> start, end;  ///< of the run
  bool passed() const noexcept;
};

/// That the outputs of all checks exist and that their times are those of rows. Throws InputError
/// with the places in the benchmark's file.
void require_outputs(const Benchmark& benchmark, const Model& model);

/// `model`: that of the benchmark with its settings. `stop` ends it, with a failure.
BenchmarkResult run_benchmark(const Benchmark& benchmark, const Model& model,
                              Coordinates coordinates, const std::atomic<bool>* stop = nullptr);

}  // namespace floatframe

#pragma once
// What `floatframe validate` found: for the terminal, for other programs, and as a page without
// scripts that needs no network.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/validation/run_benchmark.hpp"

namespace floatframe {

struct ValidatedBenchmark {
  Benchmark benchmark;
  std::shared_ptr<const Model> model;
  std::vector<BenchmarkResult> results;  ///< one for each of its coordinates
};

/// The worst check of one quantity in one formulation, as reports list them.
struct ValidationRow {
  const ValidatedBenchmark* of = nullptr;
  const BenchmarkResult* result = nullptr;
  const BenchmarkCheck* check = nullptr;
  const CheckResult* found = nullptr;
  bool first = false;  ///< of its result
};
std::vector<ValidationRow> validation_rows(const std::vector<ValidatedBenchmark>& list);

/// "12 benchmarks in 22 runs: 240 checks within their tolerances"
std::string validation_verdict(const std::vector<ValidatedBenchmark>& list);
/// One sentence for each run that failed or left a tolerance.
std::vector<std::string> validation_failures(const std::vector<ValidatedBenchmark>& list);

std::string validation_text(const std::vector<ValidatedBenchmark>& list);
std::string validation_json(const std::vector<ValidatedBenchmark>& list);
/// The table, and of each benchmark a picture of its mechanism and its first output over the time
/// beside the reference. `software`: version and build.
std::string validation_page(const std::vector<ValidatedBenchmark>& list,
                            const std::string& software);

}  // namespace floatframe

#include "floatframe/validation/benchmark_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

const char* coordinates_word(const BenchmarkResult& r) {
  return rules::coordinates[index_of(r.coordinates)];
}

Json check_json(const BenchmarkCheck& c, const CheckResult& r) {
  return {{"quantity", c.quantity},
          {"output", c.output.empty() ? Json() : Json(c.output)},
          {"unit", r.unit},
          {"error", r.error},
          {"tolerance", r.tolerance},
          {"at_s", r.at},
          {"value", r.value},
          {"reference", r.reference},
          {"instants", c.reference.size()},
          {"passed", r.passed()}};
}

}  // namespace

std::vector<ValidationRow> validation_rows(const std::vector<ValidatedBenchmark>& list) {
  std::vector<ValidationRow> rows;
  for (const ValidatedBenchmark& v : list)
    for (const BenchmarkResult& r : v.results) {
      const std::size_t begin = rows.size();
      for (std::size_t k = 0; k < r.checks.size(); ++k) {
        const BenchmarkCheck& c = v.benchmark.checks[k];
        const auto known = std::find_if(
            rows.begin() + static_cast<std::ptrdiff_t>(begin), rows.end(),
            [&](const ValidationRow& row) { return row.check->quantity == c.quantity; });
        if (known == rows.end())
          rows.push_back({&v, &r, &c, &r.checks[k], rows.size() == begin});
        else if (r.checks[k].part() > known->found->part())
          known->check = &c, known->found = &r.checks[k];
      }
    }
  return rows;
}

std::string validation_verdict(const std::vector<ValidatedBenchmark>& list) {
  long runs = 0, checks = 0, beyond = 0;
  for (const ValidatedBenchmark& v : list)
    for (const BenchmarkResult& r : v.results) {
      ++runs;
      checks += static_cast<long>(r.checks.size());
      beyond += std::ranges::count_if(r.checks, [](const auto& c) { return !c.passed(); });
    }
  const std::string what = fmt::format(
      "{}, {}", plural(static_cast<long>(list.size()), "benchmark"), plural(runs, "run"));
  if (beyond == 0) return fmt::format("{}: {} within tolerance", what, plural(checks, "check"));
  return fmt::format("{}: {} of {} beyond tolerance", what, beyond, plural(checks, "check"));
}

std::vector<std::string> validation_failures(const std::vector<ValidatedBenchmark>& list) {
  std::vector<std::string> out;
  for (const ValidatedBenchmark& v : list)
    for (const BenchmarkResult& r : v.results) {
      if (r.passed()) continue;
      const std::string who = fmt::format("{}, {}: ", v.benchmark.name, coordinates_word(r));
      if (!r.failure.empty()) {
        out.push_back(who + r.failure);
        continue;
      }
      const auto worst = std::ranges::max_element(r.checks, {}, &CheckResult::part);
      const BenchmarkCheck& c = v.benchmark.checks[worst - r.checks.begin()];
      out.push_back(who + fmt::format("{} is {:.10g} {} at {:g} s, the reference {:.10g}: beyond "
                                      "the tolerance of {:.2g}",
                                      c.output.empty() ? c.quantity : c.output, worst->value,
                                      worst->unit, worst->at, worst->reference, worst->tolerance));
    }
  return out;
}

std::string validation_text(const std::vector<ValidatedBenchmark>& list) {
  TextTable table({"case", "coordinates", "quantity", "error", "tolerance", "unit",
                   "error/tolerance", "time [s]", ""},
                  {0, 1, 2, 5, 8});
  double seconds = 0.0;
  for (const ValidationRow& row : validation_rows(list)) {
    const CheckResult& c = *row.found;
    if (row.first) seconds += row.result->seconds;
    table.add(
        {printable(row.of->benchmark.name), coordinates_word(*row.result),
         printable(row.check->quantity), fmt::format("{:.2g}", c.error),
         fmt::format("{:.2g}", c.tolerance), printable(c.unit), fmt::format("{:.2g}", c.part()),
         row.first ? fmt::format("{:.2f}", row.result->seconds) : "", c.passed() ? "" : "beyond"});
  }
  return table.text() +
         fmt::format("\n{}; {:.3g} s of a processor\n", validation_verdict(list), seconds);
}

std::string validation_json(const std::vector<ValidatedBenchmark>& list) {
  Json benchmarks = Json::array();
  bool passed = true;
  for (const ValidatedBenchmark& v : list) {
    Json runs = Json::array();
    for (const BenchmarkResult& r : v.results) {
      passed = passed && r.passed();
      Json checks = Json::array();
      for (std::size_t k = 0; k < r.checks.size(); ++k)
        checks.push_back(check_json(v.benchmark.checks[k], r.checks[k]));
      runs.push_back({{"coordinates", coordinates_word(r)},
                      {"passed", r.passed()},
                      {"failure", r.failure.empty() ? Json() : Json(r.failure)},
                      {"warnings", r.warnings},
                      {"cpu_s", r.seconds},
                      {"checks", std::move(checks)}});
    }
    benchmarks.push_back({{"name", v.benchmark.name},
                          {"title", v.benchmark.title},
                          {"source", v.benchmark.source},
                          {"file", v.benchmark.file},
                          {"model", v.benchmark.model},
                          {"runs", std::move(runs)}});
  }
  return json_document({{"passed", passed}, {"benchmarks", std::move(benchmarks)}});
}

}  // namespace floatframe

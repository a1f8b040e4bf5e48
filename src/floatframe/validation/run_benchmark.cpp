#include "floatframe/validation/run_benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/core/suggest.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/math/lowest_motions.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

constexpr double no_result = std::numeric_limits<double>::infinity();

double row_interval(const SimulationDescription& o) {
  return static_cast<double>(steps_per_row(o)) * o.step;
}

bool has_runs(const Benchmark& b) {
  return std::any_of(b.checks.begin(), b.checks.end(),
                     [](const BenchmarkCheck& c) { return !c.output.empty(); });
}

RunResult run_once(const Model& model, const SimulationDescription& options,
                   const std::atomic<bool>* stop) {
  RunOptions how;
  how.keep_state = true;
  how.stop = stop;
  return run(model, options, how);
}

/// The table of `fine`, at half the step of `coarse`, made to (4 fine - coarse) / 3.
void extrapolate(const ResultTable& coarse, ResultTable& fine) {
  for (std::size_t k = 0; k < std::min(coarse.data.size(), fine.data.size()); ++k)
    if (k % fine.columns.size() != 0) fine.data[k] += (fine.data[k] - coarse.data[k]) / 3.0;
}

void add_run(const Benchmark& b, const Model& model, const std::atomic<bool>* stop,
             BenchmarkResult& out) {
  SimulationDescription o = model.simulation;
  o.coordinates = out.coordinates;
  o.output_interval = row_interval(o);
  RunResult r = run_once(model, o, stop);
  if (b.extrapolate && r.summary.status == "completed") {
    o.step *= 0.5;
    RunResult fine = run_once(model, o, stop);
    extrapolate(r.table, fine.table);
    r = std::move(fine);
  }
  if (r.summary.status != "completed") out.failure = r.summary.status + ": " + r.summary.message;
  for (const RangeWarning& w : r.summary.warnings) out.warnings.push_back(w.sentence);
  out.table = std::move(r.table);
  out.end = std::move(r.state);
  o.duration = 0.0;
  out.start = run_once(model, o, nullptr).state;
}

/// The frequencies of the vibrations [Hz], as `floatframe modes` counts them.
std::vector<double> vibrations(const Model& model, Coordinates coordinates) {
  Model same = model;
  same.simulation.coordinates = coordinates;
  const LinearSystem system = linear_system(same);
  std::vector<LinearMode> modes = linear_modes(system);
  double largest = 0.0;
  for (const LinearMode& m : modes) largest = std::max(largest, std::abs(m.lambda));
  std::vector<double> out;
  for (const LinearMode& m : modes)
    if (std::abs(m.lambda) > zero_part * largest) out.push_back(m.damped());
  return out;
}

void compare(CheckResult& r, double at, double value, double reference) {
  const double error = std::isfinite(value) ? std::abs(value - reference) : no_result;
  if (error < r.error) return;
  r.error = error;
  r.at = at;
  r.value = value;
  r.reference = reference;
}

CheckResult compared(const BenchmarkCheck& c, const BenchmarkResult& run,
                     const std::vector<double>& frequencies) {
  CheckResult r;
  r.tolerance = c.tolerance();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (c.vibration > 0) {
    r.unit = "Hz";
    const auto k = static_cast<std::size_t>(c.vibration) - 1;
    compare(r, 0.0, k < frequencies.size() ? frequencies[k] : none, c.reference.front().f);
    return r;
  }
  const ResultTable& t = run.table;
  std::size_t column = 1;
  while (column < t.columns.size() && t.columns[column].name != c.output) ++column;
  const bool known = column < t.columns.size() && t.rows() > 0;
  if (known) r.unit = t.columns[column].unit;
  const double interval = t.rows() > 1 ? t.at(1, 0) - t.at(0, 0) : 1.0;
  for (const TablePoint& p : c.reference) {
    const auto row = static_cast<std::size_t>(std::lround(p.x / interval));
    compare(r, p.x, known && row < t.rows() ? t.at(row, column) : none, p.f);
  }
  return r;
}

}  // namespace

double CheckResult::part() const noexcept {
  return error == 0.0 ? 0.0 : tolerance > 0.0 ? error / tolerance : no_result;
}

bool BenchmarkResult::passed() const noexcept {
  return failure.empty() &&
         std::all_of(checks.begin(), checks.end(), [](const CheckResult& c) { return c.passed(); });
}

void require_outputs(const Benchmark& benchmark, const Model& model) {
  ErrorList errors;
  std::vector<std::string> names;
  for (const Output& o : model.outputs) names.push_back(o.name);
  const double interval = row_interval(model.simulation), end = model.simulation.duration;
  for (const BenchmarkCheck& c : benchmark.checks) {
    if (c.output.empty()) continue;
    if (std::find(names.begin(), names.end(), c.output) == names.end())
      errors.add({c.mark, ErrorCode::not_found,
                  fmt::format("{}: found the output '{}', which '{}' does not have{}", c.path,
                              c.output, benchmark.model, did_you_mean(c.output, names)),
                  1, c.path});
    for (const TablePoint& p : c.reference) {
      const double rows = p.x / interval;
      if (std::abs(rows - std::round(rows)) < 1e-6 && p.x <= end * (1.0 + 1e-9)) continue;
      errors.add({c.mark, ErrorCode::mismatch,
                  fmt::format("{}: found a reference at {:g} s, expected multiples of the output "
                              "interval of '{}', {:g} s, up to its duration, {:g} s",
                              c.path, p.x, benchmark.model, interval, end),
                  1, c.path});
      break;
    }
  }
  errors.throw_if_any();
}

BenchmarkResult run_benchmark(const Benchmark& benchmark, const Model& model,
                              Coordinates coordinates, const std::atomic<bool>* stop) {
  BenchmarkResult out;
  out.coordinates = coordinates;
  const double began = thread_seconds();
  std::vector<double> frequencies;
  try {
    if (has_runs(benchmark)) add_run(benchmark, model, stop, out);
    for (const BenchmarkCheck& c : benchmark.checks)
      if (c.vibration > 0 && frequencies.empty()) frequencies = vibrations(model, coordinates);
  } catch (const RunError& error) {
    out.failure = error.what();
  }
  for (const BenchmarkCheck& c : benchmark.checks)
    out.checks.push_back(compared(c, out, frequencies));
  out.seconds = thread_seconds() - began;
  return out;
}

}  // namespace floatframe

#include "floatframe/bench/bench_iltis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "floatframe/apps/command.hpp"
#include "floatframe/bench/bench_chain.hpp"
#include "floatframe/bench/bench_stepper.hpp"
#include "floatframe/math/dense_factorization.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

constexpr Combination combinations[] = {{Coordinates::absolute, InertiaMethod::projection},
                                        {Coordinates::absolute, InertiaMethod::preprocessing},
                                        {Coordinates::relative, InertiaMethod::projection},
                                        {Coordinates::relative, InertiaMethod::preprocessing}};

/// Processor time of a run without input and output, in blocks of steps.
StepTime stepping_time(const Model& model, const SimulationDescription& simulation, long steps,
                       int repeats) {
  return time_steps(*std::make_unique<BenchStepper>(model, simulation), steps, repeats, 0.0);
}

BenchRow measure_vehicle(const Model& model, SimulationDescription simulation,
                         const Combination& combination, const BenchOptions& options, int elements,
                         const std::function<void()>& one_done) {
  simulation.coordinates = combination.coordinates;
  simulation.inertia = combination.inertia;
  BenchRow row;
  row.coordinates = combination.coordinates;
  row.inertia = combination.inertia;
  row.elements_per_bar = elements;
  // One run for its summary, then the same steps without other work in between.
  RunOptions run_options;
  run_options.record = false;
  const RunSummary summary = run(model, simulation, run_options).summary;
  if (summary.status != "completed") {
    throw RunError(
        ErrorCode::step_failed,
        fmt::format("{} coordinates, inertia terms by {}, {} elements per bar: the run failed: {}",
                    word(row.coordinates), word(row.inertia), elements, summary.message));
  }
  row.steps = summary.steps;
  row.substeps = summary.substeps;
  row.iterations = summary.iterations;
  row.factorizations = summary.factorizations;
  row.max_position_violation = summary.max_position_violation;
  row.max_velocity_violation = summary.max_velocity_violation;
  const StepTime time = stepping_time(model, simulation, summary.steps, options.repeats);
  row.cpu_min = time.least * static_cast<double>(time.steps);
  row.cpu_median = time.median * static_cast<double>(time.steps);
  row.real_time_factor = row.cpu_min > 0.0 ? summary.duration / row.cpu_min : 0.0;
  one_done();
  return row;
}

RunResult run_to_end(const Model& model, const SimulationDescription& simulation) {
  RunResult result = run(model, simulation);
  if (result.summary.status != "completed")
    throw RunError(ErrorCode::step_failed,
                   fmt::format("steps of {:g} ms: the run failed: {}", 1e3 * simulation.step,
                               result.summary.message));
  return result;
}

/// The largest difference of two tables of the same instants in a column of lengths.
void compare_lengths(const ResultTable& table, const ResultTable& fine, BenchError& e) {
  for (std::size_t k = 1; k < table.columns.size(); ++k) {
    if (table.columns[k].unit != "m") continue;
    for (std::size_t i = 0; i < std::min(table.rows(), fine.rows()); ++i) {
      const double apart = std::abs(table.at(i, k) - fine.at(i, k));
      if (!(apart > e.error)) continue;
      e.error = apart;
      e.channel = table.columns[k].name;
      e.time = table.at(i, 0);
    }
  }
}

std::vector<BenchError> errors_of_steps(const Model& model, SimulationDescription simulation,
                                        int repeats) {
  simulation.coordinates = Coordinates::relative;
  simulation.inertia = InertiaMethod::preprocessing;
  const double step = simulation.step;
  simulation.output_interval = step;
  simulation.given_by("--step", "step");
  simulation.step = step / 100.0;
  const ResultTable fine = run_to_end(model, simulation).table;
  std::vector<BenchError> errors;
  for (const double parts : {1.0, 2.0, 5.0, 10.0}) {
    BenchError e;
    e.step = simulation.step = step / parts;
    const RunResult result = run_to_end(model, simulation);
    compare_lengths(result.table, fine, e);
    const StepTime time = stepping_time(model, simulation, result.summary.steps, repeats);
    e.cpu_min = time.least * static_cast<double>(time.steps);
    e.real_time_factor = e.cpu_min > 0.0 ? simulation.duration / e.cpu_min : 0.0;
    errors.push_back(e);
  }
  return errors;
}

/// One full Newton iteration at the start, in relative coordinates [s].
double iteration_seconds(const Model& model, SimulationDescription simulation) {
  simulation.coordinates = Coordinates::relative;
  return time_iteration(*std::make_unique<BenchStepper>(model, simulation), 0.1);
}

}  // namespace

BenchResult bench_iltis(const BenchOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  BenchResult result;
  result.repeats = options.repeats;
  const double runs = static_cast<double>(options.elements.size() * std::size(combinations));
  double runs_done = 0.0;
  const auto one_done = [&] {
    runs_done += 1.0;
    if (options.progress) options.progress(runs_done / runs);
  };
  const int largest = *std::max_element(options.elements.begin(), options.elements.end());
  for (const int elements : options.elements) {
    const Clock::time_point start = Clock::now();
    ModelDescription description = read_model(options.model, {{"ne", std::to_string(elements)}});
    SimulationDescription& simulation = description.simulation;
    if (options.step > 0.0) simulation.step = options.step;
    if (options.step > 0.0) simulation.given_by("--step", "step");
    if (options.duration > 0.0) simulation.duration = options.duration;
    if (options.duration > 0.0) simulation.given_by("--duration", "duration");
    const Clock::time_point was_read = Clock::now();
    const Model model = build_model(description);
    result.builds.push_back({elements, seconds(start, was_read), seconds(was_read, Clock::now())});
    result.step = description.simulation.step;
    result.duration = description.simulation.duration;
    if (elements == largest) {
      result.dense_llt = dense_factorization_seconds(98);
      result.rel_p_iteration = iteration_seconds(model, description.simulation);
      result.errors = errors_of_steps(model, description.simulation, options.repeats);
    }
    for (const Combination& combination : combinations) {
      result.rows.push_back(
          measure_vehicle(model, description.simulation, combination, options, elements, one_done));
    }
  }
  std::stable_sort(result.rows.begin(), result.rows.end(),
                   [](const BenchRow& a, const BenchRow& b) {
                     const auto order = [](const BenchRow& r) {
                       return std::pair(r.coordinates != Coordinates::absolute,
                                        r.inertia != InertiaMethod::projection);
                     };
                     return order(a) < order(b);
                   });
  return result;
}

}  // namespace floatframe

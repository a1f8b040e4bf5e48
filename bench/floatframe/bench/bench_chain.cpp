#include "floatframe/bench/bench_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/bench/chain_model.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/math/dense_factorization.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

constexpr long steps_a_block = 20;
constexpr double reference_step = 5e-5;  // [s]
constexpr double tip_time = 1.0;         // [s]

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The step that ends at 1 s, or 0 if none does within `steps`.
long tip_step(double step, long steps) {
  const long k = std::lround(tip_time / step);
  const bool hit = std::abs(static_cast<double>(k) * step - tip_time) < 1e-9;
  return hit && k <= steps ? k : 0;
}

Vec3 tip_of(BenchStepper& stepper) { return stepper.sample().segment<3>(1); }

/// Executes the run once, outside the timing, to record tip and energies.
class CheckRun {
 public:
  CheckRun(BenchStepper& stepper, double step, long steps, double seconds) : stepper_(stepper) {
    note_energies();
    const long tip_at = tip_step(step, steps);
    double spent = 0.0;
    long block = 1;  // the first step gives the cost of the others
    while (done_ < steps) {
      long next = std::min(done_ + block, steps);
      if (tip_at > done_) next = std::min(next, tip_at);
      const double before = thread_seconds();
      if (!stepper_.advance(next - done_)) {
        done_ = stepper_.counts().steps;
        failure_ = stepper_.failure();
        return;
      }
      spent += thread_seconds() - before;
      done_ = next;
      note_energies();
      if (done_ == tip_at) tip_ = tip_of(stepper_);
      const double each = spent / static_cast<double>(done_);
      block =
          std::clamp(static_cast<long>(0.2 * seconds / std::max(each, 1e-9)), 1L, steps_a_block);
      if (spent + static_cast<double>(block) * each > seconds && done_ < steps) {
        // Such a long run is cut to a round number of steps, the same on machines of similar speed.
        done_ = round_steps(done_);
        return;
      }
    }
  }

  long steps() const { return done_; }
  const std::optional<Vec3>& tip() const { return tip_; }
  const std::string& failure() const { return failure_; }
  double energy_drift() const {
    const double range = highest_ - lowest_;
    return range > 0.0 ? drift_ / range : 0.0;
  }

 private:
  void note_energies() {
    const Energies e = stepper_.energies();
    if (done_ == 0) first_ = e.total();
    drift_ = std::max(drift_, std::abs(e.total() - first_));
    lowest_ = std::min(lowest_, e.potential);
    highest_ = std::max(highest_, e.potential);
  }

  BenchStepper& stepper_;
  long done_ = 0;
  std::optional<Vec3> tip_;
  std::string failure_;
  double first_ = 0, drift_ = 0;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

std::optional<Vec3> reference_tip(const Model& model, const SimulationDescription& simulation,
                                  double step) {
  SimulationDescription fine = simulation;
  fine.coordinates = Coordinates::relative;
  fine.inertia = InertiaMethod::preprocessing;
  fine.step = step;
  fine.tolerance = std::min(simulation.tolerance, 1e-10);
  const auto stepper = std::make_unique<BenchStepper>(model, fine);
  const long steps = std::lround(tip_time / step);
  if (!stepper->advance(steps)) return std::nullopt;
  return tip_of(*stepper);
}

ChainRow measure_chain(const Model& model, const SimulationDescription& simulation,
                       const ChainOptions& options, const std::optional<Vec3>& reference) {
  ChainRow row;
  row.combination = {simulation.coordinates, simulation.inertia};
  const auto stepper = std::make_unique<BenchStepper>(model, simulation);
  row.freedoms = stepper->freedoms();
  const long steps = std::max(1L, std::lround(options.duration / options.step));
  const CheckRun check(*stepper, options.step, steps, 2.0 * options.seconds);
  row.failure = check.failure();
  row.energy_drift = check.energy_drift();
  if (check.tip() && reference) row.tip_error = (*check.tip() - *reference).norm();
  if (check.tip() && model.bodies.size() == 4)
    row.tip_published = (*check.tip() - published_tip_of_four).norm();
  if (check.steps() == 0) return row;
  try {
    row.time =
        time_steps(*stepper, check.steps(), options.runs, options.seconds, options.most_runs);
  } catch (const RunError& error) {
    row.failure = error.what();
  }
  return row;
}

}  // namespace

long round_steps(long n) noexcept {
  for (long decade = 1;; decade *= 10) {
    for (const long digit : {1L, 2L, 5L}) {
      const long next = digit == 5 ? 10 * decade : (digit == 2 ? 5 : 2) * decade;
      if (next > n) return digit * decade;
    }
  }
}

StepTime time_steps(BenchStepper& stepper, long steps, int runs, double seconds, int most_runs) {
  const std::size_t blocks = (steps + steps_a_block - 1) / steps_a_block;
  std::vector<std::vector<double>> times(blocks);
  StepTime result;
  double spent = 0.0;
  while (result.runs < runs || (spent < seconds && result.runs < most_runs)) {
    // Repetitions of a long run are limited: they would improve its accuracy little.
    if (result.runs >= 2 && spent > 2.0 * seconds) break;
    stepper.restart();
    for (std::size_t b = 0; b < blocks; ++b) {
      const long from = static_cast<long>(b) * steps_a_block;
      const long count = std::min(steps_a_block, steps - from);
      const double before = thread_seconds();
      const bool good = stepper.advance(count);
      times[b].push_back(thread_seconds() - before);
      if (!good) throw RunError(ErrorCode::step_failed, stepper.failure());
      spent += times[b].back();
    }
    ++result.runs;
  }
  result.steps = steps;
  result.counts = stepper.counts();
  for (const std::vector<double>& block : times) {
    result.least += *std::min_element(block.begin(), block.end());
    result.median += median(block);
  }
  result.least /= static_cast<double>(steps);
  result.median /= static_cast<double>(steps);
  return result;
}

ChainResult bench_chain(const ChainOptions& options) {
  ChainResult result;
  result.options = options;
  result.dense_llt = dense_factorization_seconds(98);
  result.tip_reference_step = std::min(reference_step, 0.1 * options.step);
  const std::size_t rows = options.links.size() * options.modes.size() *
                           options.coordinates.size() * options.inertia.size();
  for (const int links : options.links) {
    for (const int modes : options.modes) {
      const Model model = build_model(chain_model(links, modes, options.elements));
      SimulationDescription simulation = model.simulation;
      simulation.step = options.step;
      simulation.duration = options.duration;
      simulation.tolerance = options.tolerance;
      simulation.spectral_radius = options.spectral_radius;
      std::optional<Vec3> reference;
      const long steps = std::lround(options.duration / options.step);
      if (links <= largest_reference_chain && tip_step(options.step, steps) > 0)
        reference = reference_tip(model, simulation, result.tip_reference_step);
      for (const Coordinates coordinates : options.coordinates) {
        for (const InertiaMethod inertia : options.inertia) {
          simulation.coordinates = coordinates;
          simulation.inertia = inertia;
          ChainRow row = measure_chain(model, simulation, options, reference);
          row.links = links;
          row.modes = modes;
          result.rows.push_back(row);
          if (options.progress)
            options.progress(static_cast<double>(result.rows.size()) / static_cast<double>(rows));
        }
      }
    }
  }
  result.dense_llt = std::min(result.dense_llt, dense_factorization_seconds(98));
  return result;
}

}  // namespace floatframe

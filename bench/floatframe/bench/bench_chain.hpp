#pragma once
// The chain of flexible links in the four combinations of coordinates and inertia method: processor
// time per step, iterations and factorisations, the error at the tip, the drift of the energy; with
// a reference time measured in the same process, one dense Cholesky factorisation.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/bench/bench_stepper.hpp"
#include "floatframe/bench/chain_model.hpp"
#include "floatframe/description/description.hpp"

namespace floatframe {

struct Combination {
  Coordinates coordinates;
  InertiaMethod inertia;
};

/// "Abs. + B" and so on, as in the paper (B: projection, P: preprocessing).
std::string short_name(const Combination& combination);

/// Blocks of steps timed in several identical runs: for each block the minimum and the median time
/// over the runs, summed over the blocks. A disturbance affects one block of one run only.
struct StepTime {
  double least = 0, median = 0;  ///< [s] of processor time per step
  long steps = 0;
  int runs = 0;
  StepCounters counts;  ///< of one run
};

/// The largest of 1, 2, 5, 10, 20, ... that is not above n.
long round_steps(long n) noexcept;

/// Times `steps` steps from the start in at least `runs` runs, more while their total is less than
/// `seconds`. Throws RunError with the message of the stepper if a step fails.
StepTime time_steps(BenchStepper& stepper, long steps, int runs, double seconds,
                    int most_runs = 100);

struct ChainRow {
  int links = 0, modes = 0;
  Combination combination{Coordinates::relative, InertiaMethod::preprocessing};
  int freedoms = 0;  ///< velocities of the formulation
  StepTime time;
  std::optional<double> tip_error;      ///< at 1 s, against a run with a small step [m]
  std::optional<double> tip_published;  ///< at 1 s, distance to the published tip [m]
  double energy_drift = 0;  ///< largest change of the total energy over the range of the potential
  std::string failure;      ///< reason for an early end; else empty
};

struct ChainOptions {
  std::vector<int> links{1, 4, 16, 64, 256};
  std::vector<int> modes{8};
  int elements = 20;
  double step = 1e-3, duration = 2.0;  ///< [s]
  double tolerance = 1e-9;             ///< of Newton's method, largest coordinate increment
  double spectral_radius = chain_spectral_radius;
  std::vector<Coordinates> coordinates{Coordinates::relative, Coordinates::absolute};
  std::vector<InertiaMethod> inertia{InertiaMethod::preprocessing, InertiaMethod::projection};
  int runs = 5;  ///< minimum number of timed runs of a row
  int most_runs = 100;
  double seconds = 2.0;  ///< approximate processor time for the timed runs of a row
  std::function<void(double)> progress;
};

struct ChainResult {
  ChainOptions options;
  std::vector<ChainRow> rows;
  double tip_reference_step = 0;  ///< [s]
  double dense_llt = 0;           ///< [s], 98 x 98
};

/// Largest number of links for the reference run with a small step.
inline constexpr int largest_reference_chain = 16;

/// A failed run is reported in its row; the others continue. Throws InputError, RunError for models
/// that cannot be built or started.
ChainResult bench_chain(const ChainOptions& options);

std::string chain_text(const ChainResult& result);
std::string chain_json(const ChainResult& result);

}  // namespace floatframe

#pragma once
// Table 1 of the paper on this machine: processor time of the Iltis manoeuvre in the four
// combinations of coordinates and inertia method against the number of elements per bar; the cost
// of the model's preparation; the error and cost of several step sizes; and two reference times
// measured in the same run, a dense Cholesky factorisation and one full Newton iteration.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"

namespace floatframe {

struct BenchRow {
  Coordinates coordinates = Coordinates::relative;
  InertiaMethod inertia = InertiaMethod::preprocessing;
  int elements_per_bar = 0;
  /// [s] of a whole run, without input and output: for every block of 20 steps the minimum and the
  /// median time over the runs, summed over the blocks.
  double cpu_min = 0, cpu_median = 0;
  long steps = 0, iterations = 0, factorizations = 0, substeps = 0;
  double max_position_violation = 0;  ///< after the steps [m]
  double max_velocity_violation = 0;  ///< after the projections [m/s]
  double real_time_factor = 0;        ///< at cpu_min
};

struct BenchBuild {
  int elements_per_bar = 0;
  double read = 0,
         build = 0;  ///< [s] reading the model file; finite elements, modes and constant integrals
};

/// Cost against error: in relative coordinates, preprocessing, at the largest number of elements.
struct BenchError {
  double step = 0, cpu_min = 0, real_time_factor = 0;  ///< as above
  double error = 0;  ///< largest error of an output in metres, against a hundredth of the step [m]
  std::string channel;  ///< channel of the largest error
  double time = 0;      ///< time of the largest error [s]
};

struct BenchResult {
  std::vector<BenchRow> rows;      ///< by combination, then by elements per bar
  std::vector<BenchBuild> builds;  ///< one for each number of elements
  std::vector<BenchError> errors;  ///< by falling step
  double step = 0, duration = 0;   ///< [s]
  int repeats = 0;
  double dense_llt = 0;        ///< [s], 98 x 98
  double rel_p_iteration = 0;  ///< [s], at the largest number of elements
};

struct BenchOptions {
  std::string model;  ///< model file with the parameter `ne`
  std::vector<int> elements{5, 10, 50, 100};
  int repeats = 5;
  double step = 0, duration = 0;  ///< [s]; 0: those of the model file
  std::function<void(double)> progress;
};

/// Throws InputError for an invalid model, RunError when a run fails.
BenchResult bench_iltis(const BenchOptions& options);

/// Tables for the terminal, with the figures of the paper for comparison.
std::string bench_text(const BenchResult& result);
std::string bench_json(const BenchResult& result);

}  // namespace floatframe

#pragma once
// The time from a built model to its first step, against the number of coordinates and the time of
// a step.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/bench/start_models.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {

struct StartRow {
  StartKind kind = StartKind::chain;
  bool flexible = false;
  Coordinates coordinates = Coordinates::relative;
  int count = 0;     ///< links, fields, vehicles
  int freedoms = 0;  ///< velocities of the formulation
  double start = 0;  ///< [s], the minimum of the runs
  double step = 0;   ///< [s], one step of 1 ms, the minimum of a few
  std::string failure;

  /// Limit of the start time: 20 steps, 2 ms and 50 us for each coordinate [s].
  double allowed() const noexcept { return 20.0 * step + 2e-3 + 50e-6 * freedoms; }
};

struct StartOptions {
  std::vector<StartKind> kinds{std::begin(all_start_kinds), std::end(all_start_kinds)};
  std::vector<Coordinates> coordinates{Coordinates::relative, Coordinates::absolute};
  int least = 100, most = 5000;  ///< approximate range of coordinates
  int runs = 3;                  ///< repetitions of a start
  std::function<void(double)> progress;
};

struct StartResult {
  StartOptions options;
  std::vector<StartRow> rows;
};

/// Four sizes of each kind, rigid and flexible, from the least to the most coordinates. A failed
/// start is reported in its row; the others continue.
StartResult bench_start(const StartOptions& options);

/// Exponent of the start time over the coordinates in rows of one series, from the first to the
/// last; 0 if they have equal numbers of coordinates.
double exponent(const std::vector<StartRow>& series);

std::string start_text(const StartResult& result);
std::string start_json(const StartResult& result);

}  // namespace floatframe

#pragma once
// Jumps and corners of functions of time: loads, actuators, targets, motions. An undivided step
// over such an instant is only of first order, or of second order by chance; steps are divided
// there (corner_steps.hpp).
//
// A jump may be that of the value or the slope; of the curvature, for a target whose derivative is
// its rate, and for a piece that steps do not resolve (the flank of a cubic table); of the
// acceleration, for a motion, which acts like a load. Jumps of values are always located. Corners
// are located if only a few follow one another within two steps: a pulse, a flank. A denser signal
// is sampled by steps as it is. A jump in the velocity of a motion requires an impulse, which no
// division of steps resolves: it is reported, not located.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Corners within this fraction of a step count as one.
inline constexpr double time_corner_width = 1e-6;

/// Pieces of a function that repeats up to which its corners are looked at.
inline constexpr std::size_t most_repeated_pieces = 100'000;

/// The functions go from their left sides at `from` to their right sides at `to` [s].
struct TimeCorner {
  double from = 0.0, to = 0.0;
};

/// Corners to be located in a run.
struct TimeCornerOptions {
  double step = 0.0;      ///< [s]
  double begin = 0.0;     ///< [s]
  double duration = 0.0;  ///< later corners are not reported; may be infinite [s]
  bool all = false;       ///< in dense tables, too
};

struct TimeCorners {
  std::vector<TimeCorner> located;  ///< ascending
  /// Sentences: motions whose velocity jumps; tables that are too dense; for undivided steps,
  /// corners within a step. Corners at the end of a step are not mentioned.
  std::vector<std::string> velocity_jumps, dense, passed;
  std::vector<std::string> jumps;  ///< of motions by formulas
};

TimeCorners time_corners(const Model& model, const TimeCornerOptions& options);

/// The prescribed functions of time of a model.
struct Forcing {
  enum class Kind { load, target, motion } kind = Kind::load;
  std::string name;  ///< "the load 'push'"
  const TimeFunction* function = nullptr;
  bool rate = false;      ///< the derivative acts, too
  const char* unit = "";  ///< of the velocity of a motion
};
std::vector<Forcing> all_forcing(const Model& model);

}  // namespace floatframe

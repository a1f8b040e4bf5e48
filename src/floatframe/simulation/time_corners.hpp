#pragma once
// Where functions of time - loads, actuators, targets, motions - jump or have a corner. Over such
// an instant a step is of first order only, or of second order by chance; steps are divided there
// (corner_steps.hpp).
//
// What jumps is the value or the slope; the curvature of a target whose derivative is its rate, and
// of a piece that steps do not resolve (the flank of a cubic table); the acceleration of a motion,
// which acts like a load. Jumps of values are located always. Corners are where no more than a few
// follow one another within two steps: a pulse, a flank. What is denser is a signal that steps
// sample as it is. A velocity of a motion that jumps asks for an impulse, which no division of
// steps resolves: it is named, not located.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Corners that lie within this part of a step are one.
inline constexpr double time_corner_width = 1e-6;

/// The functions go from their left sides at `from` to their right sides at `to` [s].
struct TimeCorner {
  double from = 0.0, to = 0.0;
};

/// What a run looks for.
struct TimeCornerOptions {
  double step = 0.0;      ///< [s]
  double begin = 0.0;     ///< [s]
  double duration = 0.0;  ///< what lies behind is not told of; may be infinite [s]
  bool all = false;       ///< in dense tables, too
};

struct TimeCorners {
  std::vector<TimeCorner> located;  ///< ascending
  /// Sentences: motions whose velocity jumps; tables that are too dense; for steps that are not
  /// divided, corners within a step. Corners at the end of a step are not mentioned.
  std::vector<std::string> velocity_jumps, dense, passed;
};

TimeCorners time_corners(const Model& model, const TimeCornerOptions& options);

/// What a model prescribes over time.
struct Forcing {
  enum class Kind { load, target, motion } kind = Kind::load;
  std::string name;  ///< "the load 'push'"
  const TimeFunction* function = nullptr;
  bool rate = false;  ///< the derivative acts, too
  int joint = -1;     ///< of a motion
};
std::vector<Forcing> all_forcing(const Model& model);

}  // namespace floatframe

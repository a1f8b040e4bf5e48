#pragma once
// The lines of a Campbell diagram: the lowest oscillating modes at its last speed, tracked
// downwards, and those of its first speed that end before the last one.
#include "floatframe/rotors/campbell.hpp"
#include "floatframe/rotors/mode_following.hpp"

namespace floatframe {

/// End of a line between the speeds `interval` and `interval + 1`.
struct LineEnd {
  std::size_t line = 0, interval = 0;
  bool upwards = false;  ///< it is known at the first of the two speeds
  double speed = 0.0;    ///< up to which it was tracked
  std::complex<double> lambda;
};

struct FollowedLines {
  /// For each line its modes at the speeds of the diagram and at intermediate speeds, where known.
  std::vector<std::map<double, std::size_t>> modes;
  std::vector<LineEnd> ends;
};

CampbellPoint campbell_point(const TurningMode& mode);

/// Fills `lines` and notes about those that end.
FollowedLines follow_lines(ModeFollower& follower, int most, CampbellDiagram& d);

/// Critical speeds, crossings and onsets of instability.
void find_crossings(ModeFollower& follower, const std::vector<double>& orders,
                    const FollowedLines& f, CampbellDiagram& d);

}  // namespace floatframe

#pragma once
// The path of a vehicle in the plane: a cubic spline through points, over the length s of its
// chords; closed, or going on straight beyond its ends.
//   foot point   (p - c(s)).c'(s) = 0                                                           (1)
//   curvature    kappa = (x' y'' - y' x'') / |c'|^3                                             (2)
#include <vector>

#include "floatframe/math/piecewise_polynomial.hpp"

namespace floatframe {

struct PathPoint {
  double x = 0.0, y = 0.0;  ///< [m]
};

class DrivenPath {
 public:
  struct Value {
    double x, y, dx, dy, ddx, ddy, dddx, dddy;  ///< and derivatives over s
  };

  /// At least two points, closed three; neighbours differ, else InputError. Allocates. Load time.
  explicit DrivenPath(const std::vector<PathPoint>& points, bool closed = false);
  /// A circle that is driven from a point with a heading [rad]. Radius [m], positive to the left.
  static DrivenPath circle(const PathPoint& begin, double heading, double radius);
  /// From a point along a heading [rad].
  static DrivenPath straight(const PathPoint& from, double heading);

  /// Of the chords [m].
  double length() const noexcept { return length_; }
  bool closed() const noexcept { return closed_; }
  Value at(double s) const noexcept;
  double curvature(double s) const noexcept;  ///< (2), positive to the left [1/m]
  /// The s of (1) next to the given one; of a closed path turns are counted. Step time.
  double foot(double s, double x, double y) const noexcept;
  /// The s of the nearest point of all.
  double nearest(double x, double y) const noexcept;

 private:
  PiecewisePolynomial x_, y_;
  double length_ = 0.0;
  bool closed_ = false;
};

}  // namespace floatframe

#pragma once
// Watches the rotations that force elements measure. A rotation vector jumps from one side to the
// other at half a turn: theta_n . theta_n-1 < 0 at more than a quarter turn. The angle of a joint
// spring counts turns from one step to the next, which needs less than half a turn in each.
// `start` and `follow` allocate nothing.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/force_outputs.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/simulation/range_warning.hpp"

namespace floatframe {

class TurnWatch {
 public:
  /// Of runs in steps of this size [s].
  TurnWatch(const Model& model, double step);

  /// At the start, and after every step: `f` is there with positions and velocities.
  template <class F>
  void start(const F& f) noexcept {
    for (Watched& x : watched_)
      if (!x.counts) x.theta = rotation(f, x);
  }
  template <class F>
  void follow(const F& f, double t) noexcept {
    for (Watched& x : watched_) {
      if (x.counts) {
        const Force& force = model_.forces[x.force];
        const MarkerState &a = f.marker(force.a), &b = f.marker(force.b);
        const double turn = step_ * std::abs(a.R.col(2).dot(b.w - a.w));
        if (turn > std::numbers::pi && x.first < 0.0) x.first = t;
        x.most = std::max(x.most, turn);
        continue;
      }
      const Vec3 theta = rotation(f, x);
      if (x.first < 0.0 && theta.dot(x.theta) < 0.0 && quarter(theta) && quarter(x.theta))
        x.first = t;
      x.theta = theta;
    }
  }

  /// The sentence about the element that went too far first, if there is one.
  void warn(std::vector<RangeWarning>& out) const;

  /// What was met so far, for a run that goes on elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    for (Watched& x : watched_) {
      s(x.theta);
      for (double* number : {&x.first, &x.most}) s(*number);
    }
  }

 private:
  struct Watched {
    int force = -1;
    bool counts = false;        ///< a joint spring
    Vec3 theta = Vec3::Zero();  ///< the last one [rad]
    double first = -1.0;        ///< when it went too far [s]; below zero: it did not
    double most = 0.0;          ///< angle in one step [rad]
  };
  static bool quarter(const Vec3& theta) noexcept { return theta.norm() > 0.5 * std::numbers::pi; }
  template <class F>
  Vec3 rotation(const F& f, const Watched& x) const noexcept {
    const Force& force = model_.forces[x.force];
    const Mat3 R = f.marker(force.a).R.transpose() * f.marker(force.b).R;
    return quaternion_log(Eigen::Quaterniond(R));
  }

  const Model& model_;
  double step_;
  std::vector<Watched> watched_;
};

}  // namespace floatframe

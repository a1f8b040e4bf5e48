#pragma once
// Monitors whether a run stays in the range of the method (docs/range.md): small elastic
// deformations, slow spin, a step that resolves the motion. `observe` functions are called in a
// run: noexcept, no allocation; the measurements are turned into sentences at the end.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/run/range_warning.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/time_corners.hpp"

namespace floatframe {

struct RangeLimits {
  double displacement = 0.1;  ///< elastic displacement over the size of the body
  double rotation = 0.2;      ///< elastic rotation [rad]
  double spin = 0.3;          ///< spin across the body over its lowest frequency
  double turn = 0.5;          ///< of a body per step [rad]
  double phase = 1.0;         ///< of an oscillation per step [rad]
  double share = 0.05;        ///< of the kinetic energy of all oscillations that counts
  double imbalance = 0.05;    ///< remainder of the energy balance over the energy exchanged
  double dissipation = 0.1;   ///< the same for numerical dissipation
  double of_present = 1e-4;   ///< fraction of the present energy below which no remainder counts
};

/// Motion per step below which only the tolerances of the solver are visible [m, rad].
inline constexpr double least_motion = 1e-8;

/// The largest value so far, with the time at which it first exceeded its limit.
struct Largest {
  double value = 0.0, at = 0.0;
  double first = -1.0;  ///< below zero: the limit was not exceeded
  int node = -1;
  void offer(double x, double t, double limit) noexcept {
    if (x > limit && first < 0.0) first = t;
    if (x > value * (1.0 + 1e-9)) {  // a steady value keeps its first time
      value = x;
      at = t;
    }
  }
  template <class Stream>
  void serialize(Stream& s) {
    std::int64_t n = node;
    for (double* x : {&value, &at, &first}) s(*x);
    s(n);
    node = static_cast<int>(n);
  }
};

/// Deformation, spin and rotation of one body.
class BodyRange {
 public:
  explicit BodyRange(const Model& model, int index);

  /// `w`: angular velocity in body axes [rad/s]; `y`: modal amplitudes; h: the step [s].
  void observe(double t, double h, const Vec3& w, const double* y, const RangeLimits& l) noexcept;

  /// For the monitored nodes [m].
  double displacement_now(const double* y) const noexcept;
  /// The largest displacement of a node due to a single mode [m].
  double displacement_of_one_mode(const double* y) const noexcept;

  double size() const noexcept { return size_; }
  /// Lowest angular frequency with the body frame held [rad/s]; 0: none.
  double lowest_frequency() const noexcept { return lowest_; }
  /// Lowest stiffness with centrifugal stiffening divided by that without, minus 1, per squared
  /// spin about the worst axis [s2]; 0: unknown.
  double stiffening() const noexcept { return stiffening_; }
  /// The component of a spin that loads the body [rad/s]; w: in body axes.
  double loading_spin(const Vec3& w) const noexcept { return (stretch_ * w).norm(); }
  const Largest& displacement() const { return displacement_; }  ///< [m]
  const Largest& rotation() const { return rotation_; }          ///< [rad]
  const Largest& spin() const { return spin_; }                  ///< [rad/s]
  const Largest& turn() const { return turn_; }                  ///< [rad]
  /// "node 'tip'", "node 7", "the surface point at (0.5, 0, 0.02) m" (of the undeformed body).
  std::string node_name(int node) const;
  /// Stores and restores the record, for runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    for (Largest* l : {&displacement_, &rotation_, &spin_, &turn_}) l->serialize(s);
  }

 private:
  void choose_nodes(const Model& model, int index);
  void estimate_stiffening(const VecX& mode);

  const FlexibleBody& data_;
  double size_ = 0.0, lowest_ = 0.0;
  double softened_ = 0.0;  ///< `lowest_` if centrifugal tension is omitted, else 0
  double stiffening_ = 0.0;
  /// |stretch w| is the spin that loads the body: a spin about the axis of a slender body does not.
  Mat3 stretch_ = Mat3::Zero();
  /// Nodes with the largest motion or rotation in a mode, and nodes with markers.
  std::vector<int> nodes_;
  VecX displaced_, rotated_;  ///< largest motion and rotation of a node in each mode
  Largest displacement_, rotation_, spin_, turn_;
};

/// Phase per step of a velocity, from its changes: cos(phase) = 1 - mean |dv|^2 / (2 var v), exact
/// for one frequency and weighted with the kinetic energy for several.
class PhaseMeter {
 public:
  explicit PhaseMeter(double mass) noexcept : mass_(mass) { assert(mass >= 0.0); }
  void start(const Vec3& v) noexcept { previous_ = v; }
  /// To be called after every full step.
  void observe(const Vec3& v) noexcept {
    changes_ += (v - previous_).squaredNorm();
    previous_ = v;
    ++count_;
    const Vec3 off = v - mean_;
    mean_ += off / static_cast<double>(count_);
    spread_ += off.dot(v - mean_);
  }
  /// Mean kinetic energy of the non-uniform part of the motion [J].
  double energy() const noexcept;
  double phase() const noexcept;  ///< [rad]
  double speed() const noexcept;  ///< root mean square of the non-uniform part [m/s, rad/s]
  long count() const noexcept { return count_; }
  template <class Stream>
  void serialize(Stream& s) {
    for (double* x : {&spread_, &changes_}) s(*x);
    s(count_);
    for (Vec3* v : {&previous_, &mean_}) s(*v);
  }

 private:
  double mass_, spread_ = 0.0, changes_ = 0.0;
  long count_ = 0;
  Vec3 previous_ = Vec3::Zero(), mean_ = Vec3::Zero();
};

/// Monitors the rotations that force elements measure. A rotation vector changes its sign at half a
/// turn: theta_n . theta_n-1 < 0 at more than a quarter turn. The angle of a joint spring counts
/// turns from one step to the next, which requires less than half a turn per step. `start` and
/// `follow` do not allocate.
class TurnWatch {
 public:
  /// For runs with this step size [s].
  TurnWatch(const Model& model, double step);

  /// At the start, and after every step.
  void start(const SystemMotion& motion) noexcept {
    for (Watched& x : watched_)
      if (!x.counts) x.theta = rotation(motion, x);
  }
  void follow(const SystemMotion& motion) noexcept {
    for (Watched& x : watched_) {
      if (x.counts) {
        const Element& force = model_.elements[x.force];
        const MarkerState &a = motion.marker(force.markers[0]),
                          &b = motion.marker(force.markers[1]);
        const double turn = step_ * std::abs(a.R.col(2).dot(b.w - a.w));
        if (turn > std::numbers::pi && x.first < 0.0) x.first = motion.t;
        x.most = std::max(x.most, turn);
        continue;
      }
      const Vec3 theta = rotation(motion, x);
      if (x.first < 0.0 && theta.dot(x.theta) < 0.0 && quarter(theta) && quarter(x.theta))
        x.first = motion.t;
      x.theta = theta;
    }
  }

  /// The sentence about the first element that exceeded its limit, if there is one.
  void warn(std::vector<RangeWarning>& out) const;

  /// Stores and restores the record, for runs that are continued elsewhere (state_bytes.hpp).
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
    double first = -1.0;        ///< time at which it exceeded the limit [s]; below zero: it did not
    double most = 0.0;          ///< angle in one step [rad]
  };
  static bool quarter(const Vec3& theta) noexcept { return theta.norm() > 0.5 * std::numbers::pi; }
  Vec3 rotation(const SystemMotion& motion, const Watched& x) const noexcept {
    const Element& force = model_.elements[x.force];
    const Mat3 R =
        motion.marker(force.markers[0]).R.transpose() * motion.marker(force.markers[1]).R;
    return quaternion_log(Eigen::Quaterniond(R));
  }

  const Model& model_;
  double step_;
  std::vector<Watched> watched_;
};

class RangeWatch {
 public:
  RangeWatch(const Model& model, double step, const RangeLimits& limits = {});

  std::vector<BodyRange>& bodies() noexcept { return bodies_; }
  const std::vector<BodyRange>& bodies() const noexcept { return bodies_; }
  /// Two per body, its translation and its rotation, then one per mode.
  std::vector<PhaseMeter>& meters(int body) noexcept {
    assert(is_index(body, meters_));
    return meters_[body];
  }
  /// For the force elements that measure rotations.
  TurnWatch& turns() noexcept { return turns_; }
  double step() const noexcept { return step_; }
  /// Energy of all bodies moving by `least_motion` per step [J].
  double noise() const noexcept;
  const RangeLimits& limits() const noexcept { return limits_; }

  /// One sentence for each kind of limit that was exceeded; the balance and the corners, at which
  /// steps were divided, are those of the same run.
  std::vector<RangeWarning> warnings(const EnergySummary& energy, double spectral_radius,
                                     std::span<const TimeCorner> corners) const;
  template <class Stream>
  void serialize(Stream& s) {
    for (BodyRange& body : bodies_) body.serialize(s);
    for (std::vector<PhaseMeter>& of_body : meters_)
      for (PhaseMeter& meter : of_body) meter.serialize(s);
    turns_.serialize(s);
  }

 private:
  const Model& model_;
  double step_;
  RangeLimits limits_;
  std::vector<BodyRange> bodies_;
  std::vector<std::vector<PhaseMeter>> meters_;
  TurnWatch turns_;
};

/// Equilibria outside of the range: bodies with excessive deformation, one sentence per kind.
/// `bodies` are those of the model, in its order.
std::vector<RangeWarning> equilibrium_warnings(const Model& model,
                                               const std::vector<StaticsBody>& bodies,
                                               const RangeLimits& limits = {});

/// Message about a body that spins too fast for its stiffness, w in body axes, in one state.
std::string spin_sentence(const Model& model, const BodyRange& range, int body, const Vec3& w);

}  // namespace floatframe

#pragma once
// Campbell diagram: the modes of a model with a rotor as functions of its speed, in the inertial
// frame, tracked from speed to speed by their shapes; critical speeds; the speed at which the
// system becomes unstable.
//
// A line ends where its mode cannot be tracked, with a note. A critical speed of order n is where a
// frequency crosses n W, |Im lambda| = n W. A crossing of order 1 (unbalance) is critical only if
// forces that rotate with the rotor at its axis do work on the mode: the axis has a lateral
// displacement with a component that whirls with the rotor. Other crossings of order 1 are listed
// separately. Other orders represent any excitation with that many cycles per revolution, in any
// direction: all their crossings are listed. The onset of instability is where Re lambda becomes
// positive, or where a growing motion without oscillation appears. All these speeds are refined
// with systems linearised at the speeds between.
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct CampbellOptions {
  std::string joint;
  double from = 0.0, to = 0.0, step = 0.0;  ///< [rad/s]
  /// Axis of a free joint, in its axes; none: the axis of symmetry of the rotor, or the axis of its
  /// bearings.
  std::optional<Vec3> axis = std::nullopt;
  std::vector<double> orders{1.0};  ///< of critical speeds
  int modes = 12;                   ///< the lowest oscillating ones
};

/// One mode at one speed.
struct CampbellPoint {
  std::complex<double> lambda;  ///< [1/s], Im >= 0; NaN if the mode is unknown
  double whirl = 0.0, across = 0.0;
  std::string kind;        ///< as that of a line; "" if the mode is unknown
  bool unbalance = false;  ///< excites it
  bool known() const noexcept { return lambda.imag() == lambda.imag(); }
  double frequency() const noexcept { return std::abs(lambda.imag()); }  ///< damped [rad/s]
  double damping() const noexcept;
};

struct CampbellLine {
  std::vector<CampbellPoint> points;  ///< of each speed
  /// By the majority of the points: "forward", "backward", "planar"; where the rotor axis has no
  /// lateral displacement "axial or torsion", "bending" (the rotor deforms: flap and lag of
  /// blades), "other bodies" (the rotor hardly moves).
  std::string kind;
};

struct CriticalSpeed {
  int line = 0;
  double order = 1.0;
  double speed = 0.0;      ///< [rad/s]
  double frequency = 0.0;  ///< [rad/s]
  double whirl = 0.0;
};

struct InstabilityOnset {
  int line = 0;                         ///< -1: on no line
  double speed = 0.0, frequency = 0.0;  ///< [rad/s]; 0: it grows without oscillation
};

struct CampbellDiagram {
  std::vector<double> speeds;       ///< [rad/s]
  std::vector<CampbellLine> lines;  ///< ascending by the frequency at the first speed
  std::vector<CriticalSpeed> critical;
  std::vector<CriticalSpeed> crossings;  ///< of order 1, not excited by unbalance
  std::vector<InstabilityOnset> unstable;
  double dependence_on_angle = 0.0;  ///< of eigenvalues, relative
  int rigid = 0;                     ///< modes of frequency zero at the first speed
  int overdamped = 0;                ///< modes that do not oscillate at any speed
  int extra_speeds = 0;              ///< added for tracking the modes
  std::vector<std::string>
      stiffened;           ///< bodies whose stiffening is included without an explicit option
  std::string stiffening;  ///< which, in a sentence without its point; empty: none
  std::vector<std::string> notes;
};

/// Throws InputError for invalid options and rotors, RunError if there is no steady state or if the
/// system depends on the angle of the rotor.
CampbellDiagram campbell(const Model& model, const CampbellOptions& options);

}  // namespace floatframe

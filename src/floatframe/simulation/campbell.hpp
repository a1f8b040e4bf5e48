#pragma once
// Campbell diagram: the vibrations of a model with a rotor over its speed, as seen by who stands
// beside the machine, followed from speed to speed by their shapes; critical speeds; the speed at
// which it becomes unstable.
//
// From one speed to the next modes are paired by the modal assurance criterion of their motions in
// the world, MAC = |m_a^H m_b|^2 / (|m_a|^2 |m_b|^2), and the nearness of their eigenvalues. Where
// pairs are doubtful a speed between is added. A critical speed of order n is where a frequency
// crosses n W, |Im lambda| = n W; of a constant force in turning axes, unbalance, n = 1. The onset
// of instability is where Re lambda becomes positive. Both are refined by the secant method with
// systems of their own.
#include <complex>
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct CampbellOptions {
  std::string joint;
  double from = 0.0, to = 0.0, step = 0.0;  ///< [rad/s]
  Vec3 axis = Vec3::UnitZ();                ///< of a free joint
  std::vector<double> orders{1.0};          ///< of critical speeds
  int modes = 12;                           ///< the lowest that vibrate
};

/// One mode at one speed.
struct CampbellPoint {
  std::complex<double> lambda;  ///< [1/s], Im >= 0
  double whirl = 0.0, across = 0.0;
  double frequency() const noexcept { return std::abs(lambda.imag()); }  ///< damped [rad/s]
  double damping() const noexcept;
};

struct CampbellLine {
  std::vector<CampbellPoint> points;  ///< of each speed
  std::string kind;                   ///< "forward", "backward", "planar", "axial or torsion",
                                      ///< by most of the points
};

struct CriticalSpeed {
  int line = 0;
  double order = 1.0;
  double speed = 0.0;      ///< [rad/s]
  double frequency = 0.0;  ///< [rad/s]
  double whirl = 0.0;
};

struct InstabilityOnset {
  int line = 0;
  double speed = 0.0, frequency = 0.0;  ///< [rad/s]
};

struct CampbellDiagram {
  std::vector<double> speeds;       ///< [rad/s]
  std::vector<CampbellLine> lines;  ///< ascending by the frequency at the first speed
  std::vector<CriticalSpeed> critical;
  std::vector<InstabilityOnset> unstable;
  double dependence_on_angle = 0.0;  ///< of eigenvalues, in parts
  int rigid = 0;                     ///< modes of frequency zero at the first speed
  int overdamped = 0;                ///< modes that do not swing at any speed
  int extra_speeds = 0;              ///< that were added to follow the modes
  std::vector<std::string> notes;
};

/// Throws InputError for options and rotors that are not valid, RunError where there is no steady
/// state, or if the system depends on the angle of the rotor.
CampbellDiagram campbell(const Model& model, const CampbellOptions& options);

/// "forward", "backward", "planar", or "" for a motion of the axis that is not across it.
std::string whirl_word(double whirl, double across);

}  // namespace floatframe

#pragma once
// A model as a linear system of first order about a state, in as many coordinates as it has degrees
// of freedom: for vibrations, stability and controllers, at rest or in motion.
//
// J x = 0 leaves as many increments x of the configuration free as there are degrees of freedom.
// These are chosen among the coordinates of the model, y = S x, as those that the constraints
// determine least: x = N y with S N = 1. With the first derivatives there
//   dv = N w + P y,  S dv = w,  J P = -G N                     velocities fit the constraints  (1)
//   da = N wdot + R y + T w,  J R = -(H N + D P),  J T = -D N  and so do accelerations
//   ydot = w + S Gamma N y
//   N^T M N wdot + N^T (M T + C N) w + N^T (M R + C P + K N) y = 0                              (2)
// so that z = (y, w), zdot = A z is the derivative of the motion itself, not of a frozen frame.
//
// States of elements are unknowns of first order, behind y.
//
// Massless directions have no wdot: without damping they follow the other directions
// statically, with damping they are states of first order. z is then a combination of
// coordinates.
#include <complex>
#include <string>
#include <vector>

#include "floatframe/linear/linearize.hpp"

namespace floatframe {

struct LinearSystem {
  MatX A;                           ///< nz x nz: zdot = A z [1/s]
  MatX x_of, v_of, a_of;            ///< nv x nz: increments, velocities, accelerations of z
  MatX xdot_of;                     ///< nv x nz: rates of the increments, v_of + Gamma x_of
  MatX elements_of;                 ///< ns x nz: changes of the states of elements
  std::vector<std::string> states;  ///< nz: "joint 'crank'", "rate of joint 'crank'", ...
  /// Rows for each body: velocity, angular velocity in body axes, amplitude rates; then for each
  /// body the amplitudes; for each force six measures times the root of their stiffness (or of
  /// zero). These and the positions are empty in a LinearModel.
  MatX rates_of, bends_of, springs_of;
  MatX places_of;                ///< 6 a body: displacement of its origin, rotation; world axes
  std::vector<VecX> amplitudes;  ///< of each body, at the linearisation
  /// Approximate upper frequency [1/s] if A contains the slowest motions only; 0: A is complete.
  double fastest = 0.0;
  int degrees = 0;                 ///< of freedom
  int massless = 0;                ///< of these
  double acceleration = 0.0;       ///< largest of a coordinate at the linearisation [../s2]
  double speed = 0.0;              ///< largest velocity of a coordinate
  std::vector<std::string> notes;  ///< limits of validity, one sentence each
  /// Bodies whose geometric stiffening is included without an explicit option, and the sentence
  /// that names them; empty: none.
  std::vector<std::string> stiffened;
  std::string stiffening;
};

/// One motion e^(lambda t) of a linear system.
struct LinearMode {
  std::complex<double> lambda;        ///< [1/s]; of a pair the one with Im > 0
  Eigen::VectorXcd z;                 ///< |z| = 1
  double frequency() const noexcept;  ///< |lambda| / (2 pi): undamped [Hz]
  double damped() const noexcept;     ///< |Im lambda| / (2 pi) [Hz]
  double damping() const noexcept;    ///< -Re lambda / |lambda|; 0 for a lambda of zero
};

/// One of each pair, ascending by |lambda|. Throws RunError if the eigenvalues do not converge.
std::vector<LinearMode> linear_modes(const LinearSystem& system);

/// Participation in a mode, each list normalised to the sum one.
struct ModeParts {
  std::vector<double> kinetic;  ///< of the bodies
  std::vector<double> bending;  ///< of the potential energy: in the flexible bodies ...
  std::vector<double> springs;  ///< ... and in the force elements
  double potential = 0.0;       ///< of all, over the kinetic energy; near 0: a rigid motion
};
ModeParts mode_parts(const Model& model, const LinearSystem& system, const LinearMode& mode);

/// At the start state given by the options, as `linearize`, both with the geometric stiffening of
/// bodies that spin or carry load there and for which the option is not given. States in motion
/// need relative coordinates: absolute coordinates rotate with the bodies, and their frozen
/// eigenvalues are meaningless; RunError for them. `slowest`, if not 0: for a model with more than
/// `few_degrees`, and twice as many, computes only this number of motions, for z without physical
/// meaning; RunError if not found.
LinearSystem linear_system(const Model& model, const SimulationOptions& options = {},
                           int slowest = 0);

/// Degrees of freedom up to which all eigenvalues take a few seconds.
inline constexpr int few_degrees = 400;

}  // namespace floatframe

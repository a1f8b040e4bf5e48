#pragma once
// The lift s of a follower over the coordinate x of its cam, with both derivatives:
//   segments   rises h over the width w, one after the other from x = 0, with u = (x - x_k) / w
//     harmonic         h (1 - cos(pi u)) / 2                     s'' jumps at its ends
//     cycloidal        h (u - sin(2 pi u) / (2 pi))
//     polynomial_345   h (10 u^3 - 15 u^4 + 6 u^5)
//     polynomial_4567  h (35 u^4 - 84 u^5 + 70 u^6 - 20 u^7)
//     a rise of 0 is a dwell; beyond the ends the lift is held
//   points     a cubic spline (math/cubic_spline.hpp), which goes on along its tangents
//   formula    of x
// (Norton, Cam Design and Manufacturing Handbook, 2009.) A profile with a period repeats.
#include <memory>
#include <numbers>
#include <vector>

#include "floatframe/description/elements.hpp"

namespace floatframe {

struct CamProfile {
  double phase = 0.0;                         ///< x = coordinate - phase
  double period = 0.0;                        ///< 0: none
  std::vector<double> ends{0.0}, lifts{0.0};  ///< of segments, the beginning first
  CamLaw law = CamLaw::cycloidal;
  bool spline = false;
  PiecewisePolynomial pieces;  ///< of a spline
  SharedFormula formula;
  double low = -std::numbers::pi, high = std::numbers::pi;  ///< x where its slopes are looked at

  /// At a coordinate of the cam. Step time.
  PiecewisePolynomial::Value operator()(double coordinate) const noexcept;
  /// The largest |s'| of a period, or of the profile between its ends; of a formula from `low` to
  /// `high`.
  double steepest() const;
};

/// The profile of these keys; of a cam that turns it repeats if it fills a turn. Load time.
CamProfile cam_profile(const Cam& keys, bool turns);
/// From x0 to x1 it is a turn, but for rounding.
bool cam_fills_turn(double x0, double x1);

/// One rise of 1 over a width of 1. Step time.
PiecewisePolynomial::Value cam_rise(CamLaw law, double u) noexcept;

}  // namespace floatframe

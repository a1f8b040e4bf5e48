#pragma once
// The frequency response of a linear model: inputs u e^(i w t) produce outputs G(i w) u e^(i w t)
// after the transient has decayed,
//   G(s) = C (s I - A)^-1 (B0 + s B1 + s^2 B2) + D0 + s D1 + s^2 D2
// with inputs given by their values: heights of roads, values of prescribed motions.
#include <complex>

#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/math/resolvent.hpp"

namespace floatframe {

class FrequencyResponse {
 public:
  /// `linear` must outlive it.
  explicit FrequencyResponse(const LinearModel& linear);

  /// G at s [1/s], outputs x inputs. Throws RunError if s is an eigenvalue: an undamped motion in
  /// resonance, or an unrestrained one at s = 0.
  Eigen::MatrixXcd at(std::complex<double> s) const;
  /// G(i 2 pi f), f [Hz].
  Eigen::MatrixXcd at_frequency(double f) const;

 private:
  const LinearModel& linear_;
  Resolvent resolvent_;
};

}  // namespace floatframe

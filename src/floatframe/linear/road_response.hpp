#pragma once
// Response of a model that drives along x to a random road: one-sided spectral densities and rms
// values of outputs. A road of the wave number n [cycles/m] has the one-sided density
//   G(n) = G0 (n / n0)^-w   [m3],   n0 = 0.1 cycles/m, from 0.011 to 2.83 cycles/m             (1)
// (ISO 8608, w = 2), which at the speed V is S(f) = G(f / V) / V [m2/Hz]. Wheels on one road follow
// each other: the wheel at x_k has the excitation of a wheel at 0 earlier by x_k / V,
//   H_r(f) = sum over the wheels k of the road r  G_k(i 2 pi f) e^(i 2 pi f x_k / V)           (2)
//   S_y(f) = sum over roads |H_r(f)|^2 S(f),   rms^2 = int S_y df
// Different roads of a model are independent of each other. The linear system is that at the
// operating point of the linearisation; roads are lifted without a slope.
#include <string>
#include <vector>

#include "floatframe/linear/linear_ports.hpp"

namespace floatframe {

struct RoadLoading {
  double roughness = 256e-6;     ///< G0 [m3]; class C
  double waviness = 2.0;         ///< w
  double speed = 0.0;            ///< V [m/s]
  double from = 0.1, to = 50.0;  ///< the requested band [Hz]; the road has 0.011 V to 2.83 V
};

struct OutputSpectrum {
  Column output;
  std::vector<double> density;  ///< at the requested frequencies [unit^2/Hz]; 0 outside the band
  double rms = 0.0;             ///< in the band, about the mean
};

struct RoadResponse {
  std::vector<double> frequencies;  ///< [Hz]
  std::vector<OutputSpectrum> outputs;
  double from = 0.0, to = 0.0;  ///< intersection of the bands of the road and the user [Hz]
  double road = 0.0;            ///< rms of the height in the band [m]
  std::vector<std::string> notes;
};

/// Throws InputError if the model has no wheels or the band is empty, and as `linear_model`.
RoadResponse road_response(const Model& model, const std::vector<std::string>& outputs,
                           const std::vector<double>& frequencies, const RoadLoading& loading,
                           const SimulationOptions& options = {});

/// From `from` to `to`, uniform on a logarithmic axis, both included.
std::vector<double> frequencies_between(double from, double to, int count);

}  // namespace floatframe

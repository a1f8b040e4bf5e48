#pragma once
// Response of a rotor to unbalance over its speed: the steady whirl due to an unbalance U = m e [kg
// m] at angle a on the rotor. At each speed W the model turns steadily, as for a Campbell diagram,
// with the force on the axis of the rotor
//   F(t) = U W^2 (e_1 cos(W t + a) + e_2 sin(W t + a))
// with e_1, e_2 fixed and normal to the axis: e_1 is the x axis of a revolute or cylindrical joint,
// of a free joint the axis after that of the rotor in the order x, y, z; e_1 x e_2 has the sense of
// positive speed. Outputs are y = mean + |Y| cos(W t + arg Y): linear, about the steady state. The
// unbalance is small: it is not included in the mass of the model, which must be symmetric.
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

struct Unbalance {
  std::string body;
  std::string node;     ///< of a flexible body, on the axis; none for a rigid one: near its centre
  double moment = 0.0;  ///< U [kg m]
  double angle = 0.0;   ///< a [rad]
};

struct UnbalanceOptions {
  std::string joint;                        ///< of the rotor
  double from = 0.0, to = 0.0, step = 0.0;  ///< [rad/s]
  std::vector<Unbalance> unbalances;        ///< act together
  std::vector<std::string> outputs{};       ///< none: all
  std::optional<Vec3> axis = std::nullopt;  ///< as of CampbellOptions
};

struct UnbalanceCurve {
  Column output;
  std::vector<std::complex<double>> amplitudes;  ///< Y, one for each speed
  std::vector<double> means;
};

struct UnbalanceResponse {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<UnbalanceCurve> curves;
  std::vector<std::string> stiffened;  ///< as of CampbellDiagram
  std::string stiffening;
  std::vector<std::string> notes;  ///< omitted outputs, with reasons
};

/// Throws InputError for invalid options, RunError if there is no steady state, if the rotor is not
/// symmetric, or at a critical speed without damping.
UnbalanceResponse unbalance_response(const Model& model, const UnbalanceOptions& options);

}  // namespace floatframe

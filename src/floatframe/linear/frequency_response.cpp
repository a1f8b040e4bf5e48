#include "floatframe/linear/frequency_response.hpp"

#include <fmt/format.h>

#include <numbers>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

FrequencyResponse::FrequencyResponse(const LinearModel& linear)
    : linear_(linear), resolvent_(linear.system.A) {}

Eigen::MatrixXcd FrequencyResponse::at(std::complex<double> s) const {
  const auto in_powers = [&](const MatX* terms) {
    return Eigen::MatrixXcd(terms[0].cast<std::complex<double>>() + s * terms[1] +
                            s * s * terms[2]);
  };
  Eigen::MatrixXcd z;
  if (!resolvent_.solve(s, in_powers(linear_.B), z))
    throw RunError(ErrorCode::resonance,
                   fmt::format("the response at {:.6g} Hz has no bound: a motion without damping "
                               "is in resonance there, or nothing holds it",
                               std::abs(s) / (2.0 * std::numbers::pi)));
  return linear_.C * z + in_powers(linear_.D);
}

Eigen::MatrixXcd FrequencyResponse::at_frequency(double f) const {
  return at({0.0, 2.0 * std::numbers::pi * f});
}

}  // namespace floatframe

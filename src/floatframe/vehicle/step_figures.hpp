#pragma once
// Figures of a step steer, ISO 7401. Time counts from t_50, the instant at which the steering has
// made 50 % of its change. Of a response y with the value y_0 before and y_s after:
//   response time   until y - y_0 first reaches 90 % of y_s - y_0
//   peak time       until the largest y - y_0 in the direction of y_s - y_0
//   overshoot       (y_peak - y_s)/(y_s - y_0)
//   TB = peak time of the yaw rate times the steady sideslip [s deg]
// Instants between samples are found by straight lines, peaks are samples.
#include <optional>
#include <span>

namespace floatframe {

struct StepResponse {
  double steady = 0.0;                  ///< y_s
  double peak = 0.0;                    ///< y_peak
  std::optional<double> response_time;  ///< [s]; none: 90 % are not reached
  double peak_time = 0.0;               ///< [s]
  double overshoot = 0.0;               ///< [-]; below zero: the steady value is not reached
};

/// The first instant at which y - y_0 crosses `fraction` of y_s - y_0; none if it does not.
/// `t` [s] rises and is as long as `y`.
std::optional<double> time_of_fraction(std::span<const double> t, std::span<const double> y,
                                       double before, double after, double fraction);

/// Mean of y over the last `window` seconds, by the trapezoidal rule.
double mean_at_end(std::span<const double> t, std::span<const double> y, double window);

/// Of the response y from `before` to `steady`, with the times from t_50.
StepResponse step_response(std::span<const double> t, std::span<const double> y, double before,
                           double steady, double t_50);

/// TB [s deg] of a sideslip in rad.
double tb_value(const StepResponse& yaw_rate, double steady_sideslip) noexcept;

}  // namespace floatframe

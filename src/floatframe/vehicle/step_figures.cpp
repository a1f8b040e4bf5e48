#include "floatframe/vehicle/step_figures.hpp"

#include <cassert>
#include <cstddef>
#include <numbers>

namespace floatframe {

std::optional<double> time_of_fraction(std::span<const double> t, std::span<const double> y,
                                       double before, double after, double fraction) {
  assert(t.size() == y.size());
  if (t.empty() || after == before) return std::nullopt;
  const auto done = [&](std::size_t k) { return (y[k] - before) / (after - before); };
  if (done(0) >= fraction) return t[0];
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double a = done(k - 1), b = done(k);
    if (b >= fraction) return t[k - 1] + (t[k] - t[k - 1]) * (fraction - a) / (b - a);
  }
  return std::nullopt;
}

double mean_at_end(std::span<const double> t, std::span<const double> y, double window) {
  assert(t.size() == y.size() && !t.empty());
  double area = 0.0, span = 0.0;
  for (std::size_t k = t.size(); k-- > 1;) {
    if (t[k - 1] < t.back() - window * (1.0 + 1e-9)) break;
    area += 0.5 * (y[k] + y[k - 1]) * (t[k] - t[k - 1]);
    span += t[k] - t[k - 1];
  }
  return span > 0.0 ? area / span : y.back();
}

StepResponse step_response(std::span<const double> t, std::span<const double> y, double before,
                           double steady, double t_50) {
  assert(t.size() == y.size() && !t.empty());
  StepResponse out{.steady = steady, .peak = y[0], .response_time = {}, .peak_time = t[0] - t_50};
  const double direction = steady < before ? -1.0 : 1.0;
  for (std::size_t k = 1; k < t.size(); ++k)
    if (direction * (y[k] - out.peak) > 0.0) out.peak = y[k], out.peak_time = t[k] - t_50;
  if (steady != before) out.overshoot = (out.peak - steady) / (steady - before);
  if (const auto at = time_of_fraction(t, y, before, steady, 0.9)) out.response_time = *at - t_50;
  return out;
}

double tb_value(const StepResponse& yaw_rate, double steady_sideslip) noexcept {
  return yaw_rate.peak_time * steady_sideslip * 180.0 / std::numbers::pi;
}

}  // namespace floatframe

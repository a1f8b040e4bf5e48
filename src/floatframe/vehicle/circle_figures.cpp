#include "floatframe/vehicle/circle_figures.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floatframe {

// Newton's form of the parabola through points i, j, k, differentiated at x:
//   y' = [i,j] + [i,j,k] (2 x - x_i - x_j)
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() == y.size() && x.size() >= 2);
  const std::size_t n = x.size();
  const auto divided = [&](std::size_t i, std::size_t j) { return (y[j] - y[i]) / (x[j] - x[i]); };
  if (n == 2) return {divided(0, 1), divided(0, 1)};
  std::vector<double> out(n);
  for (std::size_t p = 0; p < n; ++p) {
    const std::size_t i = std::clamp<std::size_t>(p, 1, n - 2) - 1, j = i + 1, k = i + 2;
    const double second = (divided(j, k) - divided(i, j)) / (x[k] - x[i]);
    out[p] = divided(i, j) + second * (2.0 * x[p] - x[i] - x[j]);
  }
  return out;
}

std::vector<CircleFigures> circle_figures(const std::vector<CirclePoint>& points,
                                          const AxleDistances& axles) {
  std::vector<double> ay, steering, excess, sideslip, roll;
  std::vector<CircleFigures> out(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CirclePoint& p = points[k];
    const double curvature = p.yaw_rate / p.speed;
    out[k].ackermann = axles.wheelbase() * curvature;
    out[k].front_slip = p.steering - p.sideslip - axles.front * curvature;
    out[k].rear_slip = axles.rear * curvature - p.sideslip;
    ay.push_back(p.lateral_acceleration);
    steering.push_back(p.steering);
    excess.push_back(p.steering - out[k].ackermann);
    sideslip.push_back(p.sideslip);
    roll.push_back(p.roll);
  }
  if (points.size() < 2) return out;
  const std::vector<double> of_steering = slopes(ay, steering), of_excess = slopes(ay, excess),
                            of_sideslip = slopes(ay, sideslip), of_roll = slopes(ay, roll);
  for (std::size_t k = 0; k < points.size(); ++k) {
    CircleFigures& f = out[k];
    f.steering_gradient = of_steering[k];
    f.understeer_gradient = of_excess[k];
    f.sideslip_gradient = of_sideslip[k];
    f.roll_gradient = of_roll[k];
    if (f.understeer_gradient > 0.0)
      f.characteristic = std::sqrt(axles.wheelbase() / f.understeer_gradient);
    if (f.understeer_gradient < 0.0)
      f.critical = std::sqrt(-axles.wheelbase() / f.understeer_gradient);
  }
  return out;
}

}  // namespace floatframe

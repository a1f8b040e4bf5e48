#include "floatframe/model/coupled_spring.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {

PiecewisePolynomial spring_with_play(double stiffness, double play) {
  if (!(play > 0.0)) return PiecewisePolynomial::linear(stiffness, 0.0);
  const double half = 0.5 * play;
  return {{-half, half}, {{-half, {0.0, stiffness}}, {0.0, {0.0}}, {half, {0.0, stiffness}}}};
}

CoupledSpring coupled_spring_example(std::size_t regime, ElementExample& x,
                                     ExampleNumbers& numbers) {
  x.markers.clear();
  for (int k = 0; k < 2; ++k) {
    const MarkerState a = numbers.marker();
    x.markers.insert(x.markers.end(), {a, numbers.marker_on_axis(a)});
  }
  x.element.rotational = true;
  CoupledSpring spring{{}, numbers(1.0, 3.0), numbers(0.5, 2.0)};
  const auto angle = [&](std::size_t k) {
    return angle_about_z<double>(x.markers[k], x.markers[k + 1], 0.0);
  };
  const double s = std::abs(angle(0) + spring.factor * angle(2));
  const double play = regime == 2 ? s : regime == 3 ? 2.0 * s + 1.0 : 0.0;
  spring.spring = spring_with_play(numbers(100.0, 400.0), play);
  if (regime == 2) spring.damping *= std::min(1.0, 0.5 * s);  // it stays on the flank
  return spring;
}

}  // namespace floatframe

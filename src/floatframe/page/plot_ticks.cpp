#include "floatframe/page/plot_ticks.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {

Ticks nice_ticks(double low, double high, int about) {
  const double rough = (high - low) / std::max(about, 1);
  if (!(rough > 0.0) || !std::isfinite(rough)) return {low, 1.0, 1};
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough * (1.0 - 1e-9)) {
      step = factor * decade;
      break;
    }
  }
  constexpr double slack = 1e-9;
  const double from = std::ceil(low / step - slack), to = std::floor(high / step + slack);
  return {from * step, step, static_cast<int>(to - from) + 1};
}

}  // namespace floatframe

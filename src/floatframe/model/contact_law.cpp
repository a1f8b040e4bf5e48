#include "floatframe/model/contact_law.hpp"

namespace floatframe {

double damping_of_restitution(double e) {
  if (!(e < 1.0)) return 0.0;
  double low = 0.0, high = 1.0 / e;
  for (int k = 0; k < 200; ++k) {
    const double c = 0.5 * (low + high);
    (c * (1.0 + e) > std::log1p(c) - std::log1p(-c * e) ? low : high) = c;
  }
  return 0.5 * (low + high);
}

}  // namespace floatframe

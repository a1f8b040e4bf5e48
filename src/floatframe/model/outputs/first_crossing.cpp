// The time at which a formula first crossed zero, which loops of steps look for (Crossing); not a
// number before. Where nothing steps, in linear systems, it is zero.
#include <limits>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::first_crossing>(const SystemMotion&, const Output&,
                                                   FollowedOutput& last) noexcept {
  if (!last.started) return 0.0;
  return last.values[Crossing::found] != 0.0 ? last.values[Crossing::time]
                                             : std::numeric_limits<double>::quiet_NaN();
}

constinit const OutputKind first_crossing_output = {
    .about = "time at which the formula first crossed zero, within 1e-10 s; `nan` before",
    .of = OutputOf::crossing,
    .components = crossing_directions,
    .unit = "s"};

}  // namespace floatframe

// Strain along a direction at a location of a flexible body, as measured by a strain gauge
// (model/gauge.hpp). Three of them at 0, 45 and 90 degrees are a rosette.
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::strain>(const SystemMotion& motion, const Output& output,
                                           FollowedOutput&) noexcept {
  assert(is_index(output.gauge, motion.model.gauges));
  return gauge_values(motion, motion.model.gauges[output.gauge])(0);
}

constinit const OutputKind strain_output = {
    .about = "along `direction` at a place of a flexible body, as a strain gauge reads it",
    .of = OutputOf::gauge,
    .unit = "-",
    .needs_of_motion = {.accelerations = true}};

}  // namespace floatframe

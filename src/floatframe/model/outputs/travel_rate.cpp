// Rate of the travel of a point along the curve of its constraint [m/s].
#include "floatframe/model/curve_row.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::travel_rate>(const SystemMotion& motion, const Output& output,
                                                FollowedOutput&) noexcept {
  const Element& element = motion.model.elements[output.element];
  const MarkerState &a = motion.marker(element.markers[0]), &b = motion.marker(element.markers[1]);
  return foot_of_curve(&data_of<SpaceCurve>(element), a, b).rate(rate_against_curve(a, b));
}

constinit const OutputKind travel_rate_output = {
    .about = "rate of the `travel`", .of = OutputOf::path, .unit = "m/s"};

}  // namespace floatframe

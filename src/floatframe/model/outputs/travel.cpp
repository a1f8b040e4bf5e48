// Travel of a point along the curve of its constraint: the parameter u of its foot, of a path the
// length from its first point as drawn [m], however it bends.
#include "floatframe/model/curve_row.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::travel>(const SystemMotion& motion, const Output& output,
                                           FollowedOutput&) noexcept {
  const Element& element = motion.model.elements[output.element];
  const MarkerState &a = motion.marker(element.markers[0]), &b = motion.marker(element.markers[1]);
  return foot_of_curve(&data_of<SpaceCurve>(element), a, b).u;
}

constinit const OutputKind travel_output = {
    .about =
        "where a point is along its path or its curve through points: the length from the "
        "first point, as drawn",
    .of = OutputOf::path,
    .unit = "m"};

}  // namespace floatframe

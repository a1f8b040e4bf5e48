// Distance of two points, |p_WB - p_WA| [m].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::distance>(const SystemMotion& motion, const Output& output,
                                             FollowedOutput&) noexcept {
  return (motion.marker(output.to).r - motion.marker(output.marker).r).norm();
}

constinit const OutputKind distance_output = {
    .about = "length of the line between them", .of = OutputOf::two_points, .unit = "m"};

}  // namespace floatframe

// Rate of the distance of two points [m/s]: n . (v_WB - v_WA), n the unit vector along p_WB - p_WA;
// zero where they meet.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S distance_rate_measure(const MeasurePorts<S>& in) noexcept {
  const Eigen::Matrix<S, 3, 1> d = in.to->r - in.marker->r;
  if (!(value_of(S(d.squaredNorm())) > 0.0)) return 0.0;
  return d.dot(in.to->v - in.marker->v) / d.norm();
}

}  // namespace

FLOATFRAME_MEASURED(distance_rate)

constinit const OutputKind distance_rate_output = {.about = "rate of the `distance`",
                                                   .of = OutputOf::two_points,
                                                   .unit = "m/s",
                                                   FLOATFRAME_MEASURE(distance_rate)};

}  // namespace floatframe

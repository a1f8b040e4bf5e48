// Distance of two points, |p_WB - p_WA| [m].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S distance_measure(const MeasurePorts<S>& in) noexcept {
  return (in.to->r - in.marker->r).norm();
}

}  // namespace

FLOATFRAME_MEASURED(distance)

constinit const OutputKind distance_output = {.about = "length of the line between them",
                                              .of = OutputOf::two_points,
                                              .unit = "m",
                                              FLOATFRAME_MEASURE(distance)};

}  // namespace floatframe

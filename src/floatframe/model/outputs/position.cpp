// Position of a point, p_WP [m], or p_WP - p_WF from the origin of a frame F.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S position_measure(const MeasurePorts<S>& in) noexcept {
  return in.along(in.position());
}

}  // namespace

FLOATFRAME_MEASURED(position)

constinit const OutputKind position_output = {
    .about = "in the world, or from the origin of `relative_to`",
    .of = OutputOf::point,
    .components = world_axes,
    .unit = "m",
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::point,
    FLOATFRAME_MEASURE(position)};

}  // namespace floatframe

// Angular velocity of a body, w_WB [rad/s], or w_WB - w_WF from a frame F.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S angular_velocity_measure(const MeasurePorts<S>& in) noexcept {
  return in.along(in.angular_velocity());
}

}  // namespace

FLOATFRAME_MEASURED(angular_velocity)

constinit const OutputKind angular_velocity_output = {
    .about = "in the world, or from that of `relative_to`",
    .of = OutputOf::body,
    .components = world_axes,
    .unit = "rad/s",
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::axial,
    FLOATFRAME_MEASURE(angular_velocity)};

}  // namespace floatframe

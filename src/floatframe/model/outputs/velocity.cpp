// Velocity of a point, dp_WP/dt [m/s], or as seen in a frame F that moves:
//   v_P - v_F - w_F x (p_P - p_F)
// whose components in the axes of F are the rates of those of the position.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S velocity_measure(const MeasurePorts<S>& in) noexcept {
  return in.along(in.velocity());
}

}  // namespace

FLOATFRAME_MEASURED(velocity)

constinit const OutputKind velocity_output = {
    .about = "in the world, or as seen from `relative_to`",
    .of = OutputOf::point,
    .components = world_axes,
    .unit = "m/s",
    .frames = OutputFrames::relative_to_and_in,
    .reflects = Reflects::polar,
    FLOATFRAME_MEASURE(velocity)};

}  // namespace floatframe

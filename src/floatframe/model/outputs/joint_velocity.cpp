// Rate of a joint coordinate, measured at its frames F and M, as in H v.
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

const char* joint_velocity_unit(const Model& model, const Output& output) {
  return joint_unit_name(model.joints[output.joint].type, output.component, true);
}

template <class S>
S joint_velocity_measure(const MeasurePorts<S>& in) noexcept {
  return joint_velocity(in.model.joints[in.output.joint], *in.marker, *in.to, in.output.component);
}

}  // namespace

FLOATFRAME_MEASURED(joint_velocity)

constinit const OutputKind joint_velocity_output = {
    .about = "rate of the coordinate; of rotation vectors the angular velocity",
    .of = OutputOf::joint,
    .unit = "m/s or rad/s",
    .unit_of = joint_velocity_unit,
    FLOATFRAME_MEASURE(joint_velocity)};

}  // namespace floatframe

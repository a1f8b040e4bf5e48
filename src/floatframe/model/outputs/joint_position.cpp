// Coordinate of a joint, measured at its frames F and M. Turns of angles are counted with the mean
// velocity since the last sample: of the possible angles the value is that nearest to
//   q_last + (t - t_last) (qdot_last + qdot) / 2
// The first one is nearest to `SystemMotion::start_position`.
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

const char* joint_position_unit(const Model& model, const Output& output) {
  return joint_unit_name(model.joints[output.joint].type, output.component);
}

template <class S>
S joint_position_measure(const MeasurePorts<S>& in) noexcept {
  return joint_position(in.model.joints[in.output.joint], *in.marker, *in.to, in.output.component,
                        in.reference);
}

}  // namespace

template <>
double output_value_of<OutputType::joint_position>(const SystemMotion& motion, const Output& output,
                                                   FollowedOutput& last) noexcept {
  auto& [started, time, values, parts] = last;
  double &q = values[0], &qdot = values[1];
  MeasurePorts<double> in = measure_ports(motion, output);
  const double rate =
      joint_velocity(in.model.joints[output.joint], *in.marker, *in.to, output.component);
  in.reference = started ? q + 0.5 * (motion.t - time) * (qdot + rate)
                         : motion.start_position(output.joint, output.component);
  started = true;
  time = motion.t;
  qdot = rate;
  return q = joint_position_measure(in);
}

constinit const OutputKind joint_position_output = {.about = "coordinate; full turns are counted",
                                                    .of = OutputOf::joint,
                                                    .unit = "m or rad",
                                                    .unit_of = joint_position_unit,
                                                    FLOATFRAME_MEASURE(joint_position)};

}  // namespace floatframe

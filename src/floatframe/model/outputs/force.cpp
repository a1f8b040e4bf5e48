// Scalar force of a force element, tension positive [N], or its torque [N m]; or another value of
// one that has several, in its own unit.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

const char* unit_of_value(const Model& model, const Output& output) {
  return value_unit(model.elements[output.element], output.component);
}

}  // namespace

template <>
double output_value_of<OutputType::force>(const SystemMotion& motion, const Output& output,
                                          FollowedOutput&) noexcept {
  return motion.effort(output.element).result(output.component > 0 ? 2 + output.component : 0);
}

constinit const OutputKind force_output = {
    .about = "force or torque, tension positive; of a tyre or bearing the contact force",
    .of = OutputOf::force,
    .unit = "N or N m, of further values their own",
    .unit_of = unit_of_value,
    .is_signal = true,
    .one_of_values = true};

}  // namespace floatframe

// Dispatch of the outputs: data for load time, direct calls for samples.
#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KIND(name) &name##_output,
constexpr const OutputKind* output_list[] = {FLOATFRAME_OUTPUTS(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

template <std::size_t... I>
double value_of_type(std::index_sequence<I...>, const SystemMotion& motion, const Output& output,
                     FollowedOutput& last) noexcept {
  double value = 0.0;
  static_cast<void>(((output.type == output_types[I] &&
                      (value = output_value_of<output_types[I]>(motion, output, last), true)) ||
                     ...));
  return value;
}

}  // namespace

const OutputKind& output_kind(OutputType type) noexcept {
  assert(index_of(type) < std::size(output_list));
  return *output_list[index_of(type)];
}

std::array<int, 4> measure_markers(const Model& model, const Output& output) noexcept {
  if (output.joint < 0) return {output.marker, output.to, output.relative, output.axes};
  assert(is_index(output.joint, model.joints));
  const Joint& joint = model.joints[output.joint];
  return {joint.frame_F, joint.frame_M, -1, -1};
}

double mass_of(const Model& model, int body) noexcept {
  if (body >= 0) return model.bodies[body].data->invariants.m;
  double sum = 0.0;
  for (const Body& b : model.bodies) sum += b.data->invariants.m;
  return sum;
}

MotionNeeds needs_of_outputs(const Model& model) noexcept {
  MotionNeeds all;
  for (const Output& o : model.outputs) all = all | needs_of(o);
  return all;
}

MotionNeeds needs_of(const Output& output) noexcept {
  MotionNeeds all = output_kind(output.type).needs_of_motion;
  if (output.formula)
    for (const FormulaOperand& x : output.formula->operands) all = all | needs_of(x.output);
  return all;
}

std::vector<FollowedOutput> followed_outputs(std::span<const Output> outputs) {
  std::vector<FollowedOutput> out(outputs.size());
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (outputs[k].formula) out[k].parts.resize(outputs[k].formula->operands.size());
  return out;
}

double output_value(const SystemMotion& motion, const Output& output,
                    FollowedOutput& last) noexcept {
  assert(std::isfinite(motion.t));
  return output.factor *
         value_of_type(std::make_index_sequence<std::size(output_types)>{}, motion, output, last);
}

}  // namespace floatframe

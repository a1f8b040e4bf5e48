// State of an element, a variable of first order of its law.
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::state>(const SystemMotion& motion, const Output& output,
                                          FollowedOutput&) noexcept {
  assert(is_index(output.element, motion.states));
  assert(output.component < motion.model.elements[output.element].states);
  return motion.states[output.element][output.component];
}

constinit const OutputKind state_output = {
    .about = "variable of first order of its law", .of = OutputOf::state, .unit = "-"};

}  // namespace floatframe

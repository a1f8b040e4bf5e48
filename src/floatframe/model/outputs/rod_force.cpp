// Force in a rod, tension positive [N].
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::rod_force>(const SystemMotion& motion, const Output& output,
                                              FollowedOutput&) noexcept {
  assert(is_index(output.element, motion.reactions->forces));
  return motion.reactions->forces[output.element];
}

constinit const OutputKind rod_force_output = {.about = "force in the rod, tension positive",
                                               .of = OutputOf::rod,
                                               .unit = "N",
                                               .needs_of_motion = {.reactions = true}};

}  // namespace floatframe

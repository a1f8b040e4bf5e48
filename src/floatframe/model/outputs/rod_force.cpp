// Force in a rod, tension positive [N].
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::rod_force>(const OutputView& view, const Output& output,
                                              FollowedOutput&) noexcept {
  return view.reactions().tensions[output.rod];
}

constinit const OutputKind rod_force_output = {.about = "force in the rod, tension positive",
                                               .of = OutputOf::rod,
                                               .unit = "N",
                                               .terms = OutputTerms::reactions};

}  // namespace floatframe

#include "floatframe/reduction/mode_set.hpp"

namespace floatframe {

FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants) {
  FlexibleBody body;
  body.invariants = std::move(invariants);
  body.D = MatX::Zero(modes.K.rows(), modes.K.cols());
  body.K = std::move(modes.K);
  body.fixed_interface_frequencies = std::move(modes.frequencies);
  body.equal_left_out = modes.equal_left_out;
  body.mode_names = std::move(modes.names);
  return body;
}

}  // namespace floatframe

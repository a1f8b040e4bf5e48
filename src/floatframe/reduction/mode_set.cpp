#include "floatframe/reduction/mode_set.hpp"

namespace floatframe {

int with_whole_pair(const VecX& omega, Eigen::Index kept) {
  const bool more =
      kept > 0 && kept < omega.size() && equal_frequency(omega[kept - 1], omega[kept]);
  Eigen::Index begin = kept - 1;
  while (more && begin > 0 && equal_frequency(omega[begin - 1], omega[kept - 1])) --begin;
  return static_cast<int>(more && (kept - begin) % 2 == 1 ? kept + 1 : kept);
}

FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants) {
  FlexibleBody body;
  body.invariants = std::move(invariants);
  body.D = MatX::Zero(modes.K.rows(), modes.K.cols());
  body.K = std::move(modes.K);
  body.fixed_interface_frequencies = std::move(modes.frequencies);
  body.mode_names = std::move(modes.names);
  return body;
}

}  // namespace floatframe

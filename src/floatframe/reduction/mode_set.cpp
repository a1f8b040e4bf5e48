#include "floatframe/reduction/mode_set.hpp"

#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

MatX modal_damping(const MatX& K, const MatX& M, double ratio) {
  MatX D = MatX::Zero(K.rows(), K.cols());
  if (ratio == 0.0 || K.rows() == 0) return D;
  const SymmetricEigen inverse = generalised_eigen(M, K);
  if (!inverse.found) {
    throw InputError("modal damping needs a positive definite modal stiffness");
  }
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    const double mu = inverse.values(i);
    if (!(mu > 1e-14 * inverse.values(K.rows() - 1))) continue;
    const VecX Kx = K * inverse.vectors.col(i);
    D += 2.0 * ratio * std::sqrt(mu) * Kx * Kx.transpose();
  }
  return 0.5 * (D + D.transpose());
}

FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants, double damping_ratio) {
  FlexibleBody body;
  body.invariants = std::move(invariants);
  body.K = std::move(modes.K);
  body.D = modal_damping(body.K, modal_mass(body.invariants), damping_ratio);
  body.fixed_interface_frequencies = std::move(modes.frequencies);
  body.equal_left_out = modes.equal_left_out;
  body.mode_names = std::move(modes.names);
  return body;
}

}  // namespace floatframe

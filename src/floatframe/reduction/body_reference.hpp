#pragma once
// Motion of the body frame, and the remaining modes. With a raw basis X that spans the rigid
// motions, six conditions B on its amplitudes remove six directions:
//   mean axis   int X dm = 0,  int r_u x X dm = 0
//   Buckens     int X dV = 0,  int r_u x X dV = 0
//   node        translation and rotation of the node are zero
// In the null space C of B the modes are those of (C^T K C, C^T M_ff C): M_ff = I and K diagonal,
// which is the best possible conditioning of the basis.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

struct ElasticModes {
  MatX C;                  ///< raw modes x new modes
  VecX lambda;             ///< w^2 of (K, M_ff) in these directions, ascending
  double mass = 1.0;       ///< relative modal mass (body/modal_mass.hpp)
  double condition = 1.0;  ///< of M_ff of the raw directions, each scaled to one
  /// Strain energy of the first mode against the sum of its parts without their signs,
  /// c^T K c / |c|^T |K| |c|: rounding if the mode is a mechanism.
  double stiffness = 1.0;
  int without_mass = 0;  ///< massless combinations, which are omitted
};

/// K: raw stiffness; the raw shapes must be of equal size, rotations counted times the size of the
/// body, or a small mass is taken as zero. Throws InputError if the conditions are not independent
/// on the rigid motions, or if a combination of modes has neither mass nor stiffness.
ElasticModes elastic_modes(const MatX& K, const InertiaInvariants& raw, const MatX& B);
inline constexpr double least_stiffness = 1e-10;

/// The conditions of a part on its modes, 6 x modes; `raw`: the integrals of the basis.
MatX reference_conditions(const PlacedPart& part, const ModeBasis& basis,
                          const InertiaInvariants& raw);

/// The same on all dofs, 6 x n; `loads`: of the masses (body_loads).
MatX reference_rows(const PlacedPart& part, const MatX& loads);

}  // namespace floatframe

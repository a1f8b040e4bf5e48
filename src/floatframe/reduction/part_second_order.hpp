#pragma once
// Displacements of second order (body/second_order.hpp) of a part: the stress stiffness of unit
// loads in its modes. Unit loads f are
//   rho e_j, rho r_ui e_j    as the inertia integrals weigh (PointModel): for S2 and S2i
//   force e_j, moment e_j    at every interface and marker: for h and theta
// The body reference B u = 0 carries what a load has of resultants (of mean axes: the inertia
// forces of a free body),
//   f_eq = f - B^T (B R)^-T R^T f,   K w = f_eq
// and the stress of w does not depend on its rigid motion. A structure held at its interfaces
// answers with its factors of the inner dofs and its Guyan stiffness,
//   w = X_c u_b + (0, K_ii^-1 f_i),   (X_c^T K X_c) u_b = X_c^T f_eq
// a free one by inertia relief.
//
// Spiders are linear, also here: what they hold moves by theta x r, without what follows,
// 1/2 theta x (theta x r). Of nodes in a ring about the reference that sums up to nothing; a
// reference far from its nodes lacks it.
#include <memory>
#include <optional>

#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

/// n x 12: rho e_1..3, then rho r_u1 e_1..3, rho r_u2 e_1..3, rho r_u3 e_1..3.
MatX body_loads(const PointModel& points);
/// The conditions of mean axes, 6 x n: momentum and angular momentum of the columns of body_loads.
MatX momentum_rows(const MatX& loads);

/// What the displacements w are asked for: 12 body loads, then three forces and three moments of
/// each interface, of each marker.
struct UnitCases {
  MatX loads;  ///< n x 12
  MatX B;      ///< 6 x n
  const MatX& R;
  const std::vector<InterfacePlace>& interfaces;
  const std::vector<MarkerPlace>& markers;
};
/// n x cases; the first modes of `basis` are the constraint modes of `fixed`.
MatX held_response(const FeSystem& system, const UnitCases& cases, const FixedInterface& fixed,
                   const ModeBasis& basis);
MatX free_response(const FeSystem& system, const UnitCases& cases, const FreeStructure& structure,
                   const Eigenpairs& elastic);

/// Of the modes X (n x nm); `nodes`: interfaces, then markers.
std::shared_ptr<const SecondOrder> part_second_order(const FeModel& model, const FeSystem& system,
                                                     const MatX& X, const MatX& response,
                                                     std::size_t nodes, Integration integration);

}  // namespace floatframe

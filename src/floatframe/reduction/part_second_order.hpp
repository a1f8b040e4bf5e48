#pragma once
// Displacements of second order (body/second_order.hpp) of a part: the stress stiffness of unit
// loads in its modes. Unit loads f are
//   rho e_j, rho r_ui e_j    with the weights of the inertia integrals (PointModel): for S2 and S2i
//   force e_j, moment e_j    at every interface and marker: for h and theta
// The body reference B u = 0 carries the resultants of a load (for mean axes: the inertia
// forces of a free body),
//   f_eq = f - B^T (B R)^-T R^T f,   K w = f_eq
// and the stress of w does not depend on its rigid motion. A structure held at its interfaces
// responds with its factors of the inner dofs and its Guyan stiffness,
//   w = X_c u_b + (0, K_ii^-1 f_i),   (X_c^T K X_c) u_b = X_c^T f_eq
// a free one by inertia relief.
//
// Nodes i that are fixed rigidly to another node r (rigid_leaders) have additional displacements of
// second order, c_i = 1/2 theta_r x (theta_r x (x_i - x_r)). With the forces F_i of the
// elements on them under the load,
//   f . u2 = -int sigma : eps2 - sum (F_i - f_i) . c_i
// where the body reference holds u2 without the c_i.
// For masses that rotate with a node f_i . c_i is part of `turning` (part_turning.hpp), as is the
// part of torques on the twist of beams; here is the remainder.
#include <memory>
#include <optional>

#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

/// n x 12: rho e_1..3, then rho r_u1 e_1..3, rho r_u2 e_1..3, rho r_u3 e_1..3.
MatX body_loads(const PointModel& points);
/// The conditions of mean axes, 6 x n: momentum and angular momentum of the columns of body_loads.
MatX momentum_rows(const MatX& loads);

/// The displacements w of all unit loads: 12 body loads (`loads`, n x 12), then three forces and
/// three moments of each interface, of each marker. B: 6 x n. The first modes of `basis` are the
/// constraint modes of `fixed`.
MatX held_response(const PlacedPart& part, const MatX& loads, const MatX& B,
                   const FixedInterface& fixed, const ModeBasis& basis);
MatX free_response(const PlacedPart& part, const MatX& loads, const MatX& B,
                   const FreeStructure& structure, const Eigenpairs& elastic);

struct PartSecondOrder {
  std::shared_ptr<const SecondOrder> stiffening;  ///< nodes: interfaces, then markers
  std::optional<SecondOrder> twist;               ///< of beams, on the masses
};
/// For the modes X (n x nm).
PartSecondOrder part_second_order(const PlacedPart& part, const PointModel& points, const MatX& X,
                                  const MatX& response);

}  // namespace floatframe

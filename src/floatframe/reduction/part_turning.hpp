#pragma once
// Displacements of second order of the masses of a part that rotate with its nodes, with or
// without stiffening: of points on arms, 1/2 theta x (theta x arm), and the twist of
// second order of beams that are bent in two planes (part_second_order.hpp).
#include <memory>
#include <optional>
#include <span>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// Masses of the points with 1, r_u1, r_u2, r_u3.
MatX weighted_fields(const PointModel& points);

/// S2 and S2i of columns that are symmetric matrices: of rho e_j (3), then of rho r_ui e_j.
SecondOrder integrals_of(const MatX& packed);
void add_integrals(const SecondOrder& from, SecondOrder& to);

/// S2 and S2i of the arms, weighed by the masses of the points, of the modes X (n x nm).
SecondOrder turning_of(const PointModel& points, std::span<const PointArm> arms, const MatX& X);

/// Null: no rotating masses.
std::shared_ptr<const SecondOrder> part_turning(const PointModel& points, const MatX& X,
                                                const std::optional<SecondOrder>& twist);

/// Points for the projection method.
std::shared_ptr<const ProjectionData> projection_of(const PointModel& points, const MatX& X,
                                                    const std::optional<SecondOrder>& twist);

/// The symmetric matrix D of theta^T D theta = f . (theta x (theta x arm)) for Q = f arm^T, six
/// entries (xx, yy, zz, xy, yz, zx).
Vec6 turning_form(const Mat3& Q);

}  // namespace floatframe

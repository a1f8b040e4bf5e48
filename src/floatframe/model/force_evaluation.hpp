#pragma once
// Force elements between two markers (a may be absent). A force is a scalar f(s, sdot) of a measure
// s with gradient g: generalised force Q = -f g (tension positive), tangents -dQ/dq = f_s g g^T + f
// (dg/dq), -dQ/dqdot = f_sdot g g^T. Each element returns its wrenches, the rows of its tangent,
// and what outputs want to know.
//   spring_damper  s = |r_b - r_a|, g along the line; f (I - n n^T)/s is its geometric stiffness
//   guided_spring  s = e.(r_a - r_b), e fixed in the body of a; the reaction acts on a at the point
//   r_b joint_spring   s = displacement along, or angle about, z of a tyre           vertical: f =
//   max(0, k (R - h) + damping) upwards; radial: along the road normal force, torque  direction *
//   magnitude(t)
#include <span>

#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct TangentRow {
  WrenchRow g;
  double k = 0.0;  ///< weight of g g^T in -dQ/dq [N/m]
  double c = 0.0;  ///< weight of g g^T in -dQ/dqdot [N s/m]
};

struct ForceState {
  WrenchRow wrench;  ///< force and torque on a and b (world axes, at the markers' points)
  TangentRow rows[3];
  int row_count = 0;
  double force = 0.0, length = 0.0, rate = 0.0;
  double energy = 0.0;  ///< potential energy [J]
};

/// Height and slope of a road at x.
struct RoadPoint {
  double z = 0.0, slope = 0.0;
};
RoadPoint road_at(const Road& road, double x) noexcept;

/// `origin`: the point that the markers' positions are measured from. `reference_angle` picks the
/// turn of a joint angle: the result lies within half a turn of it. `inputs`: values of
/// `model.inputs`; the tangent rows hold at fixed inputs.
void evaluate_force(const Model& model, const Force& force, const MarkerState& a,
                    const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                    ForceState& out, std::span<const double> inputs = {}) noexcept;

/// Potential energy of a law: integral of spring(s) from 0 to s (from the nearest end of its first
/// piece outwards).
double law_energy(const PiecewisePolynomial& law, double s) noexcept;

}  // namespace floatframe

#pragma once
// Force elements between two markers (a may be absent). Most are a scalar f(s, sdot) of a measure s
// with gradient g, tension positive: generalised force Q = -f g. The formulas are given in the file
// of each type (model/forces/<type>.cpp).
//
// A step needs the wrench and the part of the tangent that a symmetric factorisation can use: rows
// g with weights, -dQ/dq ~ sum k g g^T, -dQ/dqdot ~ sum c g g^T. The exact derivatives are in
// ForceTangent. The terms omitted in the rows are listed for each kind in its regimes and checked
// by the tests: the dependence of rates on positions (smaller than the damping by h |v| / s, h the
// step), the rotation of axes and loads, all nonsymmetric terms. This costs iterations, not
// accuracy.
#include <cstdint>
#include <span>

#include "floatframe/model/law_energy.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/road.hpp"

namespace floatframe {

struct TangentRow {
  WrenchRow g;
  double k = 0.0;  ///< weight of g g^T in -dQ/dq [N/m]
  double c = 0.0;  ///< weight of g g^T in -dQ/dqdot [N s/m]
};

struct ForceState {
  WrenchRow wrench;  ///< force and torque on a and b (world axes, at the markers' points)
  TangentRow rows[9];
  int row_count = 0;
  double force = 0.0, length = 0.0, rate = 0.0;
  double energy = 0.0;  ///< potential energy [J]
  /// For springs: rate of the energy in the present motion, including that of targets, and power
  /// dissipated by the damper [W]. Tyres leave both at zero: their energy jumps with the road.
  double energy_rate = 0.0, damping = 0.0;
};

/// Derivatives of the wrench (torques in world axes about the marker points) with respect to small
/// motions and rates of the markers, in the order of Vec12; the other one held.
struct ForceTangent {
  Mat12 K;  ///< -d(wrench)/d(motion)
  Mat12 C;  ///< -d(wrench)/d(rates)
};

/// Event function of the active branch of a force law: see `force_side`.
struct ForceSide {
  /// Continuous distance of the motion from the edge of the branch: positive beyond the edge.
  double beyond = -1.0;
  std::int64_t next = 0;  ///< the branch that follows across the nearest edge
};

/// No branch is held: the law is evaluated on the branch of the present position.
inline constexpr std::int64_t free_branch = -1;

/// `origin`: the point from which the positions of the markers are measured. `reference_angle`
/// selects the turn of a joint angle: the result is within half a turn of it. `inputs`: values of
/// `model.inputs`; the tangents are at constant inputs.
void evaluate_force(const Model& model, const Force& force, const MarkerState& a,
                    const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                    ForceState& out, std::span<const double> inputs = {},
                    std::int64_t branch = free_branch) noexcept;

/// Where the force of an element or its slope jumps - an edge of the road, contact, a corner of a
/// law - the element changes from one branch of its law to another. Each branch is smooth and
/// extends beyond its edges, so a step may end on the wrong side of an edge and be repeated up to
/// it. Without a held branch: returns the branch of the present position in `next`.
bool has_branches(const Force& force) noexcept;
ForceSide force_side(const Model& model, const Force& force, const MarkerState& a,
                     const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                     std::span<const double> inputs, std::int64_t branch) noexcept;

}  // namespace floatframe

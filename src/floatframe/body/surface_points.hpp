#pragma once
// Points of the surface of a part whose deformation is monitored (docs/range.md). Its markers may
// be at rest while the part deforms between them.
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// Name of such points among the nodes of a body. They have no rotations, so joints,
/// forces and outputs cannot be attached to them.
inline constexpr const char* surface_point_name = "(point of the surface)";

bool is_surface_point(const ModalNode& node) noexcept;

/// The points that move most in a mode, at most one per mode, and at most `most_hidden_points` that
/// move most in combinations of modes in which the nodes of the body and the points chosen before
/// are at rest. `positions`: 3 x points [m]; `modes`: three rows per point, one column per mode.
std::vector<ModalNode> surface_points(const FlexibleBody& body, const Mat3X& positions,
                                      const MatX& modes);
inline constexpr int most_hidden_points = 20;

/// Without them, as a body that does not deform is.
void remove_surface_points(FlexibleBody& body);

}  // namespace floatframe

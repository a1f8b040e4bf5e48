#pragma once
// Simple solids for pictures of bodies: boxes and surfaces of revolution as triangles, several of
// them in one BodyShape. No influence on the motion. Body frame, SI units.
#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/math/pose.hpp"

namespace floatframe {

// All about their own origin; those with an axis have it along z.

/// Edges along x, y and z [m].
struct BoxSolid {
  Vec3 size = Vec3::Ones();
};
struct CylinderSolid {
  double radius = 0.5, length = 1.0;  ///< [m]
};
/// From `radius` at z = -length / 2 to `top` at z = length / 2 [m].
struct ConeSolid {
  double radius = 0.5, length = 1.0;
  double top = 0.0;  ///< radius there; 0: a point
};
struct SphereSolid {
  double radius = 0.5;  ///< [m]
};
/// A cylinder between two half spheres of its radius; `length` is that of the cylinder [m].
struct CapsuleSolid {
  double radius = 0.5, length = 1.0;
};
using Solid = std::variant<BoxSolid, CylinderSolid, ConeSolid, SphereSolid, CapsuleSolid>;

/// A solid of a body: where it is and its colour.
struct PlacedSolid {
  Solid solid;
  Pose X_BS;          ///< of the solid in the body frame
  std::string color;  ///< "#rrggbb"; empty: that of the page
};

/// Appends triangles with outward normals. A colour other than that of the triangles before
/// begins an entry of `BodyShape::paints`.
void add_triangles(const Mat3X& positions, const std::vector<std::array<int, 3>>& triangles,
                   const std::string& color, BodyShape& shape);
void add_solid(const PlacedSolid& placed, BodyShape& shape);

/// For `RigidDescription::shape`. Corners of round solids lie on their surface.
std::shared_ptr<const BodyShape> shape_of_solids(const std::vector<PlacedSolid>& solids);

}  // namespace floatframe

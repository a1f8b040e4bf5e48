#pragma once
// The drawing of a body, as triangles and lines between points that move with its modes: the
// surface of a part as it is, bars swept with their sections. A point at r from the axis of a bar
// moves by u + theta x r, u and theta those of the bar's node. Body frame, SI units.
#include <array>
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

struct SurfaceMesh {
  Mat3X positions;  ///< 3 x n [m]
  MatX modes;       ///< 3n x nm [m per unit of amplitude]; or empty: it does not bend
  std::vector<std::array<int, 3>> triangles;  ///< outward normals
  std::vector<std::array<int, 2>> lines;      ///< of beams of a part
  /// Node of each point: in the finite-element file, for bars in `FlexibleBody::nodes`. Empty
  /// for a surface from another program.
  std::vector<int> nodes;

  /// The end of the bar that a point belongs to.
  struct BarEnd {
    int bar = 0;  ///< in BodyShape::bars
    int end = 0;  ///< 0: at `from`, 1: at `to`
  };
  std::vector<BarEnd> bar_ends;  ///< of each point; empty unless bars are swept
};

/// Empty for a body without surface, beams and bars.
SurfaceMesh surface_mesh(const FlexibleBody& body);

}  // namespace floatframe

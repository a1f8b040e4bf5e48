#pragma once
// Appearance of a body, for pictures and for measurements in them; without influence on the
// motion. Body frame, SI units.
#include <array>
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct BodyShape {
  // For a part: its outer surface. A point moves by X y, X its three rows of `modes`. For a file of
  // another program: a surface that does not deform.
  Mat3X positions;                            ///< 3 x n [m]
  MatX modes;                                 ///< 3n x nm [m per unit of amplitude]; or empty
  std::vector<std::array<int, 3>> triangles;  ///< indices of points, outward normals
  std::vector<std::array<int, 2>> lines;      ///< of beams, indices of points
  std::vector<int> nodes;  ///< of each point: its node in the finite-element file, from 0

  /// A piece of a bar between two nodes of the body (`FlexibleBody::nodes`).
  struct Bar {
    int from = 0, to = 0;
    Vec3 y = Vec3::UnitY();            ///< local y of the section, unit
    bool round = false;                ///< an ellipse, else a rectangle
    double width = 0.0, height = 0.0;  ///< along y, along z = x x y [m]
    double inner = 0.0;                ///< of a tube: its bore as a fraction of width and height
  };
  std::vector<Bar> bars;

  std::string color;  ///< "#rrggbb"; empty: that of the page

  /// The colour of the triangles from `first` on, up to the next entry.
  struct Paint {
    int first = 0;
    std::string color;  ///< as above
  };
  std::vector<Paint> paints;  ///< ascending from 0; empty: all have `color`

  bool empty() const noexcept { return triangles.empty() && lines.empty() && bars.empty(); }
};

}  // namespace floatframe

#pragma once
// Geometry of a body in files for other programs: its surface (body/surface_mesh), the wheel of a
// tyre, a box of the same mass and inertia if there is nothing else; and its named nodes as points.
// Body frame, SI units.
#include "floatframe/body/surface_mesh.hpp"
#include "floatframe/export/body_motion.hpp"

namespace floatframe {

struct BodyPicture {
  /// Source of the shape of a point.
  enum class Origin {
    surface,  ///< of a part or of a geometry file
    bars,     ///< swept with the sections of bars
    box,      ///< of the mass and inertia of the body
    wheel,    ///< of a tyre
    node      ///< a named node
  };

  Mat3X points;                               ///< 3 x n [m]
  MatX modes;                                 ///< 3n x nm [m per unit of amplitude], or empty
  std::vector<std::array<int, 3>> triangles;  ///< points, outward normals
  std::vector<std::array<int, 2>> lines;
  std::vector<Origin> origins;  ///< of each point
  /// Node of each point: in the finite-element file; for bars and named nodes, in
  /// FlexibleBody::nodes; -1: none.
  std::vector<int> nodes;
  std::vector<SurfaceMesh::BarEnd> bar_ends;  ///< of the first points, if they belong to bars
  std::vector<std::string> names;             ///< of the named nodes, which are the last points
  std::string color;                          ///< "#rrggbb" or empty

  struct Bent {
    Eigen::Index point = 0;
    const SecondOrderNode* node = nullptr;
  };
  std::vector<Bent> bent;  ///< points with second-order displacements

  Eigen::Index surface_points() const noexcept {
    return points.cols() - static_cast<Eigen::Index>(names.size());
  }
};

BodyPicture body_picture(const Model& model, int body);

/// True for equal points, modes, faces, names and colour, to the bit.
bool same_picture(const BodyPicture& a, const BodyPicture& b);

/// 3 x n, body axes: u of all points [m] and du/dt [m/s].
struct PictureMotion {
  Mat3X u, rate;
};
void move_picture(const BodyPicture& picture, const BodyInstant& motion, PictureMotion& out);

}  // namespace floatframe

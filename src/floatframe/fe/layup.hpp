#pragma once
// Plies in a solid element. Ply k fills the part of the third natural coordinate, t, that its share
// of the thickness is of -1 to 1, the first at the face of the first nodes (1-2-3-4 of bricks,
// 1-2-3 of wedges). The layers are surfaces t = const, with at each place
//   n  their normal, towards the last ply
//   1  the first natural direction dx/dxi_1, or the first axis of the orientation, projected on the
//      layer; turned by the angle of the ply about n
// The axes of the material are 1, n x 1, n. Stiffness and mass are integrals ply by ply, each with
// the points of the element squeezed into the ply (fe/isoparametric.hpp). Displacements are those
// of the element, so strain is continuous through the plies and stress is not.
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// A ply of an element, ready for integration.
struct LayupPly {
  double bottom = -1.0, top = 1.0;  ///< natural coordinate t
  Mat6 D = Mat6::Zero();            ///< in the axes of the material [Pa]
  bool directional = false;         ///< not isotropic
  double angle = 0.0;               ///< [rad]
  double density = 0.0;             ///< [kg/m3]
};

std::vector<LayupPly> layup_plies(const Layup& layup, const std::vector<Material>& materials);

/// First axis of the layers at a place, not turned, from J = dx/dxi there; zero if the axis of the
/// orientation is along the normal.
Vec3 layer_axis(const Mat3& J, const Orientation* orientation, const Vec3& p);

/// Elasticity of a ply at a place, in body axes.
Mat6 ply_elasticity(const LayupPly& ply, const Mat3& J, const Orientation* orientation,
                    const Vec3& p);

/// Index of the ply at t; between two plies the lower one.
int ply_at(const std::vector<LayupPly>& plies, double t);

/// Error in a layup; empty if there is none.
std::string layup_error(const Layup& layup, const std::vector<Material>& materials);

}  // namespace floatframe

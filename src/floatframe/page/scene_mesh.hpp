#pragma once
// The surface of a body (body/surface_mesh) as triangles, each vertex with its displacement per
// modal amplitude, as stored in pages; and the substitute for a body without a surface.
#include <cstdint>
#include <vector>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct SceneMesh {
  std::vector<float> vertices;           ///< x, y, z [m]
  std::vector<std::uint32_t> triangles;  ///< three vertices each
  std::vector<float> displacements;  ///< vertices x modes x 3 [m per unit of amplitude]; or empty
  std::vector<std::uint32_t> nodes;  ///< of each vertex; empty for a surface from a file
  bool generated = false;            ///< swept along bars
};

/// Of a body with triangles or bars; otherwise empty.
SceneMesh scene_mesh(const FlexibleBody& body);

/// Opposite to gravity, along a world axis.
Vec3 scene_up(const Model& model);

/// What the bodies of a model have in common, by which a single one is judged.
struct SceneExtent {
  double mass = 0.0;   ///< of all bodies [kg]
  double reach = 0.0;  ///< diagonal of the box about their points, design configuration [m]
};
SceneExtent scene_extent(const Model& model);

/// A box with the mass and inertia of a body, or, where two principal moments are equal, a
/// cylinder; no larger than the points of the body. Of a body without mass the box about these.
struct SceneBox {
  Vec3 size = Vec3::Zero(), position = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
  bool round = false;  ///< a cylinder about the third axis, size[0] = size[1] its diameter
  /// It stands for nothing that could be seen: no mass, or next to none in far too large a box, as
  /// of bodies that only carry others.
  bool dummy = false;
};
/// `points`: attachment points of joints and forces on the body, body frame [m].
SceneBox scene_box(const FlexibleBody& body, const std::vector<Vec3>& points,
                   const SceneExtent& extent);

}  // namespace floatframe

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

/// A box with the mass and inertia of a body, or the bounding box of its points if it has no mass.
struct SceneBox {
  Vec3 size = Vec3::Zero(), position = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
};
/// `points`: attachment points of joints and forces on the body, body frame [m].
SceneBox scene_box(const FlexibleBody& body, const std::vector<Vec3>& points);

}  // namespace floatframe

#pragma once
// The surface of a body as triangles, each vertex with its displacement per modal amplitude: that
// of a part as it is, bars swept with their sections. A point of a section at r from the axis moves
// by u + theta x r, u and theta those of the bar between two nodes.
#include <cstdint>
#include <vector>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

struct SceneMesh {
  std::vector<float> vertices;           ///< x, y, z [m]
  std::vector<std::uint32_t> triangles;  ///< three vertices each
  std::vector<float> displacements;  ///< vertices x modes x 3 [m per unit of amplitude]; or empty
  std::vector<std::uint32_t> nodes;  ///< of each vertex; empty for a surface from a file
  bool generated = false;            ///< swept
};

/// Of a body with triangles or bars; empty without.
SceneMesh scene_mesh(const FlexibleBody& body);

/// A box with the mass and inertia of a body, or what bounds its points where it has no mass.
struct SceneBox {
  Vec3 size = Vec3::Zero(), position = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
};
/// `points`: places on the body that joints and forces use, body frame [m].
SceneBox scene_box(const FlexibleBody& body, const std::vector<Vec3>& points);

}  // namespace floatframe

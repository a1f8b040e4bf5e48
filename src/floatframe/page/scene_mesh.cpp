#include "floatframe/page/scene_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/body/surface_mesh.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

SceneMesh scene_mesh(const FlexibleBody& body) {
  const SurfaceMesh surface = surface_mesh(body);
  SceneMesh mesh;
  if (surface.triangles.empty()) return mesh;
  mesh.generated = !surface.bar_ends.empty();
  const auto append = [](std::vector<float>& out, const Vec3& p) {
    for (const double x : p) out.push_back(static_cast<float>(x));
  };
  for (Eigen::Index v = 0; v < surface.positions.cols(); ++v) {
    append(mesh.vertices, surface.positions.col(v));
    for (Eigen::Index m = 0; m < surface.modes.cols(); ++m)
      append(mesh.displacements, surface.modes.block<3, 1>(3 * v, m));
  }
  mesh.nodes.assign(surface.nodes.begin(), surface.nodes.end());
  for (const auto& t : surface.triangles)
    for (const int v : t) mesh.triangles.push_back(static_cast<std::uint32_t>(v));
  return mesh;
}

Vec3 scene_up(const Model& model) {
  Vec3 out = Vec3::UnitZ();
  Eigen::Index k = 2;
  if (model.gravity.cwiseAbs().maxCoeff(&k) > 0.0)
    out = Vec3::Unit(k) * (model.gravity[k] > 0.0 ? -1.0 : 1.0);
  return out;
}

SceneBox scene_box(const FlexibleBody& body, const std::vector<Vec3>& points) {
  const InertiaInvariants& v = body.invariants;
  SceneBox box;
  if (v.m > 0.0) {
    // Along a principal axis int x^2 dm = m a^2 / 12.
    box.position = v.m_u / v.m;
    const SymmetricEigen axes = symmetric_eigen(v.P_u - v.m_u * v.m_u.transpose() / v.m);
    if (axes.found) {
      box.axes = axes.vectors;
      if (box.axes.determinant() < 0.0) box.axes.col(0) *= -1.0;
      for (int k = 0; k < 3; ++k)
        box.size[k] = std::sqrt(12.0 * std::max(0.0, axes.values[k]) / v.m);
    }
  } else if (!points.empty()) {
    Vec3 low = points.front(), high = low;
    for (const Vec3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    box.position = 0.5 * (low + high);
    box.size = high - low;
  }
  // A box without extent is shown as a thin plate, a thin rod or a small cube.
  const double largest = box.size.maxCoeff();
  const double least = largest > 0.0 ? 0.05 * largest : 0.05;
  box.size = box.size.cwiseMax(least);
  return box;
}

}  // namespace floatframe

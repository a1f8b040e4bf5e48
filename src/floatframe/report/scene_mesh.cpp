#include "floatframe/report/scene_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr int round_corners = 12;

/// The corners of a section in its plane, along y and z, counter-clockwise seen against the bar.
std::vector<Eigen::Vector2d> section_corners(const BodyShape::Bar& bar) {
  std::vector<Eigen::Vector2d> out;
  if (!bar.round) {
    const double y = 0.5 * bar.width, z = 0.5 * bar.height;
    return {{y, z}, {-y, z}, {-y, -z}, {y, -z}};
  }
  for (int k = 0; k < round_corners; ++k) {
    const double a = 2.0 * std::numbers::pi * k / round_corners;
    out.emplace_back(0.5 * bar.width * std::cos(a), 0.5 * bar.height * std::sin(a));
  }
  return out;
}

class Sweep {
 public:
  Sweep(const FlexibleBody& body, SceneMesh& mesh) : body_(body), mesh_(mesh) {}

  void add(const BodyShape::Bar& bar) {
    const Vec3 along = (body_.nodes[bar.to].p - body_.nodes[bar.from].p).normalized();
    y_ = bar.y;
    z_ = along.cross(bar.y);
    const std::vector<Eigen::Vector2d> corners = section_corners(bar);
    const auto n = static_cast<std::uint32_t>(corners.size());
    // Corners of flat sides belong to one side each, so that edges stay sharp.
    if (bar.round) {
      const std::uint32_t from = ring(bar.from, corners), to = ring(bar.to, corners);
      for (std::uint32_t k = 0; k < n; ++k)
        side(from + k, from + (k + 1) % n, to + k, to + (k + 1) % n);
    } else {
      for (std::uint32_t k = 0; k < n; ++k) {
        const std::vector<Eigen::Vector2d> edge{corners[k], corners[(k + 1) % n]};
        const std::uint32_t from = ring(bar.from, edge), to = ring(bar.to, edge);
        side(from, from + 1, to, to + 1);
      }
    }
    const std::uint32_t first = ring(bar.from, corners), last = ring(bar.to, corners);
    for (std::uint32_t k = 1; k + 1 < n; ++k) {
      triangle(first, first + k + 1, first + k);
      triangle(last, last + k, last + k + 1);
    }
  }

 private:
  /// Vertices about a node; the place of the first.
  std::uint32_t ring(int at, const std::vector<Eigen::Vector2d>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh_.nodes.size());
    const ModalNode& node = body_.nodes[static_cast<std::size_t>(at)];
    for (const Eigen::Vector2d& c : corners) {
      const Vec3 r = c.x() * y_ + c.y() * z_, p = node.p + r;
      for (int k = 0; k < 3; ++k) mesh_.vertices.push_back(static_cast<float>(p[k]));
      for (Eigen::Index m = 0; m < node.X.cols(); ++m) {
        const Vec3 u = node.X.col(m) + Vec3(node.X_theta.col(m)).cross(r);
        for (int k = 0; k < 3; ++k) mesh_.displacements.push_back(static_cast<float>(u[k]));
      }
      mesh_.nodes.push_back(static_cast<std::uint32_t>(at));
    }
    return first;
  }
  void side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, d);
    triangle(a, d, c);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) mesh_.triangles.push_back(v);
  }

  const FlexibleBody& body_;
  SceneMesh& mesh_;
  Vec3 y_, z_;  ///< of the section
};

void copy_surface(const BodyShape& shape, Eigen::Index nm, SceneMesh& mesh) {
  for (Eigen::Index v = 0; v < shape.positions.cols(); ++v) {
    for (Eigen::Index k = 0; k < 3; ++k)
      mesh.vertices.push_back(static_cast<float>(shape.positions(k, v)));
    if (shape.modes.size() > 0)
      for (Eigen::Index m = 0; m < nm; ++m)
        for (Eigen::Index k = 0; k < 3; ++k)
          mesh.displacements.push_back(static_cast<float>(shape.modes(3 * v + k, m)));
  }
  for (const int n : shape.nodes) mesh.nodes.push_back(static_cast<std::uint32_t>(n));
  for (const auto& t : shape.triangles)
    for (const int v : t) mesh.triangles.push_back(static_cast<std::uint32_t>(v));
}

}  // namespace

SceneMesh scene_mesh(const FlexibleBody& body) {
  SceneMesh mesh;
  if (!body.shape) return mesh;
  if (!body.shape->triangles.empty()) {
    copy_surface(*body.shape, body.modes(), mesh);
  } else if (!body.shape->bars.empty()) {
    mesh.generated = true;
    Sweep sweep(body, mesh);
    for (const BodyShape::Bar& bar : body.shape->bars) sweep.add(bar);
  }
  return mesh;
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
  // What has no extent is shown as a thin plate, a thin rod or a small cube.
  const double largest = box.size.maxCoeff();
  const double least = largest > 0.0 ? 0.05 * largest : 0.05;
  box.size = box.size.cwiseMax(least);
  return box;
}

}  // namespace floatframe

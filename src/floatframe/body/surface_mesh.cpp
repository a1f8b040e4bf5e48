#include "floatframe/body/surface_mesh.hpp"

#include <cmath>
#include <numbers>

#include "floatframe/body/body_shape.hpp"

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

class BarSweep {
 public:
  BarSweep(const FlexibleBody& body, SurfaceMesh& mesh) : body_(body), mesh_(mesh) {
    std::size_t points = 0;
    for (const BodyShape::Bar& bar : body.shape->bars)
      points += bar.round ? 4 * round_corners : std::size_t{4 * 4 + 2 * 4};
    const auto n = static_cast<Eigen::Index>(points);
    mesh_.positions.resize(3, n);
    mesh_.modes.resize(3 * n, body.modes());
  }

  void add(int index) {
    const BodyShape::Bar& bar = body_.shape->bars[static_cast<std::size_t>(index)];
    index_ = index;
    along_ = (body_.nodes[bar.to].p - body_.nodes[bar.from].p).normalized();
    const std::vector<Eigen::Vector2d> corners = section_corners(bar);
    const int n = static_cast<int>(corners.size());
    // Corners of flat sides belong to one side each, so that edges stay sharp.
    if (bar.round) {
      const int from = ring(bar, 0, corners), to = ring(bar, 1, corners);
      for (int k = 0; k < n; ++k) side(from + k, from + (k + 1) % n, to + k, to + (k + 1) % n);
    } else {
      for (int k = 0; k < n; ++k) {
        const std::vector<Eigen::Vector2d> edge{corners[static_cast<std::size_t>(k)],
                                                corners[static_cast<std::size_t>((k + 1) % n)]};
        const int from = ring(bar, 0, edge), to = ring(bar, 1, edge);
        side(from, from + 1, to, to + 1);
      }
    }
    const int first = ring(bar, 0, corners), last = ring(bar, 1, corners);
    for (int k = 1; k + 1 < n; ++k) {
      mesh_.triangles.push_back({first, first + k + 1, first + k});
      mesh_.triangles.push_back({last, last + k, last + k + 1});
    }
  }

 private:
  /// Points about a node; the first of them.
  int ring(const BodyShape::Bar& bar, int end, const std::vector<Eigen::Vector2d>& corners) {
    const int first = static_cast<int>(mesh_.nodes.size()), at = end == 0 ? bar.from : bar.to;
    const Vec3 z = along_.cross(bar.y);
    const ModalNode& node = body_.nodes[static_cast<std::size_t>(at)];
    for (const Eigen::Vector2d& c : corners) {
      const auto v = static_cast<Eigen::Index>(mesh_.nodes.size());
      const Vec3 r = c.x() * bar.y + c.y() * z;
      mesh_.positions.col(v) = node.p + r;
      for (Eigen::Index m = 0; m < node.X.cols(); ++m)
        mesh_.modes.block<3, 1>(3 * v, m) = node.X.col(m) + Vec3(node.X_theta.col(m)).cross(r);
      mesh_.nodes.push_back(at);
      mesh_.bar_ends.push_back({index_, end});
    }
    return first;
  }
  void side(int a, int b, int c, int d) {
    mesh_.triangles.push_back({a, b, d});
    mesh_.triangles.push_back({a, d, c});
  }

  const FlexibleBody& body_;
  SurfaceMesh& mesh_;
  int index_ = 0;
  Vec3 along_ = Vec3::Zero();
};

}  // namespace

SurfaceMesh surface_mesh(const FlexibleBody& body) {
  SurfaceMesh mesh;
  if (!body.shape) return mesh;
  const BodyShape& shape = *body.shape;
  if (!shape.triangles.empty() || !shape.lines.empty()) {
    mesh.positions = shape.positions;
    mesh.modes = shape.modes;
    mesh.triangles = shape.triangles;
    mesh.lines = shape.lines;
    mesh.nodes = shape.nodes;
  } else if (!shape.bars.empty()) {
    BarSweep sweep(body, mesh);
    for (std::size_t k = 0; k < shape.bars.size(); ++k) sweep.add(static_cast<int>(k));
  }
  return mesh;
}

}  // namespace floatframe

// Paths along the nodes of flexible bodies.
#include <algorithm>
#include <limits>

#include "floatframe/body/surface_points.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_build.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/slide_path.hpp"

namespace floatframe {

namespace {

/// A node on the path, at this length from its first point.
struct NodeOnPath {
  double length = 0.0;
  int node = -1;
};

/// The nodes of a body on the lines between points, in body axes, in the order of the path.
std::vector<NodeOnPath> nodes_on_path(const std::vector<ModalNode>& nodes, const Mat3X& points) {
  std::vector<NodeOnPath> found;
  double length = 0.0;
  for (Eigen::Index i = 0; i + 1 < points.cols(); ++i) {
    const Vec3 line = points.col(i + 1) - points.col(i);
    const double end = line.norm();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (is_surface_point(nodes[k])) continue;
      const Vec3 d = nodes[k].p - points.col(i);
      const double along = std::clamp(d.dot(line) / end, 0.0, end);
      if ((d - along / end * line).norm() <= rules::node_tolerance)
        found.push_back({length + along, static_cast<int>(k)});
    }
    length += end;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const NodeOnPath& a, const NodeOnPath& b) { return a.length < b.length; });
  // Corners belong to two lines; several nodes may be at one place.
  const auto same = [](const NodeOnPath& a, const NodeOnPath& b) {
    return b.length - a.length <= 3.0 * rules::node_tolerance;
  };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

}  // namespace

bool ElementBuild::slide(const MatX& points) {
  Model& model = builder_.model;
  Marker m = model.markers[element.markers[0]];
  if (m.body < 0 || model.bodies[m.body].modes() == 0) return true;
  const Body& body = model.bodies[m.body];
  const std::vector<ModalNode>& nodes = body.data->nodes;
  const Vec3 from = design_point(0);
  Mat3X p(3, points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vec3 at = from + points.row(i).transpose();
    p.col(i) = body.X_WB.inverse() * at;
    int nearest = -1;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (const double d = (nodes[k].p - p.col(i)).norm();
          !is_surface_point(nodes[k]) && d < best) {
        best = d;
        nearest = k;
      }
    if (best <= rules::node_tolerance) continue;
    Vec3 there = Vec3::Zero();
    if (nearest >= 0) there = body.X_WB * nodes[nearest].p;
    builder_.errors.add(ErrorCode::not_found, description().origin.of("points"),
                        path() + ".points: " +
                            sentences::no_node_at(at, body.name, nearest < 0 ? nullptr : &there));
    return false;
  }
  std::vector<int> on_path;
  const std::vector<NodeOnPath> found = nodes_on_path(nodes, p);
  if (found.size() < 2) {
    builder_.errors.add(ErrorCode::geometry, description().origin.of("points"),
                        path() + ".points: found one node of body '" + body.name +
                            "' on the path, expected at least two");
    return false;
  }
  Mat3X places(3, std::ssize(found));
  for (std::size_t k = 0; k < found.size(); ++k) {
    on_path.push_back(found[k].node);
    places.col(k) = nodes[found[k].node].p;
  }
  m.node = on_path.front();
  m.X_NM = Pose();
  m.rotates = false;
  m.path = std::make_shared<const SlidePath>(std::move(on_path), places);
  m.guide = element.markers[1];
  element.markers[0] = std::ssize(model.markers);
  model.markers.push_back(std::move(m));
  return true;
}

std::shared_ptr<const SpaceCurve> ElementBuild::path_of(std::size_t port) const {
  const auto& path = builder_.model.markers[element.markers[port]].path;
  return path ? std::shared_ptr<const SpaceCurve>(path, &path->drawn()) : nullptr;
}

}  // namespace floatframe

// Names of bodies and points on them.
#include <array>
#include <limits>

#include "floatframe/body/surface_points.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

/// Equal for equal markers.
std::array<double, 15> place_of(const Marker& m) {
  std::array<double, 15> place{static_cast<double>(m.body), static_cast<double>(m.node),
                               m.rotates ? 1.0 : 0.0};
  for (Eigen::Index i = 0; i < 3; ++i) place[3 + i] = m.X_NM.p[i];
  for (Eigen::Index i = 0; i < 9; ++i) place[6 + i] = m.X_NM.R(i);
  return place;
}

std::string no_node_named(const Body& body, const std::string& node) {
  std::vector<std::string> known;
  for (const ModalNode& n : body.data->nodes)
    if (!n.name.empty() && !is_surface_point(n)) known.push_back(n.name);
  if (body.modes() == 0 && known.empty()) return sentences::node_on_rigid_body(body.name);
  return sentences::no_node_named(body.name, body.modes() > 0, node) + did_you_mean(node, known);
}

}  // namespace

int ModelBuilder::body_index(const std::string& name) const {
  return name == ground_name ? ground_index : body_names.index(name);
}

int ModelBuilder::add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                             const SourceMark& mark, const std::string& who, const char* node_key) {
  const int body = body_index(at.body);
  Marker m;
  m.body = body;
  if (body < 0) {
    m.X_NM = {at.point, R_design};
    model.markers.push_back(m);
    return static_cast<int>(model.markers.size()) - 1;
  }
  const Body& b = model.bodies[body];
  Pose X_BM = b.X_WB.inverse() * Pose{at.point, R_design};
  const std::vector<ModalNode>& nodes = b.data->nodes;
  if (at.node) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k].name == *at.node && !is_surface_point(nodes[k])) m.node = static_cast<int>(k);
    if (m.node < 0) {
      errors.add(ErrorCode::not_found, mark,
                 who + "." + node_key + ": " + no_node_named(b, *at.node));
      return -1;
    }
    X_BM.p = nodes[m.node].p;
  } else if (b.modes() > 0) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (is_surface_point(nodes[k])) continue;
      const double distance = (nodes[k].p - X_BM.p).norm();
      if (distance < best) {
        best = distance;
        m.node = static_cast<int>(k);
      }
    }
    if (best > rules::node_tolerance && X_BM.p.norm() <= rules::node_tolerance) {
      m.node = -1;  // the body frame, for any body reference: no mode moves it
    } else if (best > rules::node_tolerance) {
      Vec3 nearest = Vec3::Zero();
      if (m.node >= 0) nearest = b.X_WB * nodes[m.node].p;
      errors.add(
          ErrorCode::not_found, mark,
          who + ".at: " + sentences::no_node_at(at.point, b.name, m.node < 0 ? nullptr : &nearest));
      return -1;
    }
  }
  if (m.node >= 0) {
    m.X_NM = {X_BM.p - nodes[m.node].p, X_BM.R};
    if (m.X_NM.p.norm() <= rules::node_tolerance) m.X_NM.p.setZero();
    m.rotates = oriented;
  } else {
    m.X_NM = X_BM;
  }
  return shared_marker(m);
}

int ModelBuilder::body_frame(const std::string& body) {
  Marker m;
  m.body = body_index(body);
  if (m.body < 0) return -1;
  m.X_NM.R = model.bodies[m.body].X_WB.R.transpose();
  return shared_marker(m);
}

int ModelBuilder::shared_marker(const Marker& m) {
  const auto [it, fresh] =
      marker_places.emplace(place_of(m), static_cast<int>(model.markers.size()));
  if (fresh) model.markers.push_back(m);
  return it->second;
}

Vec3 ModelBuilder::design_point(int marker) const { return design_pose(model, marker).p; }

}  // namespace floatframe

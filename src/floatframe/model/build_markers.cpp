// Names of bodies and places on them.
#include <limits>
#include <sstream>

#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

constexpr double node_tolerance = 1e-6;

bool same(const Marker& a, const Marker& b) {
  return a.body == b.body && a.node == b.node && a.rotates == b.rotates && a.X_NM.p == b.X_NM.p &&
         a.X_NM.R == b.X_NM.R;
}

std::string node_names(const std::vector<ModalNode>& nodes) {
  std::string text;
  for (const ModalNode& n : nodes)
    if (!n.name.empty()) text += (text.empty() ? " (" : ", ") + n.name;
  return text.empty() ? text : text + ")";
}

}  // namespace

std::string point_text(const Vec3& p) {
  std::ostringstream s;
  s << '[' << p.x() << ", " << p.y() << ", " << p.z() << ']';
  return s.str();
}

int ModelBuilder::body_index(const std::string& name, const SourceMark& mark,
                             const std::string& who) {
  if (name == ground_name) return ground_index;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].name == name) return static_cast<int>(i);
  faults.add(mark, who + ": found body '" + name + "', expected the name of a body or 'ground'");
  return unknown;
}

int ModelBuilder::add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                             const SourceMark& mark, const std::string& who) {
  const int body = body_index(at.body, mark, who);
  if (body == unknown) return -1;
  Marker m;
  m.body = body;
  if (body < 0) {
    m.X_NM = {at.point, R_design};
    model.markers.push_back(m);
    return static_cast<int>(model.markers.size()) - 1;
  }
  const Body& b = model.bodies[static_cast<std::size_t>(body)];
  Pose X_BM = b.X_WB.inverse() * Pose{at.point, R_design};
  const std::vector<ModalNode>& nodes = b.data->nodes;
  if (at.node) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k].name == *at.node) m.node = static_cast<int>(k);
    if (m.node < 0) {
      faults.add(mark, who + ": found node '" + *at.node + "', expected a node of body '" + b.name +
                           "'" + node_names(nodes));
      return -1;
    }
    X_BM.p = nodes[static_cast<std::size_t>(m.node)].p;
  } else if (b.modes() > 0) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double distance = (nodes[k].p - X_BM.p).norm();
      if (distance < best) {
        best = distance;
        m.node = static_cast<int>(k);
      }
    }
    if (best > node_tolerance && X_BM.p.norm() <= node_tolerance) {
      m.node = -1;  // the body frame itself, whatever the body reference: no mode moves it
    } else if (best > node_tolerance) {
      const Vec3 nearest = m.node < 0 ? Vec3::Zero().eval()
                                      : Vec3(b.X_WB * nodes[static_cast<std::size_t>(m.node)].p);
      faults.add(mark, who + ": found point " + point_text(at.point) + " on flexible body '" +
                           b.name + "', expected one of its nodes; the nearest is at " +
                           point_text(nearest));
      return -1;
    }
  }
  if (m.node >= 0) {
    m.X_NM = {X_BM.p - nodes[static_cast<std::size_t>(m.node)].p, X_BM.R};
    if (m.X_NM.p.norm() <= node_tolerance) m.X_NM.p.setZero();
    m.rotates = oriented;
  } else {
    m.X_NM = X_BM;
  }
  for (std::size_t k = 0; k < model.markers.size(); ++k)  // joints and forces share equal markers
    if (same(model.markers[k], m)) return static_cast<int>(k);
  model.markers.push_back(m);
  return static_cast<int>(model.markers.size()) - 1;
}

Vec3 ModelBuilder::design_point(int marker) const {
  const Marker& m = this->marker(marker);
  if (m.body < 0) return m.X_NM.p;
  const Body& b = model.bodies[static_cast<std::size_t>(m.body)];
  const Vec3 node =
      m.node < 0 ? Vec3::Zero().eval() : b.data->nodes[static_cast<std::size_t>(m.node)].p;
  return b.X_WB * Vec3(node + m.X_NM.p);
}

}  // namespace floatframe

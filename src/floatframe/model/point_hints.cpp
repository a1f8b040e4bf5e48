// Connections of one rigid body of a vehicle that lie too far apart: points in mm.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/hint_list.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {
namespace {

/// The smallest of the wheels that a road carries [m]; infinite: there is none.
double smallest_wheel(const Model& model) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Element& e : model.elements)
    if (element_kind(e.type).lifted) radius = std::min(radius, picture_of(e).radius);
  return radius;
}

/// The box of the points of each rigid body at which joints and elements hold it, in its frame.
std::vector<Eigen::AlignedBox3d> boxes_of_connections(const Model& model) {
  std::vector<Eigen::AlignedBox3d> boxes(model.bodies.size());
  const auto add = [&](int marker) {
    if (marker < 0) return;
    const Marker& m = model.markers[marker];
    if (m.body >= 0 && m.node < 0 && model.bodies[m.body].modes() == 0)
      boxes[m.body].extend(m.X_NM.p);
  };
  for (const Joint& joint : model.joints) {
    if (joint_is_free(joint.type)) continue;
    add(joint.frame_F);
    add(joint.frame_M);
  }
  for (const Element& e : model.elements)
    for (const int marker : e.markers) add(marker);
  return boxes;
}

}  // namespace

void hint_at_points(const Model& model, HintList& out) {
  constexpr double longest = 60.0;       // of a vehicle in one piece [m]
  constexpr double most_wheels = 100.0;  // in radii of its smallest wheel
  const double radius = smallest_wheel(model);
  if (!(radius < longest / most_wheels)) return;
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_connections(model);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double size = boxes[i].isEmpty() ? 0.0 : boxes[i].diagonal().norm();
    if (size > longest)
      out.add("body", model.bodies[i].name,
              fmt::format("points at which it is held are up to {:.4g} m apart, and a wheel has a "
                          "radius of {:.4g} m: they may be in mm",
                          size, radius));
  }
}

}  // namespace floatframe

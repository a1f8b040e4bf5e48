// *TRANSFORM: directions of degrees of freedom at nodes. Rectangular: x through the first point,
// the second in the plane of x and y. Cylindrical: radial, tangential, axial about the axis through
// two points. Equations are written in body axes; supports, which are hints only, stay as they are.
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Columns are the turned axes; nothing if they are not determined.
std::optional<Mat3> axes_at(const AbaqusTransform& t, const Vec3& p) {
  Mat3 R;
  if (t.cylindrical) {
    const Vec3 z = (t.b - t.a).normalized(), to = p - t.a, radial = to - z * z.dot(to);
    if (!(radial.norm() > 1e-9 * (to.norm() + (t.b - t.a).norm()))) return std::nullopt;
    R.col(0) = radial.normalized();
    R.col(2) = z;
    R.col(1) = z.cross(R.col(0));
  } else {
    R.col(0) = t.a.normalized();
    R.col(2) = t.a.cross(t.b).normalized();
    R.col(1) = R.col(2).cross(R.col(0));
  }
  return R;
}

}  // namespace

void read_abaqus_transform(AbaqusLines& lines, const AbaqusKeyword& keyword,
                           AbaqusContent& content) {
  lines.allow_only(keyword, {"NSET", "TYPE"});
  if (content.only_nodes) {
    lines.error(ErrorCode::unsupported, keyword,
                "turns the rows of matrices, which is not supported");
    return lines.skip_data();
  }
  const std::string_view nset = lines.required(keyword, "NSET");
  const std::string_view type = keyword.value("TYPE");
  AbaqusTransform t;
  t.at = keyword.at;
  t.scope = content.scope;
  t.cylindrical = same_word(type, "C");
  if (!type.empty() && !t.cylindrical && !same_word(type, "R")) {
    lines.error(ErrorCode::wrong_value, keyword,
                "has the type {}, expected R (rectangular) or C (cylindrical)", shown(type));
    return lines.skip_data();
  }
  const std::size_t before = lines.source().errors();
  double x[6] = {};
  std::vector<std::string_view> fields;
  std::size_t count = 0;
  while (lines.next_fields(fields))
    for (const std::string_view field : fields)
      if (count < 6) x[count++] = lines.real(field, "coordinate of *TRANSFORM");
  if (lines.source().errors() != before) return;
  t.a = {x[0], x[1], x[2]};
  t.b = {x[3], x[4], x[5]};
  const double size = t.a.norm() + t.b.norm();
  const double spread = t.cylindrical ? (t.b - t.a).norm() : t.a.cross(t.b).norm() / size;
  if (count < 6 || !(spread > 1e-9 * size)) {
    lines.error(ErrorCode::geometry, keyword,
                t.cylindrical ? "needs two different points of its axis"
                              : "needs two points that do not lie on a line with the origin");
    return;
  }
  if (nset.empty()) return;
  t.nodes = content.reference(nset, keyword.at);
  content.transforms.push_back(t);
}

std::map<int, Mat3> abaqus_node_axes(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  std::map<int, Mat3> axes;
  for (AbaqusTransform t : c.transforms) {
    const AbaqusPlacement& place = c.placement(t.scope);
    t.a = t.cylindrical ? place.at(t.a) : Vec3(place.R * t.a);
    t.b = t.cylindrical ? place.at(t.b) : Vec3(place.R * t.b);
    for (const int node : build.nodes.resolve(t.nodes)) {
      const std::optional<Mat3> R = axes_at(t, build.model.positions[node]);
      if (!R) {
        build.source.error(
            ErrorCode::geometry, t.at,
            "*TRANSFORM: {} lies on the axis, where the radial direction is not determined",
            build.model.node_label(node));
        continue;
      }
      axes[node] = *R;
    }
  }
  return axes;
}

}  // namespace floatframe

// *SYSTEM: an origin, a point on the first axis and a point in the plane of the first and second
// axis, in which the nodes that follow are given.
// Source: Abaqus Keywords Guide.
#include <Eigen/Geometry>
#include <cmath>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"

namespace floatframe {

void read_abaqus_system(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {});
  content.system.reset();
  std::vector<std::string_view> fields;
  // Without lines: the axes of the part again.
  if (!lines.next_fields(fields)) return;
  const auto point = [&](std::size_t first) {
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k)
      p[static_cast<Eigen::Index>(k)] =
          lines.real_or(fields, first + k, 0.0, "coordinate of *SYSTEM");
    return p;
  };
  const std::size_t before = lines.source().errors();
  AbaqusCoordinates system;
  system.origin = point(0);
  content.system = system;
  if (fields.size() <= 3) return lines.skip_data();
  Vec3 x = point(3) - system.origin, in_plane = Vec3::Zero();
  const bool plane = lines.next_fields(fields);
  if (plane) {
    in_plane = point(0) - system.origin;
  } else {
    // The third axis stays, the first is seen along it.
    x.z() = 0.0;
    in_plane = Vec3::UnitZ().cross(x);
  }
  lines.skip_data();
  if (lines.source().errors() != before) return;
  const Vec3 z = x.cross(in_plane);
  const double size = x.stableNorm() * in_plane.stableNorm();
  if (!(z.stableNorm() > 1e-9 * size) || !std::isfinite(size)) {
    lines.error(ErrorCode::geometry, keyword,
                plane ? "has its three points on a line"
                      : "has its two points at one place as seen along the third axis");
    return;
  }
  system.axes.col(0) = x.stableNormalized();
  system.axes.col(2) = z.stableNormalized();
  system.axes.col(1) = system.axes.col(2).cross(system.axes.col(0));
  content.system = system;
}

}  // namespace floatframe

#include "floatframe/decks/abaqus/abaqus_arc.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace floatframe {

std::optional<AbaqusArc> abaqus_arc(AbaqusLines& lines, const Vec3& centre, const Vec3& a,
                                    const Vec3& b) {
  const Vec3 ra = a - centre, rb = b - centre, n = ra.cross(rb);
  const double r = ra.norm();
  if (std::abs(rb.norm() - r) > 1e-3 * r || !(r > 0.0)) {
    lines.source().error(
        ErrorCode::geometry,
        "the ends are {:.6g} and {:.6g} from the centre of the arc, expected the same", r,
        rb.norm());
    return std::nullopt;
  }
  const double angle = std::atan2(n.norm(), ra.dot(rb));
  if (!(n.norm() > 1e-9 * r * r) || angle > 0.999 * std::numbers::pi) {
    lines.source().error(ErrorCode::unsupported,
                         "the arc is half a turn or has no length; arcs of less are read");
    return std::nullopt;
  }
  return AbaqusArc{centre, a, n.normalized(), angle};
}

}  // namespace floatframe

#pragma once
// Arcs of *NGEN, LINE=C.
#include <Eigen/Geometry>
#include <optional>

#include "floatframe/decks/abaqus/abaqus_lines.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// An arc about a centre from a to b, of less than half a turn.
struct AbaqusArc {
  Vec3 centre, a, normal;
  double angle;
  Vec3 at(double t) const { return centre + Eigen::AngleAxisd(t * angle, normal) * (a - centre); }
};

/// Nothing and an error if the three points make none.
std::optional<AbaqusArc> abaqus_arc(AbaqusLines& lines, const Vec3& centre, const Vec3& a,
                                    const Vec3& b);

}  // namespace floatframe

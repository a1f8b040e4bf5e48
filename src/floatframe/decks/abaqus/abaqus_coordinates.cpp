// *SYSTEM: an origin, a point on the first axis and a point in the plane of the first and second
// axis, in which the nodes that follow are given.
// *TRANSFORM: directions of degrees of freedom at nodes. Rectangular: x through the first point,
// the second in the plane of x and y. Cylindrical: radial, tangential, axial about the axis through
// two points. Equations are written in body axes; supports, which are hints only, stay as they are.
// *ORIENTATION: axes of materials.
// Source: Abaqus Keywords Guide.
#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Columns are the rotated axes; null if they are not determined.
std::optional<Mat3> axes_at(const AbaqusTransform& t, const Vec3& p) {
  Mat3 R;
  if (t.cylindrical) {
    const Vec3 z = (t.b - t.a).normalized(), to = p - t.a, radial = to - z * z.dot(to);
    if (!(radial.norm() > 1e-9 * (to.norm() + (t.b - t.a).norm()))) return std::nullopt;
    R.col(0) = radial.normalized();
    R.col(2) = z;
  } else {
    R.col(0) = t.a.normalized();
    R.col(2) = t.a.cross(t.b).normalized();
  }
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

/// SYSTEM, DEFINITION and NAME of *ORIENTATION.
AbaqusOrientation begin_orientation(AbaqusCard& card) {
  AbaqusOrientation o;
  o.at = card.at;
  o.scope = card.content.scope;
  card.required("NAME");
  const std::string system = card.word("SYSTEM"), definition = card.word("DEFINITION");
  if (system == "CYLINDRICAL") {
    o.kind = AbaqusOrientation::Kind::cylindrical;
  } else if (system == "ZRECTANGULAR") {
    o.kind = AbaqusOrientation::Kind::z_rectangular;
    if (!card.content.clues.axes)
      card.content.clues.axes = {"*ORIENTATION, SYSTEM=Z RECTANGULAR", card.at};
  } else if (!system.empty() && system != "RECTANGULAR") {
    card.error(ErrorCode::wrong_value,
               "has the system {}, expected RECTANGULAR, Z RECTANGULAR or CYLINDRICAL",
               shown(card.value("SYSTEM")));
  }
  if (!definition.empty() && definition != "COORDINATES")
    card.error(ErrorCode::wrong_value, "has the definition {}, expected COORDINATES",
               shown(card.value("DEFINITION")));
  return o;
}

}  // namespace

void read_abaqus_system(AbaqusCard& card) {
  constexpr const char* what = "coordinate of *SYSTEM";
  std::optional<Orientation>& present = card.content.system;
  present.reset();
  // Without lines: the axes of the part again.
  if (!card.next()) return;
  Orientation& system = present.emplace();
  system.origin = card.vector(0, what);
  if (card.fields.size() <= 3) return;
  Vec3 x = card.vector(3, what) - system.origin, in_plane = Vec3::Zero();
  const bool plane = card.next();
  if (plane) {
    in_plane = card.vector(0, what) - system.origin;
  } else {
    // The third axis is kept, the first is projected along it.
    x.z() = 0.0;
    in_plane = Vec3::UnitZ().cross(x);
  }
  if (card.wrong()) return;
  const Vec3 z = x.cross(in_plane);
  const double size = x.stableNorm() * in_plane.stableNorm();
  if (!(z.stableNorm() > 1e-9 * size) || !std::isfinite(size))
    return card.error(ErrorCode::geometry,
                      plane ? "has its three points on a line"
                            : "has its two points at one place as seen along the third axis");
  system.axes.col(0) = x.stableNormalized();
  system.axes.col(2) = z.stableNormalized();
  system.axes.col(1) = system.axes.col(2).cross(system.axes.col(0));
}

void read_abaqus_transform(AbaqusCard& card) {
  if (card.content.only_nodes)
    return card.error(ErrorCode::unsupported, "turns the rows of matrices, which is not supported");
  const bool named = !card.required("NSET").empty();
  if (!card.is_one_of("TYPE", "R C",
                      "has the type {}, expected R (rectangular) or C (cylindrical)"))
    return;
  card.start();
  AbaqusTransform t;
  t.scope = card.content.scope;
  t.cylindrical = same_word(card.value("TYPE"), "C");
  Vec6 x = Vec6::Zero();
  int count = 0;
  while (card.next())
    for (std::size_t k = 0; k < card.fields.size(); ++k)
      if (count < 6) x(count++) = card.real(k, "coordinate of *TRANSFORM");
  if (card.wrong()) return;
  t.a = x.head<3>();
  t.b = x.tail<3>();
  const double size = t.a.norm() + t.b.norm();
  const double spread = t.cylindrical ? (t.b - t.a).norm() : t.a.cross(t.b).norm() / size;
  if (count < 6 || !(spread > 1e-9 * size))
    return card.error(ErrorCode::geometry,
                      t.cylindrical ? "needs two different points of its axis"
                                    : "needs two points that do not lie on a line with the origin");
  if (!named) return;
  t.where = card.reference_of("NSET");
  card.content.transforms.push_back(t);
}

std::map<int, Mat3> abaqus_node_axes(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  std::map<int, Mat3> axes;
  for (AbaqusTransform t : c.transforms) {
    const AbaqusPlacement& place = c.placement(t.scope);
    t.a = t.cylindrical ? place.at(t.a) : Vec3(place.R * t.a);
    t.b = t.cylindrical ? place.at(t.b) : Vec3(place.R * t.b);
    for (const int node : build.nodes.resolve(t.where)) {
      if (const std::optional<Mat3> R = axes_at(t, build.model.positions[node]))
        axes[node] = *R;
      else
        build.source.error(
            ErrorCode::geometry, t.where.at,
            "*TRANSFORM: {} lies on the axis, where the radial direction is not determined",
            build.model.node_label(node));
    }
  }
  return axes;
}

bool AbaqusOrientation::points_on_a_line() const {
  const bool cylinder = kind == Kind::cylindrical;
  const Vec3 first = cylinder ? Vec3(b - a) : Vec3(a - c), second = b - c;
  return first.norm() == 0.0 ||
         (!cylinder && first.cross(second).norm() <= 1e-12 * first.norm() * second.norm());
}

const char* AbaqusOrientation::wrong_points() const noexcept {
  return kind == Kind::cylindrical ? "has the same point for a and b"
                                   : "has its points a, b and the origin on a line";
}

void read_abaqus_orientation(AbaqusCard& card) {
  AbaqusOrientation o = begin_orientation(card);
  if (card.wrong() || !card.needs_line()) return;
  if (card.fields.size() < 6)
    card.error(ErrorCode::wrong_count, "has {} coordinates, expected those of the points a and b",
               card.fields.size());
  std::size_t k = 0;
  for (Vec3* const point : {&o.a, &o.b, &o.c})
    *point = card.vector(std::exchange(k, k + 3), "coordinate of the orientation");
  if (card.next()) {
    o.axis_given = !card.field(0).empty();
    const std::optional<int> axis = o.axis_given ? parse_integer(card.field(0)) : 1;
    if (!axis || *axis < 1 || *axis > 3)
      card.error(ErrorCode::out_of_range, "turns about axis {}, expected 1, 2 or 3",
                 axis ? std::to_string(*axis) : shown(card.field(0)));
    o.axis = axis.value_or(1);
    o.angle = card.real_or(1, 0.0, "additional rotation") * std::numbers::pi / 180.0;
  }
  // CalculiX has the origin in place of c: the program of the deck is determined later.
  AbaqusOrientation without_c = o;
  without_c.c.setZero();
  if (!card.wrong() && o.points_on_a_line() && without_c.points_on_a_line())
    card.error(ErrorCode::wrong_value, o.wrong_points());
  const std::string name = card.word("NAME");
  const auto [it, added] = card.content.orientations.emplace(std::pair{o.scope, name}, o);
  if (!added && !card.wrong())
    card.error(ErrorCode::duplicate, "names the orientation {} a second time ({})", shown(name),
               card.place(it->second.at));
}

}  // namespace floatframe

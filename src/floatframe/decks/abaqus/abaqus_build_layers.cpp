// Orientations and layers of the sections of an Abaqus deck.
//
// Solids have the axes of their orientation at each point. For shells axis 1 is projected on the
// element: Abaqus takes the axis that follows the one about which the additional rotation turns
// (1, 2, 3, 1), after that rotation; without an orientation global x, or global z where x is within
// 0.1 degrees of the normal. CalculiX has the axes in space; with the third along the normal that
// is the same.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/nodes_of_element.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/fe/shell_layers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;
using Kind = AbaqusOrientation::Kind;

/// Is `what`, such as "SYSTEM=Z RECTANGULAR", treated as in CalculiX, which `does` ("ignores it";
/// `done`: "ignored")? With a note if the user may not expect it.
bool treated_as_in_calculix(AbaqusBuild& build, const AbaqusOrientation& o, const std::string& name,
                            const std::string& what, const char* does, const char* done) {
  const DialectClues& clues = build.clues;
  const bool given = build.content.options.dialect != DeckDialect::by_content;
  const bool calculix = build.dialect() == DeckDialect::calculix;
  const bool known = given || (clues.abaqus && !clues.calculix && !clues.by_axes);
  if (calculix)
    build.note(o.at,
               "orientation {}: {} is {}, as CalculiX does; if the deck is one of Abaqus give "
               "--dialect abaqus",
               shown(name), what, done);
  else if (!known)
    build.note(
        o.at,
        "orientation {}: {} is taken as in Abaqus; if the deck is one of CalculiX, which {}, "
        "give --dialect calculix",
        shown(name), what, does);
  return calculix;
}

/// As in the program of the deck. CalculiX ignores the Z of a system, a point c, and a rotation
/// whose axis is blank.
AbaqusOrientation in_program_of_deck(AbaqusBuild& build, AbaqusOrientation o,
                                     const std::string& name, bool shell) {
  if (o.kind == Kind::z_rectangular &&
      treated_as_in_calculix(build, o, name, "SYSTEM=Z RECTANGULAR", "takes it as RECTANGULAR",
                             "taken as RECTANGULAR"))
    o.kind = Kind::rectangular;
  if (o.kind != Kind::cylindrical && o.c != Vec3::Zero() &&
      treated_as_in_calculix(
          build, o, name, fmt::format("its point c at ({:g}, {:g}, {:g})", o.c(0), o.c(1), o.c(2)),
          "ignores it", "ignored"))
    o.c.setZero();
  // For shells the axis alone determines the one about the normal.
  if (o.axis != 0 && !o.axis_given && (shell || o.angle != 0.0) &&
      treated_as_in_calculix(
          build, o, name,
          fmt::format("the additional rotation of {:g} degrees, whose axis is blank (1 in Abaqus),",
                      o.angle * 180.0 / std::numbers::pi),
          "ignores it", "ignored"))
    o.axis = 0;
  if (o.points_on_a_line())
    build.source.error(ErrorCode::wrong_value, o.at, "orientation {} {}", shown(name),
                       o.wrong_points());
  return o;
}

Orientation placed(const AbaqusOrientation& o, const AbaqusPlacement& place) {
  Orientation out;
  Vec3 x = o.a - o.c, z;
  if (o.kind == Kind::cylindrical) {
    out.kind = Orientation::Kind::cylindrical;
    z = o.b - o.a;
    Eigen::Index least = 0;
    z.cwiseAbs().minCoeff(&least);
    x = Vec3::Unit(least);
  } else if (o.kind == Kind::z_rectangular) {
    z = o.a - o.c;
    x = o.b - o.c;
  } else {
    z = x.cross(o.b - o.c);
  }
  z.normalize();
  x = (x - z * z.dot(x)).normalized();
  out.axes << x, z.cross(x), z;
  out.origin = o.kind == Kind::cylindrical ? o.a : o.c;
  out.axes = (place.R * out.axes).eval();
  out.origin = place.at(out.origin);
  if (o.axis > 0) out.turn = Eigen::AngleAxisd(o.angle, Vec3::Unit(o.axis - 1)).toRotationMatrix();
  return out;
}

/// The axis of an orientation that is about the normal of a shell.
int normal_axis(AbaqusBuild& build, const AbaqusOrientation& o, const std::string& name) {
  const DeckDialect dialect = build.dialect();
  if (o.axis == 0 && dialect == DeckDialect::abaqus)
    build.source.error(ErrorCode::missing, o.at,
                       "orientation {} is used for shells and has no second line (axis and angle "
                       "of the additional rotation)",
                       shown(name));
  if (o.axis == 0) return 3;
  if (o.axis != 3 && dialect == DeckDialect::calculix)
    build.source.error(ErrorCode::unsupported, o.at,
                       "orientation {} is used for shells and turns about axis {}; of CalculiX "
                       "decks only turns about axis 3, the normal, are read",
                       shown(name), o.axis);
  if (o.axis != 3 && o.axis_given && dialect == DeckDialect::by_content && !build.clues.abaqus)
    build.note(o.at,
               "orientation {} of shells turns about axis {}, which is taken "
               "about the normal as in Abaqus; if the deck is one of CalculiX, "
               "which turns the axes in space, give --dialect calculix",
               shown(name), o.axis);
  return o.axis;
}

/// Global axes for shells without an orientation: x, or z where x is the normal.
int default_orientation(AbaqusBuild& build, const Vec3& normal) {
  const bool across = std::abs(normal(0)) > std::cos(0.1 * std::numbers::pi / 180.0);
  const auto [it, fresh] = build.orientation_index.try_emplace(
      across ? "*Z" : "*X", static_cast<int>(build.model.orientations.size()));
  if (!fresh) return it->second;
  Orientation o;
  if (across) o.axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  build.model.orientations.push_back(o);
  return it->second;
}

/// Index of a shell section like that of the element, with the angles of its plies.
int with_angles(AbaqusBuild& build, int section, const std::vector<double>& angles) {
  std::vector<long> key = {section};
  for (const double angle : angles) key.push_back(std::lround(angle * 1e8));
  return changed_copy(build.model.shells, section, build.turned_sections, key,
                      [&](ShellSection& turned) {
                        for (std::size_t k = 0; k < angles.size(); ++k)
                          turned.plies[k].angle = angles[k];
                      });
}

}  // namespace

int abaqus_orientation(AbaqusBuild& build, const std::string& name, const AbaqusSection& section) {
  const bool shell = is_abaqus_sheet(section.family);
  const AbaqusScope scope = section.where.scope;
  const auto [place, fresh] = build.orientation_index.try_emplace(
      fmt::format("{}*{}*{}", name, shell ? "SHELL" : "SOLID", static_cast<int>(scope)), -1);
  if (!fresh) return place->second;
  const AbaqusOrientation* const found = build.content.orientation(scope, name);
  if (found == nullptr) {
    std::vector<std::string> known;
    for (const auto& [key, o] : build.content.orientations)
      if (known.size() < 100) known.push_back(key.second);
    build.error(section, ErrorCode::not_found, " names the orientation {}, which does not exist{}",
                shown(name), did_you_mean(name, known));
    return -1;
  }
  const AbaqusOrientation meant = in_program_of_deck(build, *found, name, shell);
  Orientation o = placed(meant, build.content.placement(meant.scope));
  if (shell) {
    const int normal = normal_axis(build, meant, name);
    Mat3 permuted = Mat3::Zero();
    for (int k = 0; k < 3; ++k) permuted((normal + k) % 3, k) = 1.0;
    o.turn = (o.turn * permuted).eval();
  }
  place->second = static_cast<int>(build.model.orientations.size());
  build.model.orientations.push_back(o);
  return place->second;
}

ShellSection abaqus_shell_section(AbaqusBuild& build, const AbaqusSection& section,
                                  const std::function<int(const std::string&)>& material) {
  ShellSection out;
  for (const AbaqusSection::Ply& ply : section.plies)
    out.plies.push_back({material(ply.material), ply.thickness, ply.angle});
  if (section.symmetric)
    for (std::size_t k = out.plies.size(); k-- > 0;) out.plies.push_back(out.plies[k]);
  out.thickness = section.thickness;
  if (!out.plies.empty()) {
    out.thickness = 0.0;
    for (const ShellPly& ply : out.plies) out.thickness += ply.thickness;
  }
  out.shear = 5.0 / 6.0 * out.thickness;
  out.offset = -section.offset * out.thickness;
  if (is_abaqus_sheet(section.family))
    for (const AbaqusSection::Ply& ply : section.plies)
      if (!ply.orientation.empty()) abaqus_orientation(build, ply.orientation, section);
  return out;
}

void check_abaqus_sheet(AbaqusBuild& build, const AbaqusSection& section, const ShellSection& shell,
                        int material) {
  const std::vector<Material>& all = build.model.materials;
  const std::string huge = huge_sheet(shell, all[material].density, all);
  if (!huge.empty()) build.error(section, ErrorCode::not_finite, ": {}", huge);
}

void orient_abaqus_element(AbaqusBuild& build, const AbaqusSection& section,
                           const AbaqusProperties& p, FeElement& e) {
  if (!is_abaqus_sheet(section.family) || !p.directional) return;
  std::vector<Vec3> corners;
  for (const int node : nodes_of_element(e)) corners.push_back(build.model.positions[node]);
  if (e.orientation < 0) e.orientation = default_orientation(build, shell_normal(corners));
  const bool own = std::any_of(section.plies.begin(), section.plies.end(),
                               [](const auto& ply) { return !ply.orientation.empty(); });
  if (!own) return;
  const std::vector<Orientation>& all = build.model.orientations;
  const Vec3 n = shell_normal(corners), axis = first_axis(corners, &all[e.orientation], 0.0);
  std::vector<double> angles;
  for (const AbaqusSection::Ply& ply : section.plies) {
    double angle = ply.angle;
    if (!ply.orientation.empty()) {
      const int index = abaqus_orientation(build, ply.orientation, section);
      if (index < 0) return;
      const Vec3 along = first_axis(corners, &all[index], 0.0);
      angle = std::atan2(n.dot(axis.cross(along)), axis.dot(along));
    }
    angles.push_back(angle);
  }
  for (std::size_t k = section.symmetric ? angles.size() : 0; k-- > 0;) angles.push_back(angles[k]);
  e.section = with_angles(build, e.section, angles);
}

}  // namespace floatframe

#include "floatframe/decks/abaqus/abaqus_beam_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/fe/plate_section.hpp"

namespace floatframe {
namespace {

BeamSection pipe_section(AbaqusCard& card, double radius, double wall) {
  if (wall > radius) {
    card.error_in_line(ErrorCode::geometry,
                       "the wall of the pipe ({:g}) is thicker than its radius ({:g})", wall,
                       radius);
  }
  return BeamSection::hollow_round(2.0 * radius, 2.0 * (radius - wall));
}

/// Closed thin-walled box, a along direction 1, b along direction 2; the torsion constant is that
/// of Bredt, 4 A_m^2 / (closed integral of ds / t).
BeamSection box_section(AbaqusCard& card, double a, double b, const std::array<double, 4>& t) {
  if (t[0] != t[2] || t[1] != t[3]) {
    card.error_in_line(ErrorCode::unsupported,
                       "opposite walls of the box differ, so that its centroid is not at the "
                       "node, which is not supported");
  }
  const double inner_a = a - t[0] - t[2], inner_b = b - t[1] - t[3];
  if (inner_a < 0.0 || inner_b < 0.0)
    card.error_in_line(ErrorCode::geometry, "the walls of the box overlap");
  BeamSection s;
  s.A = a * b - inner_a * inner_b;
  s.Iy = (a * b * b * b - inner_a * inner_b * inner_b * inner_b) / 12.0;
  s.Iz = (b * a * a * a - inner_b * inner_a * inner_a * inner_a) / 12.0;
  const double mid_a = a - 0.5 * (t[0] + t[2]), mid_b = b - 0.5 * (t[1] + t[3]);
  s.J = 4.0 * mid_a * mid_a * mid_b * mid_b /
        (mid_a / t[1] + mid_a / t[3] + mid_b / t[0] + mid_b / t[2]);
  return s;
}

/// Diameters a along direction 1 (local y), b along direction 2. Torsion: J = pi a^3 b^3 /
/// (16 (a^2 + b^2)), St. Venant's solution.
BeamSection ellipse_section(double a, double b) {
  constexpr double pi = std::numbers::pi;
  BeamSection s;
  s.A = pi * a * b / 4.0;
  s.Iy = pi * a * b * b * b / 64.0;
  s.Iz = pi * a * a * a * b / 64.0;
  s.J = pi * a * a * a * b * b * b / (16.0 * (a * a + b * b));
  return s;
}

/// l, h, b1, b2, t1, t2, t3: the node lies l above the lower edge, direction 2 points up; the lower
/// flange is b1 wide and t1 thick, the upper one b2 and t2, the web t3. A flange without size makes
/// it a T.
void i_section(AbaqusCard& card, const std::vector<double>& d, AbaqusSection& section) {
  const double l = d[0], h = d[1], b1 = d[2], b2 = d[3], t1 = d[4], t2 = d[5], t3 = d[6];
  const auto flange = [&](double b, double t, const char* which) {
    if (b < 0.0 || t < 0.0 || (b > 0.0) != (t > 0.0))
      card.error_in_line(ErrorCode::incomplete,
                         "the {} flange of the I is {:g} wide and {:g} thick, expected both more "
                         "than 0, or both 0",
                         which, b, t);
  };
  flange(b1, t1, "lower");
  flange(b2, t2, "upper");
  if (!(t1 + t2 < h))
    card.error_in_line(
        ErrorCode::geometry,
        "the flanges of the I ({:g} and {:g} thick) leave no web in its height of {:g}", t1, t2, h);
  std::vector<SectionPlate> plates = {{0.0, 0.5 * (t1 + h - t2), t3, h - t1 - t2}};
  if (t1 > 0.0) plates.push_back({0.0, 0.5 * t1, b1, t1});
  if (t2 > 0.0) plates.push_back({0.0, h - 0.5 * t2, b2, t2});
  const PlateSums sums = plate_sums(plates);
  section.beam.A = sums.A;
  section.beam.Iy = sums.Iy;
  section.beam.Iz = sums.Iz;
  section.beam.J = sums.thin_J;
  section.arm(1) = sums.z - l;
  if (std::abs(section.arm(1)) < 1e-12 * h) section.arm(1) = 0.0;
}

constexpr const char* wall_of_box = "thickness of a wall of the box";
constexpr std::array beam_shapes{
    AbaqusBeamShape{"RECT", 2, 1, {"width of the rectangle", "height of the rectangle"}},
    AbaqusBeamShape{"CIRC", 1, 2, {"size of the circle", "second diameter of the ellipse"}},
    AbaqusBeamShape{"PIPE", 2, 0, {"outer radius", "thickness of the wall"}},
    AbaqusBeamShape{"BOX",
                    6,
                    0,
                    {"width of the box", "height of the box", wall_of_box, wall_of_box, wall_of_box,
                     wall_of_box}},
    AbaqusBeamShape{"I",
                    7,
                    0,
                    {"l of the I", "height of the I", "b1 of the I", "b2 of the I", "t1 of the I",
                     "t2 of the I", "thickness of the web of the I"},
                    61u}};

/// Size of a section along directions 1 and 2.
Eigen::Vector2d outer_size(const std::string& shape, const std::vector<double>& d) {
  if (shape == "PIPE") return {2.0 * d[0], 2.0 * d[0]};
  return {d[0], d.size() > 1 ? d[1] : d[0]};
}

}  // namespace

const AbaqusBeamShape* find_abaqus_beam_shape(const std::string& name) {
  const auto it = std::find_if(beam_shapes.begin(), beam_shapes.end(), [&](const auto& s) {
    // RECTANGULAR as well.
    return name == s.name || (std::string_view(s.name).size() > 2 && name.starts_with(s.name));
  });
  return it == beam_shapes.end() ? nullptr : &*it;
}

std::string unread_abaqus_shape(const std::string& name) {
  if (name == "T") return "expected SECTION=I with b1 = t1 = 0 or b2 = t2 = 0";
  const bool other = name == "L" || name.starts_with("TRAP") || name == "HEX" ||
                     name.starts_with("ARBITRARY") || name == "ELBOW" || name == "MESHED";
  return other ? "which is not read: give its area, moments of inertia and torsion constant (*BEAM "
                 "GENERAL SECTION, SECTION=GENERAL)"
               : "expected RECT, CIRC, PIPE, BOX or I";
}

void set_abaqus_beam(AbaqusCard& card, const std::vector<double>& d, const Eigen::Vector2d& offsets,
                     AbaqusSection& section) {
  section.arm = -offsets.cwiseProduct(outer_size(section.shape, d));
  if (section.shape == "RECT") {
    section.beam = BeamSection::rectangle(d[0], d.size() > 1 ? d[1] : d[0]);
  } else if (section.shape == "CIRC") {
    if (d.size() == 1) section.round = d[0];
    if (d.size() == 2) section.beam = ellipse_section(d[0], d[1]);
  } else if (section.shape == "PIPE") {
    section.beam = pipe_section(card, d[0], d[1]);
  } else if (section.shape == "BOX") {
    section.beam = box_section(card, d[0], d[1], {d[2], d[3], d[4], d[5]});
  } else {
    i_section(card, d, section);
  }
}

}  // namespace floatframe

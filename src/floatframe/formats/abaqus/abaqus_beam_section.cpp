// *BEAM SECTION, and *BEAM GENERAL SECTION as CalculiX has it. Abaqus and CalculiX agree on RECT,
// PIPE (radius, wall) and BOX. CIRC has a radius in Abaqus and one or two diameters in CalculiX
// (two: an ellipse); a RECT with one number is a square in CalculiX. CalculiX takes CIRC for
// elements of three nodes only, PIPE and BOX for B32R.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "floatframe/formats/abaqus/abaqus_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

BeamSection pipe(AbaqusLines& lines, double radius, double wall) {
  if (wall > radius) {
    lines.source().error(
        fmt::format("the wall of the pipe ({:g}) is thicker than its radius ({:g})", wall, radius));
  }
  return BeamSection::hollow_round(2.0 * radius, 2.0 * (radius - wall));
}

/// Closed thin-walled box, a along direction 1, b along direction 2; the torsion constant is that
/// of Bredt, 4 A_m^2 / (closed integral of ds / t).
BeamSection box(AbaqusLines& lines, double a, double b, const std::array<double, 4>& t) {
  if (t[0] != t[2] || t[1] != t[3]) {
    lines.source().error(
        "opposite walls of the box differ, so that its centroid is not at the "
        "node, which is not supported");
  }
  const double inner_a = a - t[0] - t[2], inner_b = b - t[1] - t[3];
  if (inner_a < 0.0 || inner_b < 0.0) lines.source().error("the walls of the box overlap");
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
BeamSection ellipse(double a, double b) {
  constexpr double pi = std::numbers::pi;
  BeamSection s;
  s.A = pi * a * b / 4.0;
  s.Iy = pi * a * b * b * b / 64.0;
  s.Iz = pi * a * a * a * b / 64.0;
  s.J = pi * a * a * a * b * b * b / (16.0 * (a * a + b * b));
  return s;
}

/// How many numbers a section has: in both programs, and in CalculiX alone (0: none). What they
/// are.
struct Shape {
  const char* name;
  std::size_t numbers, calculix;
  std::array<const char*, 6> what;
};
constexpr const char* wall_of_box = "thickness of a wall of the box";
constexpr std::array shapes{
    Shape{"RECT", 2, 1, {"width of the rectangle", "height of the rectangle"}},
    Shape{"CIRC", 1, 2, {"size of the circle", "second diameter of the ellipse"}},
    Shape{"PIPE", 2, 0, {"outer radius", "thickness of the wall"}},
    Shape{"BOX",
          6,
          0,
          {"width of the box", "height of the box", wall_of_box, wall_of_box, wall_of_box,
           wall_of_box}}};

void no_offset(AbaqusLines& lines, const AbaqusKeyword& keyword) {
  for (const char* offset : {"OFFSET1", "OFFSET2"}) {
    if (keyword.has(offset) && parse_real(keyword.value(offset)).value_or(1.0) != 0.0) {
      lines.error(keyword, fmt::format("has an offset ({}), which is not supported", offset));
    }
  }
}

/// The numbers of the section; false and an error if there are not as many as the shape has, or one
/// is not positive.
bool read_numbers(AbaqusLines& lines, const AbaqusKeyword& keyword, const Shape& shape,
                  DeckDialect dialect, std::vector<double>& numbers) {
  std::vector<std::string_view> fields;
  lines.next_fields(fields);
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  const std::size_t n = fields.size();
  const bool calculix = shape.calculix != 0 && n == shape.calculix;
  if (n != shape.numbers && !(calculix && dialect != DeckDialect::abaqus)) {
    const bool both = shape.calculix != 0 && dialect != DeckDialect::abaqus;
    lines.error(keyword,
                fmt::format("has {} dimension{}, expected {}", n, n == 1 ? "" : "s",
                            both ? fmt::format("{} or {}", std::min(shape.numbers, shape.calculix),
                                               std::max(shape.numbers, shape.calculix))
                                 : std::to_string(shape.numbers)));
    lines.skip_data();
    return false;
  }
  const std::size_t before = lines.source().errors();
  for (std::size_t k = 0; k < n; ++k) {
    numbers.push_back(positive_real(lines, fields[k], shape.what[k]));
  }
  if (lines.source().errors() == before) return true;
  lines.skip_data();
  return false;
}

}  // namespace

void read_abaqus_beam_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "SECTION", "OFFSET1", "OFFSET2",
                             "TEMPERATURE", "POISSON"});
  no_offset(lines, keyword);
  if (keyword.name == "BEAMGENERALSECTION" && !keyword.has("MATERIAL")) {
    lines.error(keyword,
                "has no MATERIAL, as in Abaqus, which is not supported: use *BEAM SECTION");
    return lines.skip_data();
  }
  section.shape = abaqus_name(lines.required(keyword, "SECTION"));
  // RECTANGULAR as well.
  const auto shape = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& s) {
    return section.shape.starts_with(s.name);
  });
  if (shape != shapes.end()) section.shape = shape->name;
  if (shape == shapes.end() && !section.shape.empty()) {
    lines.error(keyword, fmt::format("has the section {}, expected RECT, CIRC, PIPE or BOX",
                                     shown(section.shape)));
  }
  if (!begin_abaqus_section(lines, keyword, content, AbaqusType::Family::beam, section) ||
      shape == shapes.end()) {
    return lines.skip_data();
  }
  std::vector<double> d;
  if (!read_numbers(lines, keyword, *shape, content.dialect, d)) return;
  section.calculix_form = d.size() != shape->numbers;
  if (section.calculix_form) {
    content.clues.add(DeckDialect::calculix,
                      fmt::format("{}, SECTION={} with {} dimension{}", keyword.shown, shape->name,
                                  d.size(), d.size() == 1 ? "" : "s"),
                      keyword.at);
  }
  if (section.shape == "RECT") {
    section.beam = BeamSection::rectangle(d[0], d.size() > 1 ? d[1] : d[0]);
  } else if (section.shape == "CIRC") {
    if (d.size() == 1) section.round = d[0];
    if (d.size() == 2) section.beam = ellipse(d[0], d[1]);
  } else if (section.shape == "PIPE") {
    section.beam = pipe(lines, d[0], d[1]);
  } else {
    section.beam = box(lines, d[0], d[1], {d[2], d[3], d[4], d[5]});
  }
  std::vector<std::string_view> fields;
  if (lines.next_fields(fields)) {
    for (std::size_t k = 0; k < 3; ++k) {
      section.n1[static_cast<Eigen::Index>(k)] =
          lines.real_or(fields, k, 0.0, "direction 1 of the section");
    }
    if (!(section.n1.stableNorm() > 0.0))
      lines.source().error("direction 1 of the section is zero");
  }
  content.sections.push_back(section);
}

}  // namespace floatframe

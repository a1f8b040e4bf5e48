// *BEAM SECTION, and *BEAM GENERAL SECTION as CalculiX has it (with a material) and as Abaqus has
// it (with E and G in its lines; also SECTION=GENERAL of given constants). Both programs agree on
// RECT, PIPE (radius, wall) and BOX. CIRC has a radius in Abaqus and one or two diameters in
// CalculiX (two: an ellipse); a RECT with one number is a square in CalculiX. CalculiX takes CIRC
// for elements of three nodes only, PIPE and BOX for B32R.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// A, I11, I12, I22, J of SECTION=GENERAL. Direction 1 is local y.
bool read_constants(AbaqusLines& lines, const AbaqusKeyword& keyword, BeamSection& beam) {
  std::vector<std::string_view> fields;
  lines.next_fields(fields);
  if (fields.size() < 5) {
    lines.error(keyword, fmt::format("has {} constants, expected A, I11, I12, I22, J",
                                     fields.size() == 1 && fields[0].empty() ? 0 : fields.size()));
    return false;
  }
  const std::size_t before = lines.source().errors();
  beam.A = positive_real(lines, fields[0], "area A");
  beam.Iy = positive_real(lines, fields[1], "moment I11");
  if (const double I12 = lines.real_or(fields, 2, 0.0, "moment I12"); I12 != 0.0)
    lines.source().error(
        fmt::format("I12 is {:g}, expected 0: give the moments and direction 1 "
                    "of the principal axes",
                    I12));
  beam.Iz = positive_real(lines, fields[3], "moment I22");
  beam.J = positive_real(lines, fields[4], "torsion constant J");
  for (std::size_t k = 5; k < fields.size(); ++k)
    if (lines.real_or(fields, k, 0.0, "sectorial constant") != 0.0)
      lines.source().error("sectorial moment and warping constant are not read: expected 0");
  return lines.source().errors() == before;
}

/// Of the line at a place, which need not be the last one.
void read_direction(AbaqusLines& lines, const std::vector<std::string_view>& fields,
                    const FeSource& at, AbaqusSection& section) {
  section.n1.setZero();
  for (std::size_t k = 0; k < std::min<std::size_t>(fields.size(), 3); ++k) {
    if (fields[k].empty()) continue;
    const std::optional<double> value = parse_real(fields[k]);
    if (!value)
      return lines.source().error(at, "direction 1 of the section: " + not_a_real(fields[k]));
    section.n1[static_cast<Eigen::Index>(k)] = *value;
  }
  if (!(section.n1.stableNorm() > 0.0))
    lines.source().error(at, "direction 1 of the section is zero");
}

/// E, G: the material of a section that has none.
void add_material(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                  const std::vector<std::string_view>& fields, const std::string& name) {
  AbaqusMaterial material;
  material.at = keyword.at;
  const std::size_t before = lines.source().errors();
  material.young = positive_real(lines, fields[0], "E");
  const double G = positive_real(lines, fields[1], "G");
  if (keyword.has("DENSITY")) {
    const auto density = parse_real(keyword.value("DENSITY"));
    if (!density || !(*density >= 0.0) || !std::isfinite(*density))
      lines.error(keyword, fmt::format("has the density {}, expected a number from 0",
                                       shown(keyword.value("DENSITY"))));
    material.density = density;
  }
  if (lines.source().errors() > before) return;
  material.poisson = *material.young / (2.0 * G) - 1.0;
  if (!(*material.poisson > -1.0 && *material.poisson < 0.5))
    lines.error(keyword, fmt::format("has E = {:g} and G = {:g}, which no isotropic material has: "
                                     "expected G from E/3 on",
                                     *material.young, G));
  if (content.materials.emplace(name, material).second) content.material_order.push_back(name);
}

/// Direction 1, which may be missing, then E and G.
void read_direction_and_material(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content, AbaqusSection& section) {
  std::vector<std::string> texts;
  FeSource first;
  std::string_view line;
  while (lines.next_data(line)) {
    if (texts.empty()) first = lines.source().here();
    if (texts.size() < 3) texts.emplace_back(line);
  }
  if (texts.empty() || texts.size() > 2) {
    lines.error(keyword, texts.empty() ? "has no line with E and G behind its dimensions"
                                       : "depends on temperature or fields (a second line of E and "
                                         "G), which is not supported");
    return;
  }
  std::vector<std::string_view> fields;
  if (texts.size() == 2) {
    split_commas(texts[0], fields);
    read_direction(lines, fields, first, section);
  }
  split_commas(texts.back(), fields);
  if (fields.size() < 2) {
    lines.error(keyword, "has one number in its last line, expected E and G");
    return;
  }
  add_material(lines, keyword, content, fields, section.material);
}

void read_general_section(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                          AbaqusSection& section) {
  if (!begin_abaqus_section(lines, keyword, content, AbaqusType::Family::beam, section)) return;
  if (!read_constants(lines, keyword, section.beam)) return lines.skip_data();
  read_direction_and_material(lines, keyword, content, section);
  content.sections.push_back(section);
}

}  // namespace

void read_abaqus_beam_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "SECTION", "OFFSET1", "OFFSET2",
                             "TEMPERATURE", "POISSON", "DENSITY", "LUMPED", "ZERO"});
  no_offset(lines, keyword);
  if (keyword.has("LUMPED") && !same_word(keyword.value("LUMPED"), "YES"))
    lines.error(keyword, fmt::format("has LUMPED={}, expected YES: leave it out, and read the deck "
                                     "with --mass-form consistent",
                                     shown(keyword.value("LUMPED"))));
  const bool own_material = keyword.name == "BEAMGENERALSECTION" && !keyword.has("MATERIAL");
  if (own_material) {
    section.material = fmt::format("{}, line {}", keyword.shown, keyword.at.line);
    content.clues.add(DeckDialect::abaqus, keyword.shown + " without MATERIAL", keyword.at);
  } else if (keyword.has("DENSITY")) {
    lines.error(keyword, "has MATERIAL and DENSITY: leave the density to the material");
  }
  section.shape = own_material && !keyword.has("SECTION")
                      ? "GENERAL"
                      : abaqus_name(lines.required(keyword, "SECTION"));
  if (own_material && section.shape == "GENERAL")
    return read_general_section(lines, keyword, content, section);
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
  if (own_material) {
    read_direction_and_material(lines, keyword, content, section);
  } else if (std::vector<std::string_view> fields; lines.next_fields(fields)) {
    read_direction(lines, fields, lines.source().here(), section);
  }
  content.sections.push_back(section);
}

}  // namespace floatframe

// *BEAM SECTION, and *BEAM GENERAL SECTION of CalculiX (with a material) and of Abaqus (with E and
// G in its lines; also SECTION=GENERAL with given constants). Both programs agree on
// RECT, PIPE (radius, wall) and BOX. CIRC has a radius in Abaqus and one or two diameters in
// CalculiX (two: an ellipse); a RECT with one number is a square in CalculiX. CalculiX takes CIRC
// for elements of three nodes only, PIPE and BOX for B32R.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/fe/plate_section.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Numbers = std::vector<double>;

void set_rectangle(AbaqusCard& /*card*/, const Numbers& d, AbaqusSection& section) {
  section.beam = BeamSection::rectangle(d[0], d.size() > 1 ? d[1] : d[0]);
}

/// One diameter or radius, or the diameters a along direction 1 (local y), b along direction 2 of
/// an ellipse. Torsion: J = pi a^3 b^3 / (16 (a^2 + b^2)), St. Venant's solution.
void set_ellipse(AbaqusCard& /*card*/, const Numbers& d, AbaqusSection& section) {
  constexpr double pi = std::numbers::pi;
  section.round = d.size() == 1 ? d[0] : 0.0;
  if (d.size() == 1) return;
  const double a = d[0], b = d[1];
  section.beam.A = pi * a * b / 4.0;
  section.beam.Iy = pi * a * b * b * b / 64.0;
  section.beam.Iz = pi * a * a * a * b / 64.0;
  section.beam.J = pi * a * a * a * b * b * b / (16.0 * (a * a + b * b));
}

void set_pipe(AbaqusCard& card, const Numbers& d, AbaqusSection& section) {
  const double radius = d[0], wall = d[1];
  if (wall > radius)
    card.error_in_line(ErrorCode::geometry,
                       "the wall of the pipe ({:g}) is thicker than its radius ({:g})", wall,
                       radius);
  section.beam = BeamSection::hollow_round(2.0 * radius, 2.0 * (radius - wall));
}

/// Closed thin-walled box, a along direction 1, b along direction 2.
void set_box(AbaqusCard& card, const Numbers& d, AbaqusSection& section) {
  const double a = d[0], b = d[1];
  const double* const t = &d[2];
  if (t[0] != t[2] || t[1] != t[3])
    card.error_in_line(ErrorCode::unsupported,
                       "opposite walls of the box differ, so that its centroid is not at the node, "
                       "which is not supported");
  const double inner_a = a - t[0] - t[2], inner_b = b - t[1] - t[3];
  if (inner_a < 0.0 || inner_b < 0.0)
    card.error_in_line(ErrorCode::geometry, "the walls of the box overlap");
  BeamSection& s = section.beam;
  s.A = a * b - inner_a * inner_b;
  s.Iy = (a * b * b * b - inner_a * inner_b * inner_b * inner_b) / 12.0;
  s.Iz = (b * a * a * a - inner_b * inner_a * inner_a * inner_a) / 12.0;
  s.J = bredt_torsion(a, b, t[1], t[3], t[0], t[2]);
}

/// l, h, b1, b2, t1, t2, t3: the node is l above the lower edge, direction 2 points up; the lower
/// flange is b1 wide and t1 thick, the upper one b2 and t2, the web t3. A flange of zero size gives
/// a T.
void set_i(AbaqusCard& card, const Numbers& d, AbaqusSection& section) {
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

struct AbaqusShape {
  const char* name;
  std::size_t numbers, calculix;  ///< how many: in both programs, in CalculiX only (0: none)
  void (*set)(AbaqusCard& card, const Numbers& d, AbaqusSection& section);
  std::array<const char*, 7> what;
  unsigned any = 0;  ///< bit k: number k need not be positive
};

constexpr const char* wall_of_box = "thickness of a wall of the box";
constexpr AbaqusShape beam_shapes[] = {
    {"RECT", 2, 1, set_rectangle, {"width of the rectangle", "height of the rectangle"}},
    {"CIRC", 1, 2, set_ellipse, {"size of the circle", "second diameter of the ellipse"}},
    {"PIPE", 2, 0, set_pipe, {"outer radius", "thickness of the wall"}},
    {"BOX",
     6,
     0,
     set_box,
     {"width of the box", "height of the box", wall_of_box, wall_of_box, wall_of_box, wall_of_box}},
    {"I",
     7,
     0,
     set_i,
     {"l of the I", "height of the I", "b1 of the I", "b2 of the I", "t1 of the I", "t2 of the I",
      "thickness of the web of the I"},
     61u}};

/// Shape of SECTION=...; null if it is not supported.
const AbaqusShape* find_beam_shape(std::string_view name) {
  const auto it = std::find_if(std::begin(beam_shapes), std::end(beam_shapes), [&](const auto& s) {
    const std::string_view known = s.name;
    return name == known || (known.size() > 2 && name.starts_with(known));  // RECTANGULAR as well
  });
  return it == std::end(beam_shapes) ? nullptr : it;
}

/// Message for a shape that is not supported.
std::string unread_shape(const std::string& name) {
  if (name == "T") return "expected SECTION=I with b1 = t1 = 0 or b2 = t2 = 0";
  const bool other = name == "L" || name.starts_with("TRAP") || name == "HEX" ||
                     name.starts_with("ARBITRARY") || name == "ELBOW" || name == "MESHED";
  return other ? "which is not read: give its area, moments of inertia and torsion constant (*BEAM "
                 "GENERAL SECTION, SECTION=GENERAL)"
               : "expected RECT, CIRC, PIPE, BOX or I";
}

/// OFFSET1, OFFSET2 of CalculiX: of the node from the centroid, in thicknesses along 1 and 2.
Eigen::Vector2d offsets_of(AbaqusCard& card) {
  Eigen::Vector2d out(0.0, 0.0);
  int k = 0;
  for (const char* name : {"OFFSET1", "OFFSET2"}) {
    double& value = out(k++);
    if (!card.has(name)) continue;
    const auto number = parse_real(card.value(name));
    if (!number || !std::isfinite(*number))
      card.error(ErrorCode::out_of_range, "has {}={}, expected a number", name,
                 shown(card.value(name)));
    else
      value = *number;
  }
  return out;
}

/// The numbers of the section; false and an error if their number does not match the shape, or one
/// that must be positive is not.
bool read_numbers(AbaqusCard& card, const AbaqusShape& shape, std::vector<double>& numbers) {
  card.next();
  while (!card.fields.empty() && card.fields.back().empty()) card.fields.pop_back();
  const std::size_t n = card.fields.size();
  const bool both = shape.calculix != 0 && card.content.options.dialect != DeckDialect::abaqus;
  if (n != shape.numbers && !(both && n == shape.calculix)) {
    card.error(ErrorCode::wrong_count, "has {} dimension{}, expected {}", n, n == 1 ? "" : "s",
               both ? fmt::format("{} or {}", std::min(shape.numbers, shape.calculix),
                                  std::max(shape.numbers, shape.calculix))
                    : std::to_string(shape.numbers));
    return false;
  }
  const std::size_t before = card.source.errors();
  for (std::size_t k = 0; k < n; ++k)
    numbers.push_back((shape.any >> k & 1u) != 0 ? card.real(k, shape.what[k])
                                                 : card.positive(k, shape.what[k]));
  return card.source.errors() == before;
}

/// A, I11, I12, I22, J of SECTION=GENERAL. Direction 1 is local y.
bool read_constants(AbaqusCard& card, BeamSection& beam) {
  card.next();
  const std::size_t n = card.fields.size();
  if (n < 5) {
    card.error(ErrorCode::wrong_count, "has {} constants, expected A, I11, I12, I22, J",
               n == 1 && card.field(0).empty() ? 0 : n);
    return false;
  }
  beam.A = card.positive(0, "area A");
  beam.Iy = card.positive(1, "moment I11");
  if (const double I12 = card.real_or(2, 0.0, "moment I12"); I12 != 0.0)
    card.error_in_line(
        ErrorCode::out_of_range,
        "I12 is {:g}, expected 0: give the moments and direction 1 of the principal axes", I12);
  beam.Iz = card.positive(3, "moment I22");
  beam.J = card.positive(4, "torsion constant J");
  for (std::size_t k = 5; k < n; ++k)
    if (card.real_or(k, 0.0, "sectorial constant") != 0.0)
      card.error_in_line(ErrorCode::unsupported,
                         "sectorial moment and warping constant are not read: expected 0");
  return !card.misread();
}

/// For the line at a location, which need not be the last one.
void read_direction(AbaqusCard& card, const FeSource& line, AbaqusSection& section) {
  section.n1.setZero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (card.field(k).empty()) continue;
    const std::optional<double> value = parse_real(card.field(k));
    if (!value)
      return card.source.error(ErrorCode::not_a_number, line, "direction 1 of the section: {}",
                               not_a_real(card.field(k)));
    section.n1(static_cast<Eigen::Index>(k)) = *value;
  }
  if (!(section.n1.stableNorm() > 0.0))
    card.source.error(ErrorCode::geometry, line, "direction 1 of the section is zero");
}

/// E, G: the material of a section that has none.
void add_material(AbaqusCard& card, const std::string& name) {
  AbaqusContent& content = card.content;
  AbaqusMaterial material;
  material.at = card.at;
  const std::size_t before = card.source.errors();
  material.young = card.positive(0, "E");
  const double G = card.positive(1, "G");
  if (card.has("DENSITY")) {
    const auto density = parse_real(card.value("DENSITY"));
    if (!density || !(*density >= 0.0) || !std::isfinite(*density))
      card.error(ErrorCode::out_of_range, "has the density {}, expected a number from 0",
                 shown(card.value("DENSITY")));
    material.density = density;
  }
  if (card.source.errors() > before) return;
  material.poisson = *material.young / (2.0 * G) - 1.0;
  if (!(*material.poisson > -1.0 && *material.poisson < 0.5))
    card.error(ErrorCode::contradiction,
               "has E = {:g} and G = {:g}, which no isotropic material has: expected G from E/3 on",
               *material.young, G);
  if (content.materials.emplace(name, material).second) content.material_order.push_back(name);
}

/// Direction 1, which may be missing, then E and G.
void read_direction_and_material(AbaqusCard& card, AbaqusSection& section) {
  std::vector<std::string> texts;
  FeSource first;
  std::string_view line;
  while (card.lines.next_data(line)) {
    if (texts.empty()) first = card.here();
    if (texts.size() < 3) texts.emplace_back(line);
  }
  if (texts.empty() || texts.size() > 2)
    return card.error(ErrorCode::unsupported,
                      texts.empty() ? "has no line with E and G behind its dimensions"
                                    : "depends on temperature or fields (a second line of E and "
                                      "G), which is not supported");
  if (texts.size() == 2) {
    split_commas(texts[0], card.fields);
    read_direction(card, first, section);
  }
  split_commas(texts.back(), card.fields);
  if (card.fields.size() < 2)
    return card.error(ErrorCode::wrong_count, "has one number in its last line, expected E and G");
  add_material(card, section.material);
}

void read_general_section(AbaqusCard& card, AbaqusSection& section) {
  if (!begin_abaqus_section(card, AbaqusType::Family::beam, section) ||
      !read_constants(card, section.beam))
    return;
  read_direction_and_material(card, section);
  card.content.sections.push_back(section);
}

/// Evidence of the program from the dimensions of a section, and messages about its shape.
void look_at_dimensions(AbaqusCard& card, const AbaqusShape& shape, std::size_t dimensions) {
  if (dimensions != shape.numbers)
    card.content.clues.add(DeckDialect::calculix,
                           fmt::format("{}, SECTION={} with {} dimension{}", card.shown, shape.name,
                                       dimensions, dimensions == 1 ? "" : "s"),
                           card.at);
  if (shape.name != std::string_view("I")) return;
  card.content.clues.add(DeckDialect::abaqus, card.shown + ", SECTION=I", card.at);
  card.note(
      "{}, SECTION=I: area and moments are those of its rectangles, the torsion constant is the "
      "sum of b t^3/3, about the centroid; Abaqus integrates along the middle of the walls",
      card.shown);
}

}  // namespace

void read_abaqus_beam_section(AbaqusCard& card) {
  AbaqusSection section;
  AbaqusContent& content = card.content;
  const Eigen::Vector2d offsets = offsets_of(card);
  section.calculix_offset = !offsets.isZero(0.0);
  if (card.has("LUMPED") && !same_word(card.value("LUMPED"), "YES"))
    card.error(
        ErrorCode::unsupported,
        "has LUMPED={}, expected YES: leave it out, and read the deck with --mass-form consistent",
        shown(card.value("LUMPED")));
  const bool own_material = card.name == "BEAMGENERALSECTION" && !card.has("MATERIAL");
  if (own_material) {
    section.material = fmt::format("{}, line {}", card.shown, card.at.line);
    content.clues.add(DeckDialect::abaqus, card.shown + " without MATERIAL", card.at);
  } else if (card.has("DENSITY")) {
    card.error(ErrorCode::exclusive, "has MATERIAL and DENSITY: leave the density to the material");
  }
  section.shape =
      own_material && !card.has("SECTION") ? "GENERAL" : abaqus_name(card.required("SECTION"));
  if (own_material && section.shape == "GENERAL") {
    if (section.calculix_offset)
      card.error(ErrorCode::exclusive, "has OFFSET1 or OFFSET2, which constants do not have");
    return read_general_section(card, section);
  }
  const AbaqusShape* const shape = find_beam_shape(section.shape);
  if (shape != nullptr) section.shape = shape->name;
  if (shape == nullptr && !section.shape.empty())
    card.error(ErrorCode::unsupported, "has the section {}, {}", shown(section.shape),
               unread_shape(section.shape));
  std::vector<double> d;
  if (!begin_abaqus_section(card, AbaqusType::Family::beam, section) || shape == nullptr ||
      !read_numbers(card, *shape, d))
    return;
  section.calculix_form = d.size() != shape->numbers;
  // Size along directions 1 and 2.
  const bool pipe = section.shape == "PIPE", one = d.size() == 1;
  const Eigen::Vector2d size(pipe ? 2.0 * d[0] : d[0], pipe ? 2.0 * d[0] : one ? d[0] : d[1]);
  section.arm = -offsets.cwiseProduct(size);
  shape->set(card, d, section);
  look_at_dimensions(card, *shape, d.size());
  if (own_material)
    read_direction_and_material(card, section);
  else if (card.next())
    read_direction(card, card.here(), section);
  content.sections.push_back(section);
}

/// x1, x2 of a line after a beam section: *BEAM SECTION OFFSET of one with a shape, *CENTROID and
/// *SHEAR CENTER of given constants.
void read_abaqus_place_in_section(AbaqusCard& card) {
  const bool constants = card.name != "BEAMSECTIONOFFSET";
  card.needs_line();
  const Eigen::Vector2d place{card.real_or(0, 0.0, "place in the section"),
                              card.real_or(1, 0.0, "place in the section")};
  card.no_more(2);
  std::vector<AbaqusSection>& all = card.content.sections;
  if (all.empty() || all.back().family != AbaqusType::Family::beam ||
      (all.back().shape == "GENERAL") != constants) {
    if (!card.wrong())
      card.error(ErrorCode::incomplete,
                 constants ? "does not follow a *BEAM GENERAL SECTION of given constants"
                           : "does not follow a beam section with a shape");
    return;
  }
  AbaqusSection& s = all.back();
  if (card.name == "CENTROID") {
    s.arm = place;
  } else if (constants) {
    s.shear_center = place;
  } else if (s.offset_at) {
    card.error(ErrorCode::duplicate, "is given a second time for its section ({})",
               card.place(*s.offset_at));
  } else if (s.calculix_offset) {
    card.error(ErrorCode::exclusive,
               "follows a section with OFFSET1 or OFFSET2 ({}), expected one of both: this line is "
               "one of Abaqus, those are of CalculiX",
               card.place(s.where.at));
  } else {
    s.offset_at = card.at;
    s.arm += place;
  }
}

}  // namespace floatframe

// *BEAM SECTION, and *BEAM GENERAL SECTION as CalculiX has it (with a material) and as Abaqus has
// it (with E and G in its lines; also SECTION=GENERAL of given constants). Both programs agree on
// RECT, PIPE (radius, wall) and BOX. CIRC has a radius in Abaqus and one or two diameters in
// CalculiX (two: an ellipse); a RECT with one number is a square in CalculiX. CalculiX takes CIRC
// for elements of three nodes only, PIPE and BOX for B32R.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/decks/abaqus/abaqus_beam_shapes.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// OFFSET1, OFFSET2 of CalculiX: of the node from the centroid, in thicknesses along 1 and 2.
Eigen::Vector2d offsets_of(AbaqusLines& lines, const AbaqusKeyword& keyword) {
  Eigen::Vector2d out(0.0, 0.0);
  int k = 0;
  for (const char* name : {"OFFSET1", "OFFSET2"}) {
    double& value = out(k++);
    if (!keyword.has(name)) continue;
    const auto number = parse_real(keyword.value(name));
    if (number && std::isfinite(*number)) {
      value = *number;
    } else {
      lines.error(ErrorCode::out_of_range, keyword, "has {}={}, expected a number", name,
                  shown(keyword.value(name)));
    }
  }
  return out;
}

/// The numbers of the section; false and an error if there are not as many as the shape has, or one
/// is not positive that must be.
bool read_numbers(AbaqusLines& lines, const AbaqusKeyword& keyword, const AbaqusBeamShape& shape,
                  DeckDialect dialect, std::vector<double>& numbers) {
  std::vector<std::string_view> fields;
  lines.next_fields(fields);
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  const std::size_t n = fields.size();
  const bool calculix = shape.calculix != 0 && n == shape.calculix;
  if (n != shape.numbers && !(calculix && dialect != DeckDialect::abaqus)) {
    const bool both = shape.calculix != 0 && dialect != DeckDialect::abaqus;
    lines.error(ErrorCode::wrong_count, keyword, "has {} dimension{}, expected {}", n,
                n == 1 ? "" : "s",
                both ? fmt::format("{} or {}", std::min(shape.numbers, shape.calculix),
                                   std::max(shape.numbers, shape.calculix))
                     : std::to_string(shape.numbers));
    lines.skip_data();
    return false;
  }
  const std::size_t before = lines.source().errors();
  for (std::size_t k = 0; k < n; ++k) {
    numbers.push_back((shape.any >> k & 1u) != 0 ? lines.real(fields[k], shape.what[k])
                                                 : positive_real(lines, fields[k], shape.what[k]));
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
    lines.error(ErrorCode::wrong_count, keyword, "has {} constants, expected A, I11, I12, I22, J",
                fields.size() == 1 && fields[0].empty() ? 0 : fields.size());
    return false;
  }
  const std::size_t before = lines.source().errors();
  beam.A = positive_real(lines, fields[0], "area A");
  beam.Iy = positive_real(lines, fields[1], "moment I11");
  if (const double I12 = lines.real_or(fields, 2, 0.0, "moment I12"); I12 != 0.0)
    lines.source().error(
        ErrorCode::out_of_range,
        "I12 is {:g}, expected 0: give the moments and direction 1 of the principal axes", I12);
  beam.Iz = positive_real(lines, fields[3], "moment I22");
  beam.J = positive_real(lines, fields[4], "torsion constant J");
  for (std::size_t k = 5; k < fields.size(); ++k)
    if (lines.real_or(fields, k, 0.0, "sectorial constant") != 0.0)
      lines.source().error(ErrorCode::unsupported,
                           "sectorial moment and warping constant are not read: expected 0");
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
      return lines.source().error(ErrorCode::not_a_number, at,
                                  "direction 1 of the section: " + not_a_real(fields[k]));
    section.n1[static_cast<Eigen::Index>(k)] = *value;
  }
  if (!(section.n1.stableNorm() > 0.0))
    lines.source().error(ErrorCode::geometry, at, "direction 1 of the section is zero");
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
      lines.error(ErrorCode::out_of_range, keyword, "has the density {}, expected a number from 0",
                  shown(keyword.value("DENSITY")));
    material.density = density;
  }
  if (lines.source().errors() > before) return;
  material.poisson = *material.young / (2.0 * G) - 1.0;
  if (!(*material.poisson > -1.0 && *material.poisson < 0.5))
    lines.error(
        ErrorCode::contradiction, keyword,
        "has E = {:g} and G = {:g}, which no isotropic material has: expected G from E/3 on",
        *material.young, G);
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
    lines.error(ErrorCode::unsupported, keyword,
                texts.empty() ? "has no line with E and G behind its dimensions"
                              : "depends on temperature or fields (a second line of E and G), "
                                "which is not supported");
    return;
  }
  std::vector<std::string_view> fields;
  if (texts.size() == 2) {
    split_commas(texts[0], fields);
    read_direction(lines, fields, first, section);
  }
  split_commas(texts.back(), fields);
  if (fields.size() < 2) {
    lines.error(ErrorCode::wrong_count, keyword,
                "has one number in its last line, expected E and G");
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
  const Eigen::Vector2d offsets = offsets_of(lines, keyword);
  section.calculix_offset = !offsets.isZero(0.0);
  if (keyword.has("LUMPED") && !same_word(keyword.value("LUMPED"), "YES"))
    lines.error(
        ErrorCode::unsupported, keyword,
        "has LUMPED={}, expected YES: leave it out, and read the deck with --mass-form consistent",
        shown(keyword.value("LUMPED")));
  const bool own_material = keyword.name == "BEAMGENERALSECTION" && !keyword.has("MATERIAL");
  if (own_material) {
    section.material = fmt::format("{}, line {}", keyword.shown, keyword.at.line);
    content.clues.add(DeckDialect::abaqus, keyword.shown + " without MATERIAL", keyword.at);
  } else if (keyword.has("DENSITY")) {
    lines.error(ErrorCode::exclusive, keyword,
                "has MATERIAL and DENSITY: leave the density to the material");
  }
  section.shape = own_material && !keyword.has("SECTION")
                      ? "GENERAL"
                      : abaqus_name(lines.required(keyword, "SECTION"));
  if (own_material && section.shape == "GENERAL" && section.calculix_offset)
    lines.error(ErrorCode::exclusive, keyword,
                "has OFFSET1 or OFFSET2, which constants do not have");
  if (own_material && section.shape == "GENERAL")
    return read_general_section(lines, keyword, content, section);
  const AbaqusBeamShape* const shape = find_abaqus_beam_shape(section.shape);
  if (shape != nullptr) section.shape = shape->name;
  if (shape == nullptr && !section.shape.empty())
    lines.error(ErrorCode::unsupported, keyword, "has the section {}, {}", shown(section.shape),
                unread_abaqus_shape(section.shape));
  if (!begin_abaqus_section(lines, keyword, content, AbaqusType::Family::beam, section) ||
      shape == nullptr) {
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
  set_abaqus_beam(lines, d, offsets, section);
  if (section.shape == "I") {
    content.clues.add(DeckDialect::abaqus, keyword.shown + ", SECTION=I", keyword.at);
    content.note(lines.source().mark(keyword.at),
                 fmt::format("{}, SECTION=I: area and moments are those of its rectangles, the "
                             "torsion constant is the sum of b t^3/3, about the centroid; Abaqus "
                             "integrates along the middle of the walls",
                             keyword.shown));
  }
  if (own_material) {
    read_direction_and_material(lines, keyword, content, section);
  } else if (std::vector<std::string_view> fields; lines.next_fields(fields)) {
    read_direction(lines, fields, lines.source().here(), section);
  }
  content.sections.push_back(section);
}

namespace {

/// x1, x2 of a line behind a beam section; no section and an error if there is none.
AbaqusSection* place_in_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                AbaqusContent& content, bool constants, Eigen::Vector2d& place) {
  std::vector<std::string_view> fields;
  const std::size_t before = lines.source().errors();
  if (!lines.next_fields(fields)) lines.error(ErrorCode::missing, keyword, "has no data line");
  for (std::size_t k = 0; k < 2; ++k)
    place(static_cast<Eigen::Index>(k)) = lines.real_or(fields, k, 0.0, "place in the section");
  lines.no_more(keyword, fields, 2);
  AbaqusSection* const section = content.sections.empty() ? nullptr : &content.sections.back();
  if (section == nullptr || section->family != AbaqusType::Family::beam ||
      (section->shape == "GENERAL") != constants) {
    if (lines.source().errors() == before)
      lines.error(ErrorCode::incomplete, keyword,
                  constants ? "does not follow a *BEAM GENERAL SECTION of given constants"
                            : "does not follow a beam section with a shape");
    return nullptr;
  }
  return section;
}

}  // namespace

void read_abaqus_beam_section_offset(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                     AbaqusContent& content) {
  Eigen::Vector2d place;
  AbaqusSection* const s = place_in_section(lines, keyword, content, false, place);
  if (s == nullptr) return;
  if (s->offset_at) {
    const SourceMark first = lines.source().mark(*s->offset_at);
    return lines.error(ErrorCode::duplicate, keyword,
                       "is given a second time for its section ({}:{})", first.file, first.line);
  }
  if (s->calculix_offset) {
    const SourceMark mark = lines.source().mark(s->at);
    return lines.error(ErrorCode::exclusive, keyword,
                       "follows a section with OFFSET1 or OFFSET2 ({}:{}), expected one of both: "
                       "this line is one of Abaqus, those are of CalculiX",
                       mark.file, mark.line);
  }
  s->offset_at = keyword.at;
  s->arm += place;
}

void read_abaqus_centroid(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  Eigen::Vector2d place;
  if (AbaqusSection* const s = place_in_section(lines, keyword, content, true, place))
    s->arm = place;
}

void read_abaqus_shear_center(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  Eigen::Vector2d place;
  if (AbaqusSection* const s = place_in_section(lines, keyword, content, true, place))
    s->shear_center = place;
}

}  // namespace floatframe

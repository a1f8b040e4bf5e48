// *SHELL SECTION: one material, or layers from the bottom to the top (the side of the normal).
// *SHELL GENERAL SECTION of Abaqus with a material or layers means the same in a linear part.
// *MEMBRANE SECTION: one material; membranes have no rotations, so none that is beside its nodes.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// SPOS, SNEG or a number: of the nodes from the middle, in thicknesses.
void read_shell_offset(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusSection& section) {
  const std::string offset = abaqus_name(keyword.value("OFFSET"));
  if (offset.empty()) return;
  const auto value = parse_real(offset);
  if (offset == "SPOS" || offset == "SNEG") {
    section.offset = offset == "SPOS" ? 0.5 : -0.5;
  } else if (value && std::isfinite(*value)) {
    section.offset = *value;
  } else {
    lines.error(ErrorCode::wrong_value, keyword,
                "has the offset {}, expected SPOS, SNEG or a number", shown(offset));
  }
}

/// Thickness, number of points, material, orientation (a name, or an angle in degrees), name.
void read_ply(AbaqusLines& lines, const std::vector<std::string_view>& fields, std::size_t number,
              AbaqusSection& section) {
  AbaqusSection::Ply ply;
  ply.thickness = positive_real(lines, fields[0], fmt::format("thickness of ply {}", number));
  if (fields.size() > 2) ply.material = abaqus_name(fields[2]);
  if (ply.material.empty())
    lines.source().error(ErrorCode::missing, "ply {} names no material (third entry)", number);
  if (fields.size() > 3 && !fields[3].empty()) {
    if (const auto angle = parse_real(fields[3])) {
      ply.angle = *angle * std::numbers::pi / 180.0;
    } else {
      ply.orientation = abaqus_name(fields[3]);
    }
  }
  section.plies.push_back(ply);
}

}  // namespace

void read_abaqus_shell_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                               AbaqusContent& content) {
  constexpr std::size_t most_plies = 10000;
  AbaqusSection section;
  const bool general = keyword.name == "SHELLGENERALSECTION";
  if (general && !keyword.has("MATERIAL") && !keyword.has("COMPOSITE")) {
    lines.error(ErrorCode::unsupported, keyword,
                "gives forces from strains, which is not read: give its layers (COMPOSITE) or its "
                "MATERIAL");
    return lines.skip_data();
  }
  if (general) {
    content.clues.add(DeckDialect::abaqus, keyword.shown, keyword.at);
    lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS", "OFFSET", "POISSON",
                               "THICKNESSMODULUS", "COMPOSITE", "SYMMETRIC", "LAYUP",
                               "STACKDIRECTION", "NODALTHICKNESS"});
  } else {
    lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS", "OFFSET",
                               "SECTIONINTEGRATION", "TEMPERATURE", "POISSON", "COMPOSITE",
                               "SYMMETRIC", "LAYUP", "STACKDIRECTION", "NODALTHICKNESS"});
  }
  const bool composite = keyword.has("COMPOSITE");
  read_shell_offset(lines, keyword, section);
  section.symmetric = keyword.has("SYMMETRIC");
  if (section.symmetric && !composite)
    lines.error(ErrorCode::incomplete, keyword, "is SYMMETRIC without COMPOSITE");
  if (composite && keyword.has("MATERIAL"))
    lines.error(ErrorCode::exclusive, keyword,
                "has COMPOSITE and a material: those of the plies are in its lines");
  section.nodal_thickness = keyword.has("NODALTHICKNESS");
  if (composite && section.nodal_thickness)
    lines.error(ErrorCode::unsupported, keyword,
                "has COMPOSITE and NODAL THICKNESS, which is not supported together");
  if (!begin_abaqus_section(lines, keyword, content, AbaqusType::Family::shell, section)) return;
  if (section.nodal_thickness) {
    section.thickness = 1.0;  // in place of what *NODAL THICKNESS says
    content.sections.push_back(section);
    return lines.skip_data();
  }
  std::vector<std::string_view> fields;
  if (!lines.next_fields(fields))
    return lines.error(ErrorCode::missing, keyword,
                       composite ? "has no plies" : "has no thickness");
  if (composite) {
    do {
      if (section.plies.size() < most_plies)
        read_ply(lines, fields, section.plies.size() + 1, section);
    } while (lines.next_fields(fields) && section.plies.size() <= most_plies);
    section.material = section.plies.front().material;
    if (section.plies.size() >= most_plies)
      lines.error(ErrorCode::too_large, keyword, "has more than {} plies", most_plies - 1);
    content.sections.push_back(section);
    return lines.skip_data();
  }
  section.thickness = positive_real(lines, fields[0], "thickness of the shell");
  lines.no_more(keyword, fields, fields.size());
  content.sections.push_back(section);
}

void read_abaqus_membrane_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                  AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS", "OFFSET", "POISSON",
                             "NODALTHICKNESS", "STACKDIRECTION"});
  read_shell_offset(lines, keyword, section);
  if (section.offset != 0.0)
    lines.error(ErrorCode::unsupported, keyword,
                "has an offset, but membranes have no rotations that would carry it: put the nodes "
                "into the middle, or use *SHELL SECTION");
  section.nodal_thickness = keyword.has("NODALTHICKNESS");
  if (!begin_abaqus_section(lines, keyword, content, AbaqusType::Family::membrane, section)) return;
  if (std::vector<std::string_view> fields; section.nodal_thickness) {
    section.thickness = 1.0;  // in place of what *NODAL THICKNESS says
  } else if (lines.next_fields(fields)) {
    section.thickness = positive_real(lines, fields[0], "thickness of the membrane");
    lines.no_more(keyword, fields, fields.size());
  } else {
    lines.error(ErrorCode::missing, keyword, "has no thickness");
  }
  content.sections.push_back(section);
  lines.skip_data();
}

}  // namespace floatframe

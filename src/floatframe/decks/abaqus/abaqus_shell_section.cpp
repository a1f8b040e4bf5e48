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
void read_shell_offset(AbaqusCard& card, AbaqusSection& section) {
  const std::string offset = card.word("OFFSET");
  if (offset.empty()) return;
  const auto value = parse_real(offset);
  if (offset == "SPOS" || offset == "SNEG") {
    section.offset = offset == "SPOS" ? 0.5 : -0.5;
  } else if (value && std::isfinite(*value)) {
    section.offset = *value;
  } else {
    card.error(ErrorCode::wrong_value, "has the offset {}, expected SPOS, SNEG or a number",
               shown(offset));
  }
}

/// Thickness, number of points, material, orientation (a name, or an angle in degrees), name.
void read_ply(AbaqusCard& card, AbaqusSection& section) {
  const std::size_t number = section.plies.size() + 1;
  AbaqusSection::Ply ply;
  ply.thickness = card.positive(0, fmt::format("thickness of ply {}", number));
  ply.material = abaqus_name(card.field(2));
  if (ply.material.empty())
    card.error_in_line(ErrorCode::missing, "ply {} names no material (third entry)", number);
  if (const auto angle = parse_real(card.field(3))) {
    ply.angle = *angle * std::numbers::pi / 180.0;
  } else {
    ply.orientation = abaqus_name(card.field(3));
  }
  section.plies.push_back(ply);
}

void read_plies(AbaqusCard& card, AbaqusSection& section) {
  constexpr std::size_t most_plies = 10000;
  do {
    if (section.plies.size() < most_plies) read_ply(card, section);
  } while (card.next() && section.plies.size() <= most_plies);
  section.material = section.plies.front().material;
  if (section.plies.size() >= most_plies)
    card.error(ErrorCode::too_large, "has more than {} plies", most_plies - 1);
}

/// The section with its thickness, which may be that of *NODAL THICKNESS, or its plies.
void read_sheet(AbaqusCard& card, AbaqusSection& section) {
  const bool shell = section.family == AbaqusType::Family::shell;
  const bool composite = shell && card.has("COMPOSITE");
  if (section.nodal_thickness) {
    section.thickness = 1.0;  // in place of what *NODAL THICKNESS says
  } else if (!card.next()) {
    card.error(ErrorCode::missing, composite ? "has no plies" : "has no thickness");
    if (shell) return;
  } else if (composite) {
    read_plies(card, section);
  } else {
    section.thickness =
        card.positive(0, shell ? "thickness of the shell" : "thickness of the membrane");
    card.no_more(card.fields.size());
  }
  card.content.sections.push_back(section);
}

}  // namespace

void read_abaqus_shell_section(AbaqusCard& card) {
  AbaqusSection section;
  const bool general = card.name == "SHELLGENERALSECTION", composite = card.has("COMPOSITE");
  if (general && !card.has("MATERIAL") && !composite)
    return card.error(ErrorCode::unsupported,
                      "gives forces from strains, which is not read: give its layers (COMPOSITE) "
                      "or its MATERIAL");
  if (general) card.content.clues.add(DeckDialect::abaqus, card.shown, card.at);
  card.allow_only(std::string("ELSET MATERIAL ORIENTATION CONTROLS OFFSET POISSON COMPOSITE "
                              "SYMMETRIC LAYUP STACKDIRECTION NODALTHICKNESS ") +
                  (general ? "THICKNESSMODULUS" : "SECTIONINTEGRATION TEMPERATURE"));
  read_shell_offset(card, section);
  section.symmetric = card.has("SYMMETRIC");
  if (section.symmetric && !composite)
    card.error(ErrorCode::incomplete, "is SYMMETRIC without COMPOSITE");
  if (composite && card.has("MATERIAL"))
    card.error(ErrorCode::exclusive,
               "has COMPOSITE and a material: those of the plies are in its lines");
  section.nodal_thickness = card.has("NODALTHICKNESS");
  if (composite && section.nodal_thickness)
    card.error(ErrorCode::unsupported,
               "has COMPOSITE and NODAL THICKNESS, which is not supported together");
  if (begin_abaqus_section(card, AbaqusType::Family::shell, section)) read_sheet(card, section);
}

void read_abaqus_membrane_section(AbaqusCard& card) {
  AbaqusSection section;
  read_shell_offset(card, section);
  if (section.offset != 0.0)
    card.error(ErrorCode::unsupported,
               "has an offset, but membranes have no rotations that would carry it: put the nodes "
               "into the middle, or use *SHELL SECTION");
  section.nodal_thickness = card.has("NODALTHICKNESS");
  if (begin_abaqus_section(card, AbaqusType::Family::membrane, section)) read_sheet(card, section);
}

}  // namespace floatframe

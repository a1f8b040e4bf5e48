// Sections and masses of Abaqus decks.
// *SHELL SECTION: one material, or layers from the bottom to the top (the side of the normal).
// *SHELL GENERAL SECTION of Abaqus with a material or layers is equivalent in a linear part.
// *MEMBRANE SECTION: one material; membranes have no rotations, so no offset from their nodes.
// *NODAL THICKNESS: for the shells and membranes whose section has the parameter NODAL THICKNESS,
// as in Abaqus and CalculiX; it replaces the thickness of their sections. Each has the mean of
// its corners.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// A required line; more of them mean a dependence on temperature.
bool read_one_line(AbaqusCard& card) {
  if (!card.needs_line()) return false;
  std::string_view more;
  if (card.lines.next_data(more))
    card.error_in_line(
        ErrorCode::unsupported,
        "{} depends on temperature or fields (a second line), which is not supported", card.shown);
  return true;
}

/// SPOS, SNEG or a number: of the nodes from the middle, in thicknesses.
void read_shell_offset(AbaqusCard& card, AbaqusSection& section) {
  const std::string offset = card.word("OFFSET");
  if (offset.empty()) return;
  const auto value = parse_real(offset);
  if (offset == "SPOS" || offset == "SNEG")
    section.offset = offset == "SPOS" ? 0.5 : -0.5;
  else if (value && std::isfinite(*value))
    section.offset = *value;
  else
    card.error(ErrorCode::wrong_value, "has the offset {}, expected SPOS, SNEG or a number",
               shown(offset));
}

/// Thickness, number of points, material, orientation (a name, or an angle in degrees), name.
void read_ply(AbaqusCard& card, AbaqusSection& section) {
  const std::size_t number = section.plies.size() + 1;
  AbaqusSection::Ply ply;
  ply.thickness = card.positive(0, fmt::format("thickness of ply {}", number));
  ply.material = abaqus_name(card.field(2));
  if (ply.material.empty())
    card.error_in_line(ErrorCode::missing, "ply {} names no material (third entry)", number);
  if (const auto angle = parse_real(card.field(3)))
    ply.angle = *angle * std::numbers::pi / 180.0;
  else
    ply.orientation = abaqus_name(card.field(3));
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
  const bool shell = section.family == Family::shell;
  const bool composite = shell && card.has("COMPOSITE");
  if (section.nodal_thickness) {
    section.thickness = 1.0;  // replaced by *NODAL THICKNESS
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

bool begin_abaqus_section(AbaqusCard& card, Family family, AbaqusSection& section) {
  const std::size_t before = card.source.errors();
  const bool of_material = family == Family::solid || is_abaqus_sheet(family);
  section.family = family;
  section.shown = card.shown;
  card.required("ELSET");
  section.where = {0, 0, 1, card.content.intern(card.word("ELSET")), card.content.scope, card.at};
  if ((of_material || family == Family::beam) && !card.has("COMPOSITE") && section.material.empty())
    section.material = abaqus_name(card.required("MATERIAL"));
  section.orientation = card.word("ORIENTATION");
  if (card.has("ORIENTATION") && !of_material)
    card.error(ErrorCode::unsupported, "has the parameter 'ORIENTATION', which is not supported");
  return card.source.errors() == before;
}

void read_abaqus_solid_section(AbaqusCard& card) {
  AbaqusSection section;
  if (!begin_abaqus_section(card, Family::solid, section)) return;
  // For rods the area; for other elements the line has no meaning.
  if (card.next()) section.thickness = parse_real(card.field(0)).value_or(0.0);
  card.content.sections.push_back(section);
}

/// Surface elements carry mass only if the section gives them some.
void read_abaqus_surface_section(AbaqusCard& card) {
  const std::string_view density = card.value("DENSITY");
  if (!card.has("DENSITY") || parse_real(density).value_or(1.0) == 0.0)
    return card.note("*SURFACE SECTION of {} is ignored: it has no mass",
                     shown(card.word("ELSET")));
  card.error(ErrorCode::unsupported,
             "has the density {}: the mass of surface elements is not read, use *MASS or shells",
             shown(density));
}

void read_abaqus_mass(AbaqusCard& card) {
  AbaqusSection section;
  card.is_one_of("TYPE", "ISOTROPIC", "has the type {}, expected ISOTROPIC");
  if (!begin_abaqus_section(card, Family::mass, section) || !read_one_line(card)) return;
  section.mass = card.real(0, "mass");
  if (section.mass < 0.0)
    card.error(ErrorCode::out_of_range, "is {:g}, expected no negative mass", section.mass);
  card.content.masses.push_back(section);
}

void read_abaqus_rotary_inertia(AbaqusCard& card) {
  AbaqusSection section;
  if (!begin_abaqus_section(card, Family::rotary, section) || !read_one_line(card)) return;
  section.J.diagonal() = card.vector(0, "moment of inertia");
  for (std::size_t k = 3; k < 6; ++k) {
    if (card.real_or(k, 0.0, "product of inertia") == 0.0) continue;
    card.error(
        ErrorCode::unsupported,
        "has products of inertia, whose sign is not the same in all programs: not supported");
    break;
  }
  card.content.masses.push_back(section);
}

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
  if (begin_abaqus_section(card, Family::shell, section)) read_sheet(card, section);
}

void read_abaqus_membrane_section(AbaqusCard& card) {
  AbaqusSection section;
  read_shell_offset(card, section);
  if (section.offset != 0.0)
    card.error(ErrorCode::unsupported,
               "has an offset, but membranes have no rotations that would carry it: put the nodes "
               "into the middle, or use *SHELL SECTION");
  section.nodal_thickness = card.has("NODALTHICKNESS");
  if (begin_abaqus_section(card, Family::membrane, section)) read_sheet(card, section);
}

void read_abaqus_nodal_thickness(AbaqusCard& card) {
  if (!card.needs_line()) return;
  do {
    AbaqusNodalValue t{{card.reference(0)}};
    if (card.fields.size() < 2) {
      card.error_in_line(ErrorCode::missing, "*NODAL THICKNESS of {} has no thickness",
                         card.content.text(t.where, "node"));
      continue;
    }
    t.value = card.positive(1, "thickness at nodes");
    card.content.thicknesses.push_back(t);
  } while (card.next());
}

AbaqusNodalThickness::AbaqusNodalThickness(AbaqusBuild& build) : b_(build) {
  const AbaqusContent& c = build.content;
  if (c.thicknesses.empty()) return;
  at_node_.assign(c.nodes.size(), 0.0);
  // The later of two definitions counts.
  for (const AbaqusNodalValue& t : c.thicknesses)
    for (const int node : build.nodes.resolve(t.where)) at_node_[node] = t.value;
}

void AbaqusNodalThickness::apply(const AbaqusSection& section, FeElement& e) {
  if (!section.nodal_thickness) return;
  used_ = true;
  const int nodes = element_kernel(e.type).nodes;
  const int corners = nodes % 3 == 0 ? 3 : 4;
  double sum = 0.0, least = HUGE_VAL, most = 0.0;
  for (int k = 0; k < nodes; ++k) {
    const double t = at_node_.empty() ? 0.0 : at_node_[e.nodes[k]];
    if (!(t > 0.0) && k < corners) {
      if (missing_++ == 0)
        b_.error(section, ErrorCode::missing,
                 " has NODAL THICKNESS, but node {} of element {} has none (*NODAL THICKNESS)",
                 b_.model.node_ids[e.nodes[k]], e.id);
      return;
    }
    if (!(t > 0.0)) continue;
    if (k < corners) sum += t;
    least = std::min(least, t);
    most = std::max(most, t);
  }
  double mean = sum / corners;
  if (most - least > 1e-6 * mean) {
    if (uneven_++ == 0) first_uneven_ = e.source;
    unevenness_ = std::max(unevenness_, (most - least) / mean);
  } else if (std::isfinite(mean)) {
    mean = most;
  }
  std::vector<ShellSection>& shells = b_.model.shells;
  const bool first = given_.insert(e.section).second;
  const auto [it, fresh] =
      sections_.try_emplace({e.section, mean}, static_cast<int>(shells.size()));
  if (fresh && first) it->second = e.section;  // it has no separate thickness
  if (fresh && !first) shells.push_back(shells[e.section]);
  if (fresh) {
    ShellSection& shell = shells[it->second];
    shell.thickness = mean;
    shell.shear = 5.0 / 6.0 * mean;
    shell.offset = -section.offset * mean;
    check_abaqus_sheet(b_, section, shell, e.material);
  }
  e.section = it->second;
}

void AbaqusNodalThickness::notes() {
  const AbaqusContent& c = b_.content;
  if (!used_ && !c.thicknesses.empty())
    b_.note(c.thicknesses.front().where.at,
            "*NODAL THICKNESS has no effect, as in Abaqus and CalculiX: no section has the "
            "parameter NODAL THICKNESS");
  if (uneven_ > 0)
    b_.note(first_uneven_,
            "{} shells have nodes of different thickness, by {:.1f} % "
            "at most: each has the mean of its corners",
            uneven_, 100.0 * unevenness_);
}

}  // namespace floatframe

// Materials, sections and masses of Abaqus decks.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// *ELASTIC and *DENSITY belong to the last *MATERIAL; what they say is read in any case.
void needs_material(AbaqusCard& card) {
  if (!card.content.materials.contains(card.content.material))
    card.error(ErrorCode::missing, "belongs to no *MATERIAL");
  card.start();
}

/// A line that must be there; more of them mean a dependence on temperature.
bool read_one_line(AbaqusCard& card) {
  if (!card.needs_line()) return false;
  std::string_view more;
  if (card.lines.next_data(more))
    card.error_in_line(
        ErrorCode::unsupported,
        "{} depends on temperature or fields (a second line), which is not supported", card.shown);
  return true;
}

/// Lines of values and a temperature; the first value must be there.
void read_table(AbaqusCard& card, std::initializer_list<const char*> names,
                AbaqusPendingConstants::Use use) {
  std::vector<TemperatureRow> rows;
  const bool of_fields = has_abaqus_dependencies(card);
  while (!of_fields && card.next()) {
    TemperatureRow row;
    for (const char* const name : names) {
      const std::size_t k = row.values.size();
      row.values.push_back(k == 0 ? card.real(k, name) : card.real_or(k, 0.0, name));
    }
    row.temperature = card.real_or(names.size(), 0.0, "temperature");
    rows.push_back(std::move(row));
  }
  take_abaqus_constants(card, std::move(rows), use);
}

void use_isotropic(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& values) {
  material.young = values[0];
  material.poisson = values[1];
  if (!(values[0] > 0.0))
    card.error(ErrorCode::out_of_range, "has Young's modulus {:g}, expected more than 0",
               values[0]);
  if (!(values[1] > -1.0 && values[1] < 0.5))
    card.error(ErrorCode::out_of_range,
               "has Poisson's ratio {:g}, expected more than -1 and less than 0.5", values[1]);
}

void use_density(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& values) {
  material.density = values[0];
  if (!(values[0] >= 0.0))
    card.error(ErrorCode::out_of_range, "is {:g}, expected no negative density", values[0]);
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

void read_abaqus_material(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  const std::string name = abaqus_name(card.required("NAME"));
  content.material = name;
  const auto [it, added] = content.materials.emplace(name, AbaqusMaterial{});
  if (added) {
    it->second.at = card.at;
    content.material_order.push_back(name);
    return;
  }
  card.error(ErrorCode::duplicate, "names the material {} a second time ({})", shown(name),
             card.place(it->second.at));
  // What follows belongs to a material that nothing names.
  content.material = fmt::format("{} (line {})", name, card.at.line);
  content.materials.emplace(content.material, AbaqusMaterial{});
}

void read_abaqus_elastic(AbaqusCard& card) {
  needs_material(card);
  const std::string type = card.word("TYPE");
  if (read_abaqus_anisotropic(card)) return;
  if (type.empty() || type == "ISO" || type == "ISOTROPIC")
    return read_table(card, {"Young's modulus", "Poisson's ratio"}, use_isotropic);
  card.error(ErrorCode::wrong_value,
             "has the type {}, expected ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC, "
             "ANISOTROPIC or LAMINA",
             shown(card.value("TYPE")));
}

void read_abaqus_density(AbaqusCard& card) {
  needs_material(card);
  read_table(card, {"density"}, use_density);
}

void read_abaqus_solid_section(AbaqusCard& card) {
  AbaqusSection section;
  if (!begin_abaqus_section(card, Family::solid, section)) return;
  // Of rods the area; of other elements the line means nothing.
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

}  // namespace floatframe

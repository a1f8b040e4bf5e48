// Materials, sections and masses of Abaqus decks.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// The material that *ELASTIC and *DENSITY belong to; null and an error if there is none.
AbaqusMaterial* present_material(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content) {
  const auto it = content.materials.find(content.material);
  if (it != content.materials.end()) return &it->second;
  lines.error(ErrorCode::missing, keyword, "belongs to no *MATERIAL");
  return nullptr;
}

/// One line of values; more of them mean a dependence on temperature.
bool one_line(AbaqusLines& lines, const AbaqusKeyword& keyword,
              std::vector<std::string_view>& fields) {
  if (!lines.next_fields(fields)) {
    lines.error(ErrorCode::missing, keyword, "has no data line");
    return false;
  }
  std::string_view more;
  if (lines.next_data(more)) {
    lines.source().error(
        ErrorCode::unsupported,
        "{} depends on temperature or fields (a second line), which is not supported",
        keyword.shown);
    lines.skip_data();
  }
  return true;
}

/// Lines of `count` values and a temperature; empty and an error if there are none.
std::vector<TemperatureRow> table_of(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                     std::size_t count, const char* const* names) {
  std::vector<TemperatureRow> rows;
  std::vector<std::string_view> fields;
  if (!same_word(keyword.value("DEPENDENCIES"), "0") && keyword.has("DEPENDENCIES")) {
    lines.error(ErrorCode::unsupported, keyword,
                "depends on field variables (DEPENDENCIES), which is not supported");
    lines.skip_data();
    return rows;
  }
  while (lines.next_fields(fields)) {
    TemperatureRow row;
    for (std::size_t k = 0; k < count; ++k)
      row.values.push_back(k == 0 ? lines.real(fields[0], names[0])
                                  : lines.real_or(fields, k, 0.0, names[k]));
    row.temperature = lines.real_or(fields, count, 0.0, "temperature");
    rows.push_back(std::move(row));
  }
  if (rows.empty()) lines.error(ErrorCode::missing, keyword, "has no data line");
  return rows;
}

void use_isotropic(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusMaterial& material,
                   const std::vector<double>& values) {
  material.young = values[0];
  material.poisson = values[1];
  if (!(values[0] > 0.0))
    lines.error(ErrorCode::out_of_range, keyword, "has Young's modulus {:g}, expected more than 0",
                values[0]);
  if (!(values[1] > -1.0 && values[1] < 0.5))
    lines.error(ErrorCode::out_of_range, keyword,
                "has Poisson's ratio {:g}, expected more than -1 and less than 0.5", values[1]);
}

void use_density(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusMaterial& material,
                 const std::vector<double>& values) {
  material.density = values[0];
  if (!(values[0] >= 0.0))
    lines.error(ErrorCode::out_of_range, keyword, "is {:g}, expected no negative density",
                values[0]);
}

}  // namespace

bool begin_abaqus_section(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                          Family family, AbaqusSection& section) {
  const std::size_t before = lines.source().errors();
  section.family = family;
  section.shown = keyword.shown;
  section.at = keyword.at;
  const std::string_view elements = lines.required(keyword, "ELSET");
  section.elements.name = content.intern(abaqus_name(elements));
  section.elements.scope = content.scope;
  section.elements.at = keyword.at;
  if (family == Family::solid || is_abaqus_sheet(family) || family == Family::beam) {
    if (!keyword.has("COMPOSITE") && section.material.empty())
      section.material = abaqus_name(lines.required(keyword, "MATERIAL"));
  }
  if (keyword.has("ORIENTATION")) {
    section.orientation = abaqus_name(keyword.value("ORIENTATION"));
    if (family != Family::solid && !is_abaqus_sheet(family))
      lines.error(ErrorCode::unsupported, keyword,
                  "has the parameter 'ORIENTATION', which is not supported");
  }
  if (lines.source().errors() == before) return true;
  lines.skip_data();
  return false;
}

double positive_real(AbaqusLines& lines, std::string_view field, std::string_view what) {
  const std::size_t before = lines.source().errors();
  const double value = lines.real(field, what);
  if (!(value > 0.0) && lines.source().errors() == before)
    lines.source().error(ErrorCode::out_of_range, "{} is {:g}, expected more than 0", what, value);
  return value;
}

void read_abaqus_material(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  content.material = name;
  const auto [it, added] = content.materials.emplace(name, AbaqusMaterial{});
  if (!added) {
    const SourceMark first = lines.source().mark(it->second.at);
    lines.error(ErrorCode::duplicate, keyword, "names the material {} a second time ({}:{})",
                shown(name), first.file, first.line);
    // What follows belongs to a material that nothing names.
    content.material = fmt::format("{} (line {})", name, keyword.at.line);
    content.materials.emplace(content.material, AbaqusMaterial{});
  } else {
    it->second.at = keyword.at;
    content.material_order.push_back(name);
  }
  lines.skip_data();
}

void read_abaqus_elastic(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"TYPE", "MODULI", "DEPENDENCIES"});
  AbaqusMaterial* const material = present_material(lines, keyword, content);
  const std::string type = abaqus_name(keyword.value("TYPE"));
  if (is_abaqus_anisotropic(type))
    return read_abaqus_anisotropic(lines, keyword, content, material);
  if (!type.empty() && type != "ISO" && type != "ISOTROPIC") {
    lines.error(ErrorCode::wrong_value, keyword,
                "has the type {}, expected ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC, "
                "ANISOTROPIC or LAMINA",
                shown(keyword.value("TYPE")));
    return lines.skip_data();
  }
  const std::size_t before = lines.source().errors();
  static constexpr const char* names[] = {"Young's modulus", "Poisson's ratio"};
  const std::vector<TemperatureRow> rows = table_of(lines, keyword, 2, names);
  if (lines.source().errors() != before || material == nullptr) return;
  if (material->young) {
    lines.error(ErrorCode::duplicate, keyword, "is given a second time for its material");
    return;
  }
  take_abaqus_constants(lines, keyword, content, *material, rows, use_isotropic);
}

void read_abaqus_density(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"DEPENDENCIES"});
  AbaqusMaterial* const material = present_material(lines, keyword, content);
  const std::size_t before = lines.source().errors();
  static constexpr const char* names[] = {"density"};
  const std::vector<TemperatureRow> rows = table_of(lines, keyword, 1, names);
  if (lines.source().errors() != before || material == nullptr) return;
  if (material->density) {
    lines.error(ErrorCode::duplicate, keyword, "is given a second time for its material");
    return;
  }
  take_abaqus_constants(lines, keyword, content, *material, rows, use_density);
}

void read_abaqus_solid_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                               AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"});
  if (!begin_abaqus_section(lines, keyword, content, Family::solid, section)) return;
  // Of rods the area; of other elements the line means nothing.
  std::vector<std::string_view> fields;
  if (lines.next_fields(fields)) section.thickness = parse_real(fields[0]).value_or(0.0);
  content.sections.push_back(section);
  lines.skip_data();
}

/// Surface elements carry mass only if the section gives them some.
void read_abaqus_surface_section(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content) {
  const std::string_view density = keyword.value("DENSITY");
  if (keyword.has("DENSITY") && parse_real(density).value_or(1.0) != 0.0) {
    lines.error(ErrorCode::unsupported, keyword,
                "has the density {}: the mass of surface elements is not read, use *MASS or shells",
                shown(density));
  } else {
    const SourceMark mark = lines.source().mark(keyword.at);
    const std::string elements = abaqus_name(keyword.value("ELSET"));
    content.notes.push_back(fmt::format("{}:{}: *SURFACE SECTION of {} is ignored: it has no mass",
                                        mark.file, mark.line, shown(elements)));
  }
  lines.skip_data();
}

void read_abaqus_mass(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "TYPE", "ALPHA", "COMPOSITE"});
  const std::string_view type = keyword.value("TYPE");
  if (!type.empty() && !same_word(type, "ISOTROPIC")) {
    lines.error(ErrorCode::wrong_value, keyword, "has the type {}, expected ISOTROPIC",
                shown(type));
  }
  if (!begin_abaqus_section(lines, keyword, content, Family::mass, section)) return;
  std::vector<std::string_view> fields;
  if (!one_line(lines, keyword, fields)) return;
  section.mass = lines.real(fields[0], "mass");
  if (section.mass < 0.0)
    lines.error(ErrorCode::out_of_range, keyword, "is {:g}, expected no negative mass",
                section.mass);
  content.masses.push_back(section);
}

void read_abaqus_rotary_inertia(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                AbaqusContent& content) {
  AbaqusSection section;
  lines.allow_only(keyword, {"ELSET", "ORIENTATION", "ALPHA", "COMPOSITE"});
  if (!begin_abaqus_section(lines, keyword, content, Family::rotary, section)) return;
  std::vector<std::string_view> fields;
  if (!one_line(lines, keyword, fields)) return;
  for (std::size_t k = 0; k < 3; ++k) {
    section.J(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) =
        lines.real_or(fields, k, 0.0, "moment of inertia");
  }
  for (std::size_t k = 3; k < 6; ++k) {
    if (lines.real_or(fields, k, 0.0, "product of inertia") != 0.0) {
      lines.error(
          ErrorCode::unsupported, keyword,
          "has products of inertia, whose sign is not the same in all programs: not supported");
      break;
    }
  }
  content.masses.push_back(section);
}

}  // namespace floatframe

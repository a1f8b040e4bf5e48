// Sections and materials of an Abaqus deck: which elements have which, and what they are in the
// model. Round sections depend on whose deck it is.
#include <cmath>
#include <unordered_map>
#include <utility>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// Index of the section's material in the model, which gets it if it is not there yet.
int material_of(AbaqusBuild& build, const AbaqusSection& section, const std::string& name,
                std::unordered_map<std::string, int>& index) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const auto [place, fresh] = index.emplace(name, static_cast<int>(model.materials.size()));
  if (!fresh) return place->second;
  const auto it = c.materials.find(name);
  Material material;
  if (it == c.materials.end()) {
    build.error(section, ErrorCode::not_found, " names the material {}, which does not exist{}",
                shown(name),
                c.material_order.size() > most_known ? "" : did_you_mean(name, c.material_order));
  } else {
    const AbaqusMaterial& m = it->second;
    if (!m.young)
      build.source.error(ErrorCode::missing, m.at, "material {} has no *ELASTIC", shown(name));
    if (!m.density) model.without_density[static_cast<int>(model.materials.size())] = {m.at};
    material = m.elasticity ? anisotropic_material(*m.elasticity, m.plane, m.density.value_or(0.0))
                            : Material{m.young.value_or(0.0), m.poisson.value_or(0.0),
                                       m.density.value_or(0.0)};
    if (const std::string huge = huge_constant(material); !huge.empty())
      build.source.error(ErrorCode::not_finite, m.at, "material {}: {}", shown(name), huge);
  }
  model.materials.push_back(material);
  model.material_names.push_back(name);
  return place->second;
}

void check_material(AbaqusBuild& build, const AbaqusSection& section, const Material& material) {
  if (!material.elasticity) return;
  if (section.family == Family::beam)
    build.error(section, ErrorCode::unsupported,
                ": material {} is not isotropic, which beams must be", shown(section.material));
  if (section.family == Family::solid && material.plane)
    build.error(section, ErrorCode::unsupported,
                ": material {} is a lamina, which only shells can have", shown(section.material));
}

/// The section of CIRC with one number: a radius in Abaqus, a diameter in CalculiX.
BeamSection round_section(AbaqusBuild& build, const AbaqusSection& section) {
  const DialectClues& clues = build.clues;
  const DeckDialect dialect = build.dialect();
  const bool abaqus = dialect == DeckDialect::abaqus;
  if (dialect == DeckDialect::by_content) {
    build.error(
        section, ErrorCode::out_of_range,
        ", SECTION=CIRC: {:g} is a radius in Abaqus and a diameter in CalculiX, and {}: give "
        "--dialect abaqus or --dialect calculix (in a model file 'dialect:')",
        section.round,
        clues.abaqus ? fmt::format("the deck has things of both ({}, {})", clues.abaqus->what,
                                   clues.calculix->what)
                     : "nothing in the deck shows whose it is");
  } else if (build.content.options.dialect == DeckDialect::by_content) {
    const DialectClues::Clue& clue = abaqus ? *clues.abaqus : *clues.calculix;
    build.note(section.where.at, "{}, SECTION=CIRC: {:g} is the {}, as in {} ({} in {})",
               section.shown, section.round, abaqus ? "radius" : "diameter",
               abaqus ? "Abaqus" : "CalculiX", clue.what, build.place(clue.at));
  }
  return BeamSection::solid_round(section.round * (abaqus ? 2.0 : 1.0));
}

/// Numbers of a section that only CalculiX takes, in a deck of Abaqus.
void check_form(AbaqusBuild& build, const AbaqusSection& section) {
  const std::optional<DialectClues::Clue>& clue = build.clues.abaqus;
  if (section.calculix_form && clue && build.content.options.dialect != DeckDialect::calculix)
    build.error(section, ErrorCode::unsupported,
                ", SECTION={} has dimensions as in CalculiX, but the deck has {} ({}), which only "
                "Abaqus has; if it is one of CalculiX give --dialect calculix",
                section.shape, clue->what, build.place(clue->at));
}

/// Dimensions may be finite, and what follows from them not.
void check_beam_numbers(AbaqusBuild& build, const AbaqusSection& section, const BeamSection& s,
                        const Material& material) {
  const double mass = s.A * material.density;
  if (std::isfinite(mass + s.A) && std::isfinite(s.Iy + s.Iz) && std::isfinite(s.J)) return;
  build.error(section, ErrorCode::not_finite,
              ": its area is {:g}, its moments are {:g} and {:g}, its torsion constant is {:g} and "
              "its mass over length {:g}, expected finite numbers",
              s.A, s.Iy, s.Iz, s.J, mass);
}

/// Axes that no *ORIENTATION gives are global ones; whether an instance turns them is not said.
void check_turned_instance(AbaqusBuild& build, const AbaqusSection& section,
                           const AbaqusProperties& p) {
  const AbaqusContent& c = build.content;
  const auto instance = c.instances.find(section.where.scope);
  if (instance == c.instances.end() || instance->second.place.R.isIdentity(1e-12)) return;
  const Material& m = build.model.materials[p.like.material];
  const bool directional =
      is_abaqus_sheet(section.family) ? p.directional : m.elasticity.has_value();
  if (directional && section.orientation.empty())
    build.error(section, ErrorCode::contradiction,
                " of the turned instance {} has a material with directions and no orientation",
                shown(instance->second.name));
}

}  // namespace

bool is_abaqus_point(AbaqusType::Family family) noexcept {
  return family == Family::mass || family == Family::rotary || family == Family::coupling ||
         family == Family::spring || family == Family::damper || family == Family::gap;
}

std::string abaqus_label(const AbaqusElement& e) {
  return fmt::format("element {} ({})", e.id, e.type->name);
}

std::vector<int> sections_of_elements(AbaqusBuild& build,
                                      const std::vector<AbaqusSection>& sections) {
  const AbaqusContent& c = build.content;
  std::vector<int> section_of(c.elements.size(), -1);
  const bool in_calculix = build.dialect() == DeckDialect::calculix;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const AbaqusSection& section = sections[s];
    bool reported = false, noted = false;
    for (const int e : build.elements.resolve(section.where)) {
      const AbaqusElement& element = c.elements[e];
      // Sets of parts hold masses beside the elements of a section.
      const Family family = element.type->family;
      const bool fits =
          family == section.family || (family == Family::rod && section.family == Family::solid);
      if (!fits && is_abaqus_point(family)) continue;
      const int before = std::exchange(section_of[e], static_cast<int>(s));
      if (reported || (fits && before < 0)) continue;
      const std::string names = fmt::format("{} names {}", section.shown, abaqus_label(element));
      if (fits && in_calculix) {
        if (before != static_cast<int>(s) && !std::exchange(noted, true))
          build.note(section.where.at,
                     "{} is the second one of {}: the last one counts, as in CalculiX",
                     section.shown, abaqus_label(element));
        continue;
      }
      reported = true;
      build.source.error(
          ErrorCode::wrong_value, section.where.at,
          fits ? fmt::format("{}, which has one already ({})", names,
                             build.place(sections[before].where.at))
          : family == Family::skin
              ? names + "; elements of this type are read as skins only, without a section"
              : names + ", for which it is not supported");
    }
  }
  return section_of;
}

void look_at_abaqus_beams(AbaqusBuild& build, const std::vector<int>& section_of) {
  DialectClues& clues = build.clues;
  const AbaqusContent& c = build.content;
  for (std::size_t e = 0; e < c.elements.size() && !clues.abaqus; ++e) {
    if (section_of[e] < 0) continue;
    const AbaqusSection& section = c.sections[section_of[e]];
    const std::string_view type = c.elements[e].type->name;
    if (section.family != Family::beam || section.shape == "RECT" || type == "B32R" ||
        (section.shape == "CIRC" && type == "B32"))
      continue;
    clues.add(DeckDialect::abaqus, fmt::format("SECTION={} for {}", section.shape, type),
              section.where.at);
  }
}

std::vector<AbaqusProperties> abaqus_properties(AbaqusBuild& build) {
  std::vector<AbaqusProperties> list;
  std::unordered_map<std::string, int> material_index;
  FeModel& model = build.model;
  for (const AbaqusSection& section : build.content.sections) {
    AbaqusProperties p;
    const auto material = [&](const std::string& name) {
      return material_of(build, section, name, material_index);
    };
    p.like.material = material(section.material);
    check_material(build, section, model.materials[p.like.material]);
    if (!section.orientation.empty())
      p.like.orientation = abaqus_orientation(build, section.orientation, section);
    if (section.family == Family::beam) {
      p.like.section = static_cast<int>(model.sections.size());
      check_form(build, section);
      check_abaqus_beam_offset(build, section);
      model.sections.push_back(section.round > 0.0 ? round_section(build, section) : section.beam);
      BeamSection& beam = model.sections.back();
      check_beam_numbers(build, section, beam, model.materials[p.like.material]);
      beam.shear_y = beam.shear_z = abaqus_shear_factor(section.shape) * beam.A;
      p.like.reference = build.content.placement(section.where.scope).R * section.n1;
    } else if (section.family == Family::solid && section.thickness > 0.0) {  // of rods
      p.like.section = static_cast<int>(model.sections.size());
      model.sections.push_back({section.thickness, 0.0, 0.0, 0.0});
      check_beam_numbers(build, section, model.sections.back(), model.materials[p.like.material]);
    } else if (is_abaqus_sheet(section.family)) {
      p.like.section = static_cast<int>(model.shells.size());
      const ShellSection shell = abaqus_shell_section(build, section, material);
      if (!section.nodal_thickness) check_abaqus_sheet(build, section, shell, p.like.material);
      p.directional = !is_plain(shell, model.materials[p.like.material]);
      model.shells.push_back(shell);
    }
    check_turned_instance(build, section, p);
    list.push_back(p);
  }
  return list;
}

}  // namespace floatframe

// Sections and materials of an Abaqus deck: their assignment to elements, and their form in the
// model. Round sections depend on the program of the deck.
//
// Beams whose centroid is not at their nodes. The arm is given in directions 1 and 2 of the
// section: n_1 is the direction of the section across the tangent t of the axis at the node, n_2 =
// t x n_1. CalculiX has OFFSET1 and OFFSET2 in thicknesses along these: the centroid is at
//   -OFFSET1 t_1 n_1 - OFFSET2 t_2 n_2
// from the node, as its expanded elements show.
#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// Index of the section's material in the model, where it is added if necessary.
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

/// Numbers of a section that only CalculiX reads, in a deck of Abaqus.
void check_form(AbaqusBuild& build, const AbaqusSection& section) {
  const std::optional<DialectClues::Clue>& clue = build.clues.abaqus;
  if (section.calculix_form && clue && build.content.options.dialect != DeckDialect::calculix)
    build.error(section, ErrorCode::unsupported,
                ", SECTION={} has dimensions as in CalculiX, but the deck has {} ({}), which only "
                "Abaqus has; if it is one of CalculiX give --dialect calculix",
                section.shape, clue->what, build.place(clue->at));
}

/// Dimensions may be finite, but not the values computed from them.
void check_beam_numbers(AbaqusBuild& build, const AbaqusSection& section, const BeamSection& s,
                        const Material& material) {
  const double mass = s.A * material.density;
  if (std::isfinite(mass + s.A) && std::isfinite(s.Iy + s.Iz) && std::isfinite(s.J)) return;
  build.error(section, ErrorCode::not_finite,
              ": its area is {:g}, its moments are {:g} and {:g}, its torsion constant is {:g} and "
              "its mass over length {:g}, expected finite numbers",
              s.A, s.Iy, s.Iz, s.J, mass);
}

/// Axes without an *ORIENTATION are global ones; whether an instance rotates them is undefined.
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

/// Direction 1 towards the further node of the element.
void direct_abaqus_beam(AbaqusBuild& build, const AbaqusElement& deck, FeElement& e) {
  const int further = build.node_of(deck, deck.type->nodes);
  if (further < 0) return;
  const FeModel& m = build.model;
  e.reference = m.positions[further] - m.positions[e.nodes[0]];
  const Vec3 along = m.positions[e.nodes[deck.type->nodes - 1]] - m.positions[e.nodes[0]];
  if (!(along.cross(e.reference).norm() > 1e-9 * along.norm() * e.reference.norm()))
    build.error(deck, ErrorCode::geometry,
                ": node {}, which gives its direction 1, lies on its axis",
                build.content.element_nodes[deck.first + deck.type->nodes]);
}

/// *BEAM SECTION OFFSET in a deck of CalculiX, which ignores such a line.
void check_abaqus_offset_line(AbaqusBuild& build, const AbaqusSection& section) {
  const DeckDialect given = build.content.options.dialect;
  if (!section.offset_at || given == DeckDialect::abaqus) return;
  const std::optional<DialectClues::Clue>& clue = build.clues.calculix;
  if (given == DeckDialect::calculix)
    build.source.error(ErrorCode::unsupported, *section.offset_at,
                       "*BEAM SECTION OFFSET is a line that only Abaqus has: CalculiX has OFFSET1 "
                       "and OFFSET2 of *BEAM SECTION");
  else if (clue)
    build.source.error(
        ErrorCode::unsupported, *section.offset_at,
        "*BEAM SECTION OFFSET is a line that only Abaqus has, but the deck has {} ({}), which only "
        "CalculiX has; if it is one of Abaqus give --dialect abaqus",
        clue->what, build.place(clue->at));
}

/// OFFSET1 and OFFSET2 in a deck of Abaqus.
void check_calculix_offset(AbaqusBuild& build, const AbaqusSection& section) {
  const DeckDialect given = build.content.options.dialect;
  if (!section.calculix_offset || given == DeckDialect::calculix) return;
  const std::optional<DialectClues::Clue>& clue = build.clues.abaqus;
  if (given == DeckDialect::abaqus)
    build.error(section, ErrorCode::unsupported,
                " has OFFSET1 or OFFSET2, which only CalculiX has: Abaqus has the line *BEAM "
                "SECTION OFFSET");
  else if (clue)
    build.error(section, ErrorCode::unsupported,
                " has OFFSET1 or OFFSET2 as in CalculiX, but the deck has {} ({}), which only "
                "Abaqus has; if it is one of CalculiX give --dialect calculix",
                clue->what, build.place(clue->at));
}

/// OFFSET1 and OFFSET2 in a deck of Abaqus are an error, and so is a shear centre away from the
/// centroid.
void check_abaqus_beam_offset(AbaqusBuild& build, const AbaqusSection& section) {
  const bool constants = section.shape == "GENERAL";
  if (!std::isfinite(section.arm.squaredNorm()))
    return build.error(section, ErrorCode::not_finite,
                       ": its centroid is at ({:g}, {:g}) of the node, expected numbers whose "
                       "squares do not overflow",
                       section.arm(0) + 0.0, section.arm(1) + 0.0);
  if (constants && (section.arm - section.shear_center).norm() > 1e-9 * section.arm.norm())
    build.error(section, ErrorCode::incomplete,
                ": its centroid is at ({:g}, {:g}) of the node and its shear centre at ({:g}, "
                "{:g}), expected both at one place (*CENTROID, *SHEAR CENTER)",
                section.arm(0), section.arm(1), section.shear_center(0), section.shear_center(1));
  check_abaqus_offset_line(build, section);
  check_calculix_offset(build, section);
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
      // Sets of parts contain masses in addition to the elements of a section.
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

void report_abaqus_directions(AbaqusBuild& build) {
  for (const auto& [section, elements] : build.along_direction) {
    const auto& [first, count] = elements;
    const std::string others =
        count == 1 ? std::string() : fmt::format(" and {}", plural(count - 1, "other element"));
    build.error(*section, ErrorCode::geometry,
                ": its direction 1 is ({:g}, {:g}, {:g}), along the axis of {}{}; expected a "
                "direction across it in the second line",
                section->n1(0) + 0.0, section->n1(1) + 0.0, section->n1(2) + 0.0, first, others);
  }
}

void move_abaqus_beam(AbaqusBuild& build, const AbaqusSection& section, const AbaqusElement& deck,
                      FeElement& e) {
  if (section.family != AbaqusType::Family::beam) return;
  if (deck.directed) direct_abaqus_beam(build, deck, e);
  const int nodes = element_kernel(e.type).nodes;
  std::array<Vec3, 3> arms{}, p{};
  for (int k = 0; k < nodes; ++k) p[k] = build.model.positions[e.nodes[k]];
  for (int k = 0; k < nodes && !deck.directed; ++k) {
    if (!is_along_axis(beam_tangent(p, nodes, k), e.reference)) continue;
    auto& [first, count] = build.along_direction[&section];
    if (++count == 1) first = abaqus_label(deck);
    return;
  }
  // One that is not finite has an error already.
  if (section.arm.isZero(0.0) || !std::isfinite(section.arm.squaredNorm())) return;
  for (int k = 0; k < nodes; ++k) {
    const Vec3 t = beam_tangent(p, nodes, k).stableNormalized();
    const Vec3 n2 = t.cross(e.reference.stableNormalized()).normalized();
    // With zero length or direction it is rejected by `validate`, like a beam at its nodes.
    if (!t.allFinite() || !n2.allFinite() || n2.isZero(0.0)) return;
    arms[k] = section.arm(0) * n2.cross(t) + section.arm(1) * n2;
    for (double& x : arms[k])
      if (std::abs(x) < 1e-14 * section.arm.stableNorm()) x = 0.0;
  }
  for (int k = 0; k < nodes; ++k)
    e.nodes[k] = build.arms.end(build.model, build.source, e.nodes[k], arms[k], e.source);
}

}  // namespace floatframe

// Beams whose centroid is not at their nodes. The arm is given in directions 1 and 2 of the
// section: n_1 is the direction of the section across the tangent t of the axis at the node, n_2 =
// t x n_1. CalculiX has OFFSET1 and OFFSET2 in thicknesses along these: the centroid lies at
//   -OFFSET1 t_1 n_1 - OFFSET2 t_2 n_2
// of the node, as its expanded elements show.
#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// Direction 1 towards the further node of the element.
void direct_abaqus_beam(AbaqusBuild& build, const AbaqusElement& deck, Element& e) {
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

/// *BEAM SECTION OFFSET in a deck of CalculiX, which passes such a line over.
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

}  // namespace

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
                      Element& e) {
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
  // One that is not finite is an error already.
  if (section.arm.isZero(0.0) || !std::isfinite(section.arm.squaredNorm())) return;
  for (int k = 0; k < nodes; ++k) {
    const Vec3 t = beam_tangent(p, nodes, k).stableNormalized();
    const Vec3 n2 = t.cross(e.reference.stableNormalized()).normalized();
    // Without length or direction it is refused by `validate`, as one at its nodes.
    if (!t.allFinite() || !n2.allFinite() || n2.isZero(0.0)) return;
    arms[k] = section.arm(0) * n2.cross(t) + section.arm(1) * n2;
    for (double& x : arms[k])
      if (std::abs(x) < 1e-14 * section.arm.stableNorm()) x = 0.0;
  }
  for (int k = 0; k < nodes; ++k)
    e.nodes[k] = build.arms.end(build.model, build.source, e.nodes[k], arms[k], e.source);
}

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

}  // namespace floatframe

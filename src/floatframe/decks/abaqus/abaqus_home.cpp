// How Abaqus treats the elements of its decks: first-order elements have lumped mass in its
// frequencies (B31, S3, S4, C3D4, C3D6, C3D8 and their kin), all others consistent mass, as all
// have in CalculiX; B31 shears, B33 does not; S4R5, S8R5 and STRI are for thin shells. Shear
// factors of B31 by the section: those that Abaqus documents.
#include <algorithm>
#include <array>
#include <map>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/lumped_mass.hpp"

namespace floatframe {
namespace {

/// The default of its slenderness compensation.
constexpr double slenderness_of_abaqus = 0.25;

/// B31, and the shells that are not for thin ones only.
bool shears(const AbaqusType& type) noexcept {
  const std::string_view name = type.name;
  if (type.family == AbaqusType::Family::shell)
    return name.starts_with('S') && !name.starts_with("STRI") && !name.ends_with('5');
  return name.starts_with("B31");
}

}  // namespace

double abaqus_shear_factor(std::string_view shape) noexcept {
  constexpr std::array<std::pair<std::string_view, double>, 5> factors{
      {{"RECT", 0.85}, {"CIRC", 0.89}, {"PIPE", 0.53}, {"BOX", 0.44}, {"I", 0.44}}};
  const auto it =
      std::find_if(factors.begin(), factors.end(), [&](const auto& f) { return f.first == shape; });
  return it == factors.end() ? 1.0 : it->second;
}

void as_in_home_program(AbaqusBuild& build) {
  FeModel& model = build.model;
  const AbaqusContent& c = build.content;
  if (c.sections.empty() || build.source.errors() > 0) return;
  const bool of_abaqus = build.dialect() == DeckDialect::abaqus;
  if (of_abaqus)
    for (BeamSection& s : model.sections)
      if (s.has_shear()) s.slenderness = slenderness_of_abaqus;
  std::map<int, int> beams, shells;  // section: its copy without shear
  for (std::size_t e = 0; e < c.elements.size(); ++e) {
    const int index = build.element_index[e];
    if (index < 0) continue;
    Element& element = model.elements[index];
    const AbaqusType& type = *c.elements[e].type;
    const bool cubic = element.type == ElementType::beam2 && !shears(type);
    if (of_abaqus && !quadratic(element.type) && !cubic) element.mass_form = MassForm::lumped;
    if (shears(type)) continue;
    if (is_beam(element.type) && model.sections[element.section].has_shear())
      element.section =
          changed_copy(model.sections, element.section, beams, element.section,
                       [](BeamSection& s) { s.shear_y = s.shear_z = s.slenderness = 0.0; });
    if (is_shell(element.type) && model.shells[element.section].shear > 0.0)
      element.section = changed_copy(model.shells, element.section, shells, element.section,
                                     [](ShellSection& s) { s.shear = 0.0; });
  }
}

void note_mass_of_unclear_dialect(AbaqusBuild& build) {
  const std::vector<Element>& elements = build.model.elements;
  if (build.content.sections.empty() || build.dialect() != DeckDialect::by_content ||
      std::all_of(elements.begin(), elements.end(),
                  [](const Element& e) { return quadratic(e.type); }))
    return;
  build.model.notes.push_back(
      "the mass of all elements is consistent, as in CalculiX; Abaqus lumps that of elements of "
      "first order: --dialect abaqus if the deck is one of Abaqus");
}

}  // namespace floatframe

// How Abaqus treats the elements of its decks: first-order elements have lumped mass in its
// frequencies (B31, S3, S4, C3D4, C3D6, C3D8 and their variants), all others consistent mass, as
// all in CalculiX; B31 has shear, B33 does not; S4R5, S8R5 and STRI are for thin shells. Shear
// factors of B31 by the section: as documented by Abaqus.
#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/lumped_mass.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Features of only one of the two programs: keywords, or a parameter of some keywords (empty: any)
/// with one of some values (empty: any). Words between blanks.
struct DialectWords {
  std::string_view keywords, parameter = {}, values = {};
};

constexpr DialectWords of_abaqus[] = {
    {"PART ASSEMBLY INSTANCE PREPRINT SYSTEM ROTARYINERTIA MONITOR SECTIONPOINTS FILEFORMAT "
     "FILEOUTPUT PRINT SECTIONCONTROLS ENERGYOUTPUT ENERGYPRINT ENERGYFILE INCREMENTATIONOUTPUT "
     "SOLVERCONTROLS MODALOUTPUT DISPLAYBODY NONSTRUCTURALMASS BEAMSECTIONOFFSET"},
    {"STEP", "NAME"},
    {"OUTPUT", "FIELD"},
    {"OUTPUT", "HISTORY"},
    {"NSET ELSET SURFACE", "INTERNAL"},
    {"RIGIDBODY", "TIENSET"},
    {"RIGIDBODY", "PINNSET"},
    {"BEAMSECTION", "TEMPERATURE"},
    {"BEAMSECTION SHELLSECTION", "POISSON"},
    {"FREQUENCY", "EIGENSOLVER"}};

constexpr DialectWords of_calculix[] = {
    {"VALUESATINFINITY SPECIFICGASCONSTANT FLUIDCONSTANTS FLUIDSECTION GREEN OBJECTIVE "
     "DESIGNVARIABLES SENSITIVITY FEASIBLEDIRECTION CRACKPROPAGATION ELECTROMAGNETICS "
     "MAGNETICPERMEABILITY CHANGEMATERIAL CHANGEPLASTIC CHANGESOLIDSECTION MASSFLOW "
     "UNCOUPLEDTEMPERATURE-DISPLACEMENT"},
    {"", "SOLVER",
     "SPOOLES PARDISO PASTIX TAUCS SGI MATRIXSTORAGE ITERATIVESCALING ITERATIVECHOLESKY"},
    {"FREQUENCY", "STORAGE"},
    {"RIGIDBODY", "ROTNODE"},
    {"BEAMSECTION", "OFFSET1"},
    {"BEAMSECTION", "OFFSET2"},
    {"NODEFILE ELFILE", "OUTPUT", "2D 3D"},
    {"NODEPRINT ELPRINT", "TOTALS", "ONLY"},
    {"STATIC", "TIMERESET"},
    {"STATIC", "TOTALTIMEATSTART"}};

constexpr std::string_view types_of_abaqus_alone =
    "C3D4H C3D10H C3D10I C3D10M C3D8H C3D20H C3D20RH STRI3 STRI65 S3R S4R5 S8R5 B31H B33 B32H "
    "RB3D2 R3D3 ROTARYI R3D4";

/// The entries of a list that match a keyword, for messages; empty: none.
std::string found_in(std::span<const DialectWords> list, const AbaqusKeyword& keyword) {
  if (has_word(list.front().keywords, keyword.name)) return keyword.shown;
  for (const auto& p : keyword.parameters) {
    for (const DialectWords& known : list.subspan(1)) {
      if (p.name != known.parameter ||
          (!known.keywords.empty() && !has_word(known.keywords, keyword.name)) ||
          (!known.values.empty() && !has_word(known.values, abaqus_name(p.value))))
        continue;
      const bool with_value = !known.values.empty() || p.value.size() < 20;
      return keyword.shown + ", " + p.name +
             (p.value.empty() || !with_value ? "" : "=" + upper_case(p.value));
    }
  }
  return {};
}

/// The default of its slenderness compensation.
constexpr double slenderness_of_abaqus = 0.25;

/// B31, and the shells that are not only for thin ones.
bool shears(const AbaqusType& type) noexcept {
  const std::string_view name = type.name;
  if (type.family == AbaqusType::Family::shell)
    return name.starts_with('S') && !name.starts_with("STRI") && !name.ends_with('5');
  return name.starts_with("B31");
}

}  // namespace

void DialectClues::add(DeckDialect of, std::string what, const FeSource& at) {
  std::optional<Clue>& clue = of == DeckDialect::abaqus ? abaqus : calculix;
  if (!clue) clue = Clue{std::move(what), at};
}

void DialectClues::look_at(const AbaqusKeyword& keyword) {
  const std::string in_abaqus = abaqus ? "" : found_in(of_abaqus, keyword);
  const std::string in_calculix = calculix ? "" : found_in(of_calculix, keyword);
  if (!in_abaqus.empty()) add(DeckDialect::abaqus, in_abaqus, keyword.at);
  if (!in_calculix.empty()) add(DeckDialect::calculix, in_calculix, keyword.at);
}

void DialectClues::look_at_type(const std::string& type, const FeSource& at) {
  if (has_word(types_of_abaqus_alone, type))
    add(DeckDialect::abaqus, "elements of type " + type, at);
}

void DialectClues::settle() {
  by_axes = axes && !abaqus && !calculix;
  if (by_axes) abaqus = axes;
}

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
    FeElement& element = model.elements[index];
    const AbaqusType& type = *c.elements[e].type;
    const bool cubic = element.type == FeElementType::beam2 && !shears(type);
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
  const std::vector<FeElement>& elements = build.model.elements;
  if (build.content.sections.empty() || build.dialect() != DeckDialect::by_content ||
      std::all_of(elements.begin(), elements.end(),
                  [](const FeElement& e) { return quadratic(e.type); }))
    return;
  build.model.notes.push_back(
      "the mass of all elements is consistent, as in CalculiX; Abaqus lumps that of elements of "
      "first order: --dialect abaqus if the deck is one of Abaqus");
}

}  // namespace floatframe

#include "floatframe/decks/abaqus/abaqus_dialect.hpp"

#include <span>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// What only one of the two programs has: keywords, or a parameter of some keywords (empty: of any)
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

/// What of a keyword is in a list, for messages; empty: nothing.
std::string found_in(std::span<const DialectWords> list, const AbaqusKeyword& keyword) {
  if (is_abaqus_word(list.front().keywords, keyword.name)) return keyword.shown;
  for (const auto& p : keyword.parameters) {
    for (const DialectWords& known : list.subspan(1)) {
      if (p.name != known.parameter ||
          (!known.keywords.empty() && !is_abaqus_word(known.keywords, keyword.name)) ||
          (!known.values.empty() && !is_abaqus_word(known.values, abaqus_name(p.value))))
        continue;
      const bool with_value = !known.values.empty() || p.value.size() < 20;
      return keyword.shown + ", " + p.name +
             (p.value.empty() || !with_value ? "" : "=" + upper_case(p.value));
    }
  }
  return {};
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
  if (is_abaqus_word(types_of_abaqus_alone, type))
    add(DeckDialect::abaqus, "elements of type " + type, at);
}

void DialectClues::settle() {
  by_axes = axes && !abaqus && !calculix;
  if (by_axes) abaqus = axes;
}

}  // namespace floatframe

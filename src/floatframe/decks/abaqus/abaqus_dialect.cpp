#include "floatframe/decks/abaqus/abaqus_dialect.hpp"

#include <algorithm>
#include <array>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::array<std::string_view, 21> abaqus_keywords = {"PART",
                                                              "ASSEMBLY",
                                                              "INSTANCE",
                                                              "PREPRINT",
                                                              "SYSTEM",
                                                              "ROTARYINERTIA",
                                                              "MONITOR",
                                                              "SECTIONPOINTS",
                                                              "FILEFORMAT",
                                                              "FILEOUTPUT",
                                                              "PRINT",
                                                              "SECTIONCONTROLS",
                                                              "ENERGYOUTPUT",
                                                              "ENERGYPRINT",
                                                              "ENERGYFILE",
                                                              "INCREMENTATIONOUTPUT",
                                                              "SOLVERCONTROLS",
                                                              "MODALOUTPUT",
                                                              "DISPLAYBODY",
                                                              "NONSTRUCTURALMASS",
                                                              "BEAMSECTIONOFFSET"};

constexpr std::array<std::string_view, 17> calculix_keywords = {
    "VALUESATINFINITY",
    "SPECIFICGASCONSTANT",
    "FLUIDCONSTANTS",
    "FLUIDSECTION",
    "GREEN",
    "OBJECTIVE",
    "DESIGNVARIABLES",
    "SENSITIVITY",
    "FEASIBLEDIRECTION",
    "CRACKPROPAGATION",
    "ELECTROMAGNETICS",
    "MAGNETICPERMEABILITY",
    "CHANGEMATERIAL",
    "CHANGEPLASTIC",
    "CHANGESOLIDSECTION",
    "MASSFLOW",
    "UNCOUPLEDTEMPERATURE-DISPLACEMENT"};

/// A parameter, with one value or any (empty).
struct Parameter {
  std::string_view keyword;  ///< empty: any
  std::string_view name, value;
};

constexpr std::array<Parameter, 12> abaqus_parameters = {{{"STEP", "NAME", ""},
                                                          {"OUTPUT", "FIELD", ""},
                                                          {"OUTPUT", "HISTORY", ""},
                                                          {"NSET", "INTERNAL", ""},
                                                          {"ELSET", "INTERNAL", ""},
                                                          {"SURFACE", "INTERNAL", ""},
                                                          {"RIGIDBODY", "TIENSET", ""},
                                                          {"RIGIDBODY", "PINNSET", ""},
                                                          {"BEAMSECTION", "TEMPERATURE", ""},
                                                          {"BEAMSECTION", "POISSON", ""},
                                                          {"FREQUENCY", "EIGENSOLVER", ""},
                                                          {"SHELLSECTION", "POISSON", ""}}};

constexpr std::array<Parameter, 20> calculix_parameters = {{{"", "SOLVER", "SPOOLES"},
                                                            {"", "SOLVER", "PARDISO"},
                                                            {"", "SOLVER", "PASTIX"},
                                                            {"", "SOLVER", "TAUCS"},
                                                            {"", "SOLVER", "SGI"},
                                                            {"", "SOLVER", "MATRIXSTORAGE"},
                                                            {"", "SOLVER", "ITERATIVESCALING"},
                                                            {"", "SOLVER", "ITERATIVECHOLESKY"},
                                                            {"FREQUENCY", "STORAGE", ""},
                                                            {"RIGIDBODY", "ROTNODE", ""},
                                                            {"BEAMSECTION", "OFFSET1", ""},
                                                            {"BEAMSECTION", "OFFSET2", ""},
                                                            {"NODEFILE", "OUTPUT", "2D"},
                                                            {"NODEFILE", "OUTPUT", "3D"},
                                                            {"ELFILE", "OUTPUT", "2D"},
                                                            {"ELFILE", "OUTPUT", "3D"},
                                                            {"NODEPRINT", "TOTALS", "ONLY"},
                                                            {"ELPRINT", "TOTALS", "ONLY"},
                                                            {"STATIC", "TIMERESET", ""},
                                                            {"STATIC", "TOTALTIMEATSTART", ""}}};

constexpr std::array<std::string_view, 19> abaqus_types = {
    "C3D4H", "C3D10H", "C3D10I", "C3D10M", "C3D8H", "C3D20H", "C3D20RH", "STRI3",   "STRI65", "S3R",
    "S4R5",  "S8R5",   "B31H",   "B33",    "B32H",  "RB3D2",  "R3D3",    "ROTARYI", "R3D4"};

template <typename List>
std::string found_parameter(const AbaqusKeyword& keyword, const List& list) {
  for (const auto& p : keyword.parameters) {
    for (const Parameter& known : list) {
      if (p.name != known.name || (!known.keyword.empty() && keyword.name != known.keyword) ||
          (!known.value.empty() && abaqus_name(p.value) != known.value)) {
        continue;
      }
      const bool with_value = !known.value.empty() || p.value.size() < 20;
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
  const auto one_of = [&](const auto& list) {
    return std::find(list.begin(), list.end(), keyword.name) != list.end();
  };
  if (!abaqus) {
    const std::string found =
        one_of(abaqus_keywords) ? keyword.shown : found_parameter(keyword, abaqus_parameters);
    if (!found.empty()) add(DeckDialect::abaqus, found, keyword.at);
  }
  if (!calculix) {
    const std::string found =
        one_of(calculix_keywords) ? keyword.shown : found_parameter(keyword, calculix_parameters);
    if (!found.empty()) add(DeckDialect::calculix, found, keyword.at);
  }
}

void DialectClues::look_at_type(const char* type, const FeSource& at) {
  if (std::find(abaqus_types.begin(), abaqus_types.end(), type) != abaqus_types.end()) {
    add(DeckDialect::abaqus, std::string("elements of type ") + type, at);
  }
}

void DialectClues::settle() {
  by_axes = axes && !abaqus && !calculix;
  if (by_axes) abaqus = axes;
}

const char* program_of(DeckDialect dialect) noexcept {
  return dialect == DeckDialect::abaqus ? "Abaqus" : "CalculiX";
}

}  // namespace floatframe

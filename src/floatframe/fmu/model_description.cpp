#include "floatframe/fmu/model_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "floatframe/core/build_info.hpp"
#include "floatframe/fmu/fmu_units.hpp"
#include "floatframe/page/html_text.hpp"

namespace floatframe {
namespace {

constexpr std::string_view xml_begin = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// Categories of messages, which the runtime uses.
constexpr std::string_view log_categories =
    "  <LogCategories>\n"
    "    <Category name=\"logStatusError\" description=\"why a call has failed\"/>\n"
    "    <Category name=\"logStatusWarning\" description=\"what a call has done otherwise than "
    "asked\"/>\n"
    "    <Category name=\"logStart\" description=\"notes about the start\"/>\n"
    "    <Category name=\"logOverrun\" description=\"steps that took longer than their own "
    "length\"/>\n"
    "  </LogCategories>\n";

template <class... Args>
void append(std::string& out, fmt::format_string<Args...> text, Args&&... args) {
  fmt::format_to(std::back_inserter(out), text, std::forward<Args>(args)...);
}

void attribute(std::string& out, std::string_view name, std::string_view text) {
  if (!text.empty()) append(out, " {}=\"{}\"", name, xml_text(text));
}
void attribute(std::string& out, std::string_view name, std::optional<double> value) {
  if (value) append(out, " {}=\"{}\"", name, *value);
}

/// In the order of ModelVariables.
template <class Visit>
void each_list(const FmuContent& c, Visit visit) {
  visit(c.inputs, "input");
  visit(c.outputs, "output");
  visit(c.parameters, "parameter");
  visit(c.figures, "local");
}

void append_unit(std::string& out, const std::string& name) {
  append(out, "    <Unit name=\"{}\"", xml_text(name));
  const std::optional<FmuUnit> unit = fmu_unit(name);
  if (!unit) {
    out += "/>\n";
    return;
  }
  out += "><BaseUnit";
  for (std::size_t k = 0; k < fmu_base_units.size(); ++k)
    if (unit->exponents[k] != 0) append(out, " {}=\"{}\"", fmu_base_units[k], unit->exponents[k]);
  if (unit->factor != 1.0) attribute(out, "factor", unit->factor);
  if (unit->offset != 0.0) attribute(out, "offset", unit->offset);
  out += "/></Unit>\n";
}

/// Each unit once, in the order of names. Two that are written alike in XML are one.
std::string unit_definitions(const FmuContent& content, bool time) {
  std::map<std::string, std::string> units;
  if (time) units["s"] = "s";
  each_list(content, [&](const std::vector<FmuVariable>& list, const char*) {
    for (const FmuVariable& v : list)
      if (!v.unit.empty()) units.try_emplace(xml_text(v.unit), v.unit);
  });
  if (units.empty()) return "";
  std::string out = "  <UnitDefinitions>\n";
  for (const auto& [written, unit] : units) append_unit(out, unit);
  return out + "  </UnitDefinitions>\n";
}

std::string default_experiment(const FmuContent& content) {
  return fmt::format("  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" stepSize=\"{}\"/>\n",
                     content.duration, content.step);
}

std::string description_of_model(const FmuContent& content) {
  return "Flexible multibody model " + content.model;
}

/// Variability and initial of a causality; inputs have none of the latter.
struct VariableWords {
  const char *variability, *initial;
};
VariableWords words_of(const FmuVariable& v, std::string_view causality) {
  if (causality == "input") return {"continuous", ""};
  if (causality == "output") return {"continuous", "calculated"};
  if (causality == "parameter") return {v.fixed ? "fixed" : "tunable", "exact"};
  return {"discrete", "calculated"};
}

/// Name to initial, which both versions write alike.
void common_attributes(std::string& out, const FmuVariable& v, std::string_view causality) {
  append(out, " name=\"{}\" valueReference=\"{}\"", xml_text(v.name), v.reference);
  attribute(out, "description", v.about);
  attribute(out, "causality", causality);
  attribute(out, "variability", words_of(v, causality).variability);
  attribute(out, "initial", words_of(v, causality).initial);
}

void value_attributes(std::string& out, const FmuVariable& v) {
  attribute(out, "unit", v.unit);
  attribute(out, "min", v.low);
  attribute(out, "max", v.high);
  attribute(out, "start", v.start);
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out = html_escape(text);
  std::replace(out.begin(), out.end(), '\n', ' ');
  std::replace(out.begin(), out.end(), '\t', ' ');
  // U+FFFE and U+FFFF are no characters of XML.
  for (const std::string_view none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at; (at = out.find(none)) != std::string::npos;)
      out.replace(at, none.size(), "\xEF\xBF\xBD");
  return out;
}

std::string fmi2_model_description(const FmuContent& content) {
  std::string out(xml_begin);
  append(out,
         "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{}\" guid=\"{}\" description=\"{}\"\n"
         "    license=\"documentation/licenses/license.txt\" generationTool=\"Floatframe {}\"\n"
         "    variableNamingConvention=\"structured\" numberOfEventIndicators=\"0\">\n",
         xml_text(content.model), xml_text(content.token), xml_text(description_of_model(content)),
         version());
  append(out,
         "  <CoSimulation modelIdentifier=\"{}\" needsExecutionTool=\"false\"\n"
         "      canHandleVariableCommunicationStepSize=\"true\" canInterpolateInputs=\"false\"\n"
         "      maxOutputDerivativeOrder=\"0\" canRunAsynchronuously=\"false\"\n"
         "      canBeInstantiatedOnlyOncePerProcess=\"false\"\n"
         "      canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\"\n"
         "      canSerializeFMUstate=\"true\" providesDirectionalDerivative=\"false\"/>\n",
         content.identifier);
  out += unit_definitions(content, false);
  out += log_categories;
  out += default_experiment(content);
  out += "  <ModelVariables>\n";
  each_list(content, [&](const std::vector<FmuVariable>& list, const char* causality) {
    for (const FmuVariable& v : list) {
      out += "    <ScalarVariable";
      common_attributes(out, v, causality);
      out += "><Real";
      value_attributes(out, v);
      out += "/></ScalarVariable>\n";
    }
  });
  out += "  </ModelVariables>\n  <ModelStructure>\n";
  // Unknowns are named by their number in ModelVariables, from 1: outputs follow the inputs.
  if (!content.outputs.empty()) {
    const std::size_t first = content.inputs.size() + 1, end = first + content.outputs.size();
    out += "    <Outputs>\n";
    for (std::size_t i = first; i < end; ++i)
      append(out, "      <Unknown index=\"{}\" dependencies=\"\"/>\n", i);
    out += "    </Outputs>\n    <InitialUnknowns>\n";
    for (std::size_t i = first; i < end; ++i) append(out, "      <Unknown index=\"{}\"/>\n", i);
    out += "    </InitialUnknowns>\n";
  }
  return out + "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string fmi3_model_description(const FmuContent& content) {
  std::string out(xml_begin);
  append(out,
         "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"{}\" instantiationToken=\"{}\"\n"
         "    description=\"{}\" license=\"documentation/licenses/license.txt\"\n"
         "    generationTool=\"Floatframe {}\" variableNamingConvention=\"structured\">\n",
         xml_text(content.model), xml_text(content.token), xml_text(description_of_model(content)),
         version());
  append(out,
         "  <CoSimulation modelIdentifier=\"{}\" needsExecutionTool=\"false\"\n"
         "      canBeInstantiatedOnlyOncePerProcess=\"false\" canGetAndSetFMUState=\"true\"\n"
         "      canSerializeFMUState=\"true\" providesDirectionalDerivatives=\"false\"\n"
         "      providesAdjointDerivatives=\"false\" "
         "canHandleVariableCommunicationStepSize=\"true\"\n"
         "      fixedInternalStepSize=\"{}\" maxOutputDerivativeOrder=\"0\"\n"
         "      providesIntermediateUpdate=\"true\" mightReturnEarlyFromDoStep=\"false\"\n"
         "      canReturnEarlyAfterIntermediateUpdate=\"true\" hasEventMode=\"false\"/>\n",
         content.identifier, content.step);
  out += unit_definitions(content, true);
  out += log_categories;
  out += default_experiment(content);
  out += "  <ModelVariables>\n";
  append(out,
         "    <Float64 name=\"{}\" valueReference=\"0\" description=\"time since the start\"\n"
         "        causality=\"independent\" variability=\"continuous\" unit=\"s\"/>\n",
         xml_text(content.time));
  each_list(content, [&](const std::vector<FmuVariable>& list, const char* causality) {
    const bool readable = std::string_view(causality) == "output";
    for (const FmuVariable& v : list) {
      out += "    <Float64";
      common_attributes(out, v, causality);
      if (readable) out += " intermediateUpdate=\"true\"";
      value_attributes(out, v);
      out += "/>\n";
    }
  });
  out += "  </ModelVariables>\n  <ModelStructure>\n";
  for (const FmuVariable& v : content.outputs)
    append(out, "    <Output valueReference=\"{}\" dependencies=\"\"/>\n", v.reference);
  for (const FmuVariable& v : content.outputs)
    append(out, "    <InitialUnknown valueReference=\"{}\"/>\n", v.reference);
  return out + "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string fmi3_terminals(const FmuContent& content) {
  std::string out(xml_begin);
  out +=
      "<fmiTerminalsAndIcons fmiVersion=\"3.0\">\n"
      "  <GraphicalRepresentation>\n"
      "    <CoordinateSystem x1=\"-100\" y1=\"-100\" x2=\"100\" y2=\"100\" "
      "suggestedScalingFactorTo_mm=\"0.1\"/>\n"
      "    <Icon x1=\"-100\" y1=\"-100\" x2=\"100\" y2=\"100\"/>\n"
      "  </GraphicalRepresentation>\n";
  const auto terminal = [&](const char* name, const char* about,
                            const std::vector<FmuVariable>& members) {
    if (members.empty()) return;
    append(out, "    <Terminal name=\"{}\" matchingRule=\"bus\" description=\"{}\">\n", name,
           about);
    for (const FmuVariable& v : members)
      append(out,
             "      <TerminalMemberVariable variableName=\"{0}\" memberName=\"{0}\" "
             "variableKind=\"signal\"/>\n",
             xml_text(v.name));
    out += "    </Terminal>\n";
  };
  if (!content.inputs.empty() || !content.outputs.empty()) {
    out += "  <Terminals>\n";
    terminal("inputs", "all inputs", content.inputs);
    terminal("outputs", "all outputs", content.outputs);
    out += "  </Terminals>\n";
  }
  return out + "</fmiTerminalsAndIcons>\n";
}

}  // namespace floatframe

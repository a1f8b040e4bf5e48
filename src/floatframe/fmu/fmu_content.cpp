#include "floatframe/fmu/fmu_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "floatframe/core/printable.hpp"
#include "floatframe/description/elements.hpp"
#include "floatframe/fmu/fmu_names.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

struct FmuFigure {
  const char *name, *unit, *about;
};
/// Figures of the run, which the runtime counts in this order.
constexpr std::array<FmuFigure, 5> run_figures{
    {{"run.steps", "1", "steps made since the start"},
     {"run.substeps", "1", "substeps made since the start; more than steps if some were divided"},
     {"run.iterations", "1", "Newton iterations made since the start"},
     {"run.overruns", "1", "communication steps that took longer than their own length"},
     {"run.largest_load", "1",
      "largest time that a communication step took, over its own length"}}};

/// A phrase of the documentation without the marks of Markdown.
std::string without_marks(std::string text) {
  std::erase(text, '`');
  return text;
}

std::string words_of_output(const Output& output) {
  std::string word = output_type_name(output.type);
  std::replace(word.begin(), word.end(), '_', ' ');
  return word + ": " + without_marks(output_kind(output.type).about);
}

std::uint32_t reference_of(FmuReference kind, std::size_t i) {
  return static_cast<std::uint32_t>(kind) + static_cast<std::uint32_t>(i);
}

std::optional<double> limit_of(double x) {
  return std::isfinite(x) ? std::optional<double>(x) : std::nullopt;
}

class ContentWriter {
 public:
  explicit ContentWriter(FmuContent& out) : out_(out) {}

  /// `kind`: "input", for notes and for the group of names that are taken.
  void add(std::vector<FmuVariable>& list, const std::string& kind, FmuVariable variable) {
    variable.name = names_.take(variable.original, kind + "s");
    // Signs that are escaped are still read as they are written in the model.
    if (variable.name != fmu_name(variable.original))
      out_.notes.push_back(
          fmt::format("{} '{}' is called {} in the FMU: another variable has its "
                      "name",
                      kind, printable(variable.original), variable.name));
    else if (fmu_name_is_changed(variable.original))
      out_.notes.push_back(fmt::format("{} '{}' is called {} in the FMU, whose names are ASCII",
                                       kind, printable(variable.original), variable.name));
    if (variable.name != variable.original)
      variable.about +=
          (variable.about.empty() ? "" : "; ") + ("in the model: " + variable.original);
    list.push_back(std::move(variable));
  }

  std::string name(const std::string& wanted, const std::string& group) {
    return names_.take(wanted, group);
  }

 private:
  FmuContent& out_;
  FmuNames names_;
};

std::string counted_bodies(const Model& model) {
  const auto flexible = std::count_if(model.bodies.begin(), model.bodies.end(),
                                      [](const Body& b) { return b.data && b.modes() > 0; });
  if (flexible == 0) return fmt::format("{}, all rigid", model.bodies.size());
  int modes = 0;
  for (const Body& b : model.bodies) modes += b.data ? b.modes() : 0;
  return fmt::format("{}, of which {} flexible with {} modes", model.bodies.size(), flexible,
                     modes);
}

std::vector<std::pair<std::string, std::string>> facts_of(const Model& model) {
  const SimulationDescription& s = model.simulation;
  const auto elements = std::count_if(model.elements.begin(), model.elements.end(),
                                      [](const Element& e) { return e.exerts() || e.holds; });
  return {
      {"bodies", counted_bodies(model)},
      {"joints", fmt::format("{}", model.joints.size())},
      {"forces and constraints", fmt::format("{}", elements)},
      {"gravity",
       fmt::format("({}, {}, {}) m/s2", model.gravity.x(), model.gravity.y(), model.gravity.z())},
      {"start", s.start == Start::equilibrium ? "equilibrium, found in initialisation mode"
                : s.start == Start::state     ? "a stored state"
                                              : "start values of the model"},
      {"formulation",
       fmt::format("floating frame of reference, {} coordinates, inertia terms by {}",
                   s.coordinates == Coordinates::relative ? "relative" : "absolute",
                   s.inertia == InertiaMethod::preprocessing ? "preprocessing" : "projection")},
      {"integrator", s.spectral_radius < 1.0
                         ? fmt::format("generalised-alpha, spectral radius {}", s.spectral_radius)
                         : "trapezoidal rule"},
      {"inner step", fmt::format("{} s", s.step)},
      {"inputs in a step",
       s.input == InputUse::ramp ? "change linearly from their last values" : "are constant"},
      {"duration of the model", fmt::format("{} s", s.duration)}};
}

}  // namespace

FmuContent fmu_content(const Model& model, std::span<const PackedParameter> parameters,
                       std::string token) {
  FmuContent out;
  out.model = model.name;
  out.identifier = fmu_identifier(model.name);
  out.token = std::move(token);
  out.step = model.simulation.step;
  out.duration = model.simulation.duration;
  out.facts = facts_of(model);
  ContentWriter writer(out);
  for (std::size_t i = 0; i < model.inputs.size(); ++i) {
    const Input& in = model.inputs[i];
    writer.add(
        out.inputs, "input",
        {.name = "",
         .original = in.name,
         .about = in.clamp ? "values outside of its limits are replaced by the nearer one" : "",
         .unit = in.unit,
         .reference = reference_of(FmuReference::inputs, i),
         .start = in.initial,
         .low = limit_of(in.low),
         .high = limit_of(in.high)});
  }
  for (std::size_t i = 0; i < model.outputs.size(); ++i)
    writer.add(out.outputs, "output",
               {.name = "",
                .original = model.outputs[i].name,
                .about = words_of_output(model.outputs[i]),
                .unit = model.outputs[i].unit,
                .reference = reference_of(FmuReference::outputs, i)});
  for (std::size_t i = 0; i < run_figures.size(); ++i)
    writer.add(out.figures, "figure",
               {.name = "",
                .original = run_figures[i].name,
                .about = run_figures[i].about,
                .unit = run_figures[i].unit,
                .reference = reference_of(FmuReference::figures, i)});
  for (std::size_t i = 0; i < parameters.size(); ++i)
    writer.add(out.parameters, "parameter",
               {.name = "",
                .original = parameters[i].name,
                .about = parameters[i].about,
                .unit = parameters[i].unit,
                .reference = reference_of(FmuReference::parameters, i),
                .start = parameters[i].value});
  out.time = writer.name("time", "independent");
  return out;
}

}  // namespace floatframe

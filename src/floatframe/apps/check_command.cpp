// floatframe check: reads and builds a model and counts its coordinates in both formulations.
#include <fmt/format.h>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/notes.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/model/inertia_choice.hpp"
#include "floatframe/report/check_json.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {
namespace {

struct CheckArguments {
  ModelArguments model;
  bool json = false;
};

std::string counts_text(const ModelCounts& c) {
  TextTable table({"", "relative", "absolute"});
  const auto add = [&](const char* name, int relative, int absolute) {
    table.add({name, std::to_string(relative), std::to_string(absolute)});
  };
  add("rigid coordinates", c.relative.rigid, c.absolute.rigid);
  add("elastic coordinates", c.relative.elastic, c.absolute.elastic);
  add("all coordinates", c.relative.total, c.absolute.total);
  add("constraints", c.relative.constraints, c.absolute.constraints);
  std::string text = table.text(2);
  text += fmt::format("  degrees of freedom: {}\n  redundant constraints: {}\n",
                      c.degrees_of_freedom, c.redundant_constraints);
  if (c.cut_joint_names.empty()) return text;
  text += "  joints cut in the relative formulation:\n";
  for (const std::string& name : c.cut_joint_names) text += "    " + name + '\n';
  return text;
}

std::string flexible_bodies_text(const Model& model) {
  TextTable table(
      {"flexible body", "modes", "mass [kg]", "nodes", "fixed-interface frequencies [Hz]"}, {4});
  for (const Body& body : model.bodies) {
    if (body.modes() == 0) continue;
    std::string frequencies;
    for (const double f : body.data->fixed_interface_frequencies) {
      frequencies += (frequencies.empty() ? "" : "  ") + hertz_text(f);
    }
    table.add({body.name, std::to_string(body.modes()),
               fmt::format("{:.6g}", body.data->invariants.m),
               std::to_string(body.data->nodes.size()), frequencies.empty() ? "-" : frequencies});
  }
  return table.empty() ? "" : "\n" + table.text(2);
}

int check_model(const ModelArguments& arguments, bool json) {
  const ModelDescription description = read_model(arguments);
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  const ModelCounts counts = check(model);
  if (json) {
    print(check_json(counts, model));
  } else {
    print(fmt::format("{}: {}, {} ({} cut)\n\n", description.name, bodies_text(counts),
                      plural(counts.joints, "joint"), counts.cut_joints) +
          counts_text(counts) + flexible_bodies_text(model) + notes_text(counts.start.notes));
  }
  return 0;
}

}  // namespace

Command check_command() {
  const auto a = std::make_shared<CheckArguments>();
  return {.name = "check",
          .help = "Check a model file and count its coordinates and constraints",
          .options =
              joined(model_options(a->model), {flag("--json", a->json, "JSON on standard output")}),
          .footer =
              "Prints masses [kg] and frequencies [Hz] of the flexible bodies as well.\n"
              "Exit codes: 0 the model is valid, 1 it cannot be assembled, 2 bad input.",
          .run = [a] { return check_model(a->model, a->json); }};
}

}  // namespace floatframe

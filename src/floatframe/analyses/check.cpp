// Check: reads, builds and assembles a model; its coordinates in both formulations.
#include "floatframe/start/check.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/analyses/body_damping.hpp"
#include "floatframe/body/cut_pair.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/page/check_page.hpp"
#include "floatframe/page/page_tables.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/results/notes_text.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/start/system_state.hpp"

namespace floatframe {
namespace {

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

std::string bending_text(const Model& model) {
  const PageTable bending = bending_table(model);
  if (bending.rows.empty()) return "";
  TextTable table(bending.columns, {1, 2, 4});
  for (const std::vector<std::string>& row : bending.rows) table.add(row);
  return "\n  bending of bars, directions in the design configuration\n" + table.text(2);
}

nlohmann::ordered_json bending_json(const Model& model) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const BarBending& b : model.hints.bending) {
    nlohmann::ordered_json sides = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < 2; ++k)
      sides.push_back(
          {{"direction", json_array(b.direction[k])}, {"stiffness_N_m2", b.stiffness[k]}});
    rows.push_back({{"body", model.bodies[b.body].name}, {"bars", b.bars}, {"sides", sides}});
  }
  return rows;
}

std::optional<std::string> cut_pair_note(const Body& body) {
  const auto pair = cut_pair(*body.data);
  if (!pair) return std::nullopt;
  return fmt::format(
      "body '{}': {} (a round body would bend more easily in one direction than in another)",
      body.name, cut_pair_text(*pair, mode_number_key(*body.data)));
}

std::vector<std::string> notes_of(const Model& model, const ModelCounts& counts) {
  std::vector<std::string> notes = counts.start.notes;
  for (const Body& body : model.bodies)
    if (auto note = cut_pair_note(body)) notes.push_back(std::move(*note));
  return notes;
}

/// "17 bodies (12 flexible)"
std::string bodies_counted(const ModelCounts& counts) {
  return fmt::format("{} ({} flexible)", plural(counts.bodies, "body", "bodies"),
                     counts.flexible_bodies);
}

nlohmann::ordered_json coordinates_json(const CoordinateCounts& c) {
  return {{"rigid", c.rigid},
          {"elastic", c.elastic},
          {"total", c.total},
          {"constraints", c.constraints}};
}

std::string check_json(const ModelCounts& c, const Model& model) {
  using Json = nlohmann::ordered_json;
  Json flexible = Json::array();
  for (const Body& body : model.bodies) {
    if (body.modes() == 0) continue;
    const auto note = cut_pair_note(body);
    flexible.push_back({{"name", body.name},
                        {"modes", body.modes()},
                        {"mass_kg", body.data->invariants.m},
                        {"nodes", body.data->nodes.size()},
                        {"mode_names", body.data->mode_names},
                        {"frequencies_Hz", json_array(body.data->fixed_interface_frequencies)}});
    if (note) flexible.back()["note"] = *note;
  }
  return json_document({{"bodies", c.bodies},
                        {"flexible_bodies", c.flexible_bodies},
                        {"joints", c.joints},
                        {"cut_joints", c.cut_joints},
                        {"relative", coordinates_json(c.relative)},
                        {"absolute", coordinates_json(c.absolute)},
                        {"degrees_of_freedom", c.degrees_of_freedom},
                        {"redundant_constraints", c.redundant_constraints},
                        {"cut_joint_names", c.cut_joint_names},
                        {"start", start_json(c.start)},
                        {"flexible", flexible},
                        {"bending", bending_json(model)},
                        {"damping", body_damping_json(model)}});
}

/// The page of the model in its start configuration.
std::string page_of_start(const Model& model, const ModelCounts& counts) {
  require_page("--report");
  InitialisedModel start(model, model.simulation, Coordinates::relative);
  JointFollower joints(start.model());
  kinematics_at(start.formulation(), start.state());
  start.formulation().forces();
  EffortCollector efforts(start.model());
  efforts.add(start.formulation().motion());
  SystemState state = system_state(start.formulation().motion(), joints);
  place_bodies(start.model(), start.inertia(), state);
  const CoordinateCounts &r = counts.relative, &a = counts.absolute;
  const FactTable facts{"Model",
                        {{"bodies (flexible)", bodies_counted(counts)},
                         {"joints (cut)", fmt::format("{} ({})", counts.joints, counts.cut_joints)},
                         {"coordinates, relative", std::to_string(r.total)},
                         {"coordinates, absolute", std::to_string(a.total)},
                         {"degrees of freedom", std::to_string(counts.degrees_of_freedom)},
                         {"redundant constraints", std::to_string(counts.redundant_constraints)}}};
  std::vector<PageTable> tables = body_tables(model);
  if (PageTable bending = bending_table(model); !bending.rows.empty())
    tables.push_back(std::move(bending));
  for (PageTable& t : coordinate_tables(model, counts)) tables.push_back(std::move(t));
  return check_page(
      model,
      {std::move(state), counts.start.notes, {facts}, std::move(tables), {}, efforts.take()});
}

/// The page of a model that has no valid start.
std::string page_of_failure(const Model& model, const std::string& why) {
  require_page("--report");
  return check_page(model, {{}, {}, {}, body_tables(model), why});
}

AnalysisReport report_check(const Model& model) {
  const ModelCounts counts = check(model);
  return {.text = fmt::format("{}: {}, {} ({} cut)\n\n", model.name, bodies_counted(counts),
                              plural(counts.joints, "joint"), counts.cut_joints) +
                  counts_text(counts) + flexible_bodies_text(model) + bending_text(model) +
                  body_damping_text(model) + system_damping_text(model, counts.degrees_of_freedom) +
                  notes_text(notes_of(model, counts)),
          .json = check_json(counts, model),
          .files = {[&model, counts] { return page_of_start(model, counts); }}};
}

}  // namespace

Analysis check_analysis() {
  return {.name = "check",
          .help = "Check a model file and count its coordinates and constraints",
          .files = {{"--report",
                     "Write a page that shows the model as a run starts, with joints, axes and "
                     "forces (HTML)"}},
          .footer =
              "Prints masses [kg] and frequencies [Hz] of the flexible bodies as well.\n"
              "Exit codes: 0 the model is valid, 1 it cannot be assembled, 2 bad input.",
          .run = report_check,
          .file_of_failure = [](const Model& model, std::size_t, const std::string& why) {
            return page_of_failure(model, why);
          }};
}

}  // namespace floatframe
